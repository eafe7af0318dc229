#include "thermal/fluid.h"

#include <utility>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/physical_constant.h"

namespace thermotwin::thermal {
namespace {

std::vector<std::pair<std::string, Fluid>> const& fluids() {
  static auto const all = [] {
    std::vector<std::pair<std::string, Fluid>> named = {
        {"air", Air{}},
        {"water", Water{}},
        {"emulsion", Emulsion{}},
        {"water-glycol", water_glycol()},
        {"ethylene glycol", ethylene_glycol()},
    };
    for (int const grade : iso_viscosity_grades)
      named.emplace_back("oil VG" + std::to_string(grade), mineral_oil(grade));
    return named;
  }();
  return all;
}

}  // namespace

Liquid mineral_oil(int iso_grade) { return {0.13, 870.0, 6.5e-4, 1900.0, 4.0, mineral_oil_viscosity(iso_grade)}; }

Liquid water_glycol() {
  return {0.48, 1045.0, 4.3e-4, 3650.0, 0.0, andrade_through(2.2e-6, reference_temperature, 1.3e-6, 313.15)};
}

Liquid ethylene_glycol() { return {0.252, 1118.0, 6.5e-4, 2382.0, 4.5, {6.224869e-8, 713.0225, 168.66379}}; }

Fluid fluid(std::string_view name) {
  for (auto const& [known, kind] : fluids())
    if (edit_distance(known, name) == 0) return kind;
  throw InputError("unknown fluid '" + std::string(name) + "'; " + did_you_mean(name, fluid_names()));
}

std::vector<std::string> const& fluid_names() {
  static std::vector<std::string> const names = [] {
    std::vector<std::string> all;
    for (auto const& entry : fluids()) all.push_back(entry.first);
    return all;
  }();
  return names;
}

}  // namespace thermotwin::thermal
