#include <algorithm>
#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/effect.h"

namespace thermotwin::twin {

#define THERMOTWIN_EFFECT(name) Effect const& name##_effect();
#include "twin/effects/catalogue.inc"
#undef THERMOTWIN_EFFECT

std::vector<Effect> const& effect_catalogue() {
  static std::vector<Effect> const catalogue = {
#define THERMOTWIN_EFFECT(name) name##_effect(),
#include "twin/effects/catalogue.inc"
#undef THERMOTWIN_EFFECT
  };
  return catalogue;
}

Effect const& effect(std::string_view name) {
  auto const& catalogue = effect_catalogue();
  auto const it = std::find_if(catalogue.begin(), catalogue.end(), [&](auto const& e) { return e.name == name; });
  if (it != catalogue.end()) return *it;
  std::vector<std::string> names;
  for (auto const& entry : catalogue) names.push_back(entry.name);
  throw thermal::InputError(fmt::format("unknown effect '{}'; {}", name, thermal::did_you_mean(name, names)));
}

}  // namespace thermotwin::twin
