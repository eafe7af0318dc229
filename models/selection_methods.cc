#include <algorithm>
#include <array>
#include <stdexcept>

#include "models/information_screen.h"
#include "models/selection.h"
#include "models/unknown_name.h"

namespace thermotwin::models {

namespace {

// In the order of the papers, then the ones that the papers lacked.
constexpr auto methods = std::to_array<SelectionMethod>({
    {"mutual_information", "the two sensors of each component that tell most about the error",
     "Li, Li, Tao, Pang 2020 (methods.md 3.2)", select_by_mutual_information},
});

}  // namespace

std::span<SelectionMethod const> selection_methods() { return methods; }

SelectionMethod const& selection_method(std::string_view name) {
  auto const found =
      std::find_if(methods.begin(), methods.end(), [&](auto const& method) { return method.name == name; });
  if (found != methods.end()) return *found;
  std::array<std::string_view, methods.size()> known;
  std::transform(methods.begin(), methods.end(), known.begin(), [](auto const& method) { return method.name; });
  throw std::invalid_argument(unknown_name("selection method", name, known));
}

}  // namespace thermotwin::models
