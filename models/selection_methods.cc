#include <algorithm>
#include <array>
#include <stdexcept>

#include "models/fuzzy_equivalence.h"
#include "models/grey_relation.h"
#include "models/information_screen.h"
#include "models/ordered_selection.h"
#include "models/selection.h"
#include "models/unknown_name.h"

namespace thermotwin::models {

namespace {

// In the order of the papers, then the ones that the papers lacked.
constexpr auto methods = std::to_array<SelectionMethod>({
    {"mutual_information", "the two sensors of each component that tell most about the error",
     "Li, Li, Tao, Pang 2020 (methods.md 3.2)", select_by_mutual_information},
    {"ordered_improved", "ordered clustering; number of classes by F, t, R2 and residuals of the regression",
     "Li, Li, Tao, Pang 2020 (methods.md 3.6)", select_by_ordered_clustering_improved},
    {"ordered_ratio", "ordered clustering; number of classes where one more class helps most",
     "Li, Li, Tao, Pang 2020 (methods.md 3.5)", select_by_ordered_clustering_ratio},
    {"ordered_slope", "ordered clustering; number of classes where the loss falls most steeply",
     "Li, Li, Tao, Pang 2020 (methods.md 3.5)", select_by_ordered_clustering_slope},
    {"grey_fuzzy", "fuzzy equivalence classes by correlation; of each the sensor of the highest grey relational grade",
     "Li et al. 2020, Miao, Liu, Dong, Chen 2016 (methods.md 3.8)", select_by_grey_fuzzy_clustering},
    {"grey_relational", "the sensors of the highest grey relational grade with the error",
     "Miao, Liu, Dong, Chen 2016 (methods.md 7.4)", select_by_grey_relation},
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
