#include "thermal/seal.h"

#include <cmath>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::thermal {
namespace {

BearingSeal deep_groove_seal(double outer_diameter) {
  if (outer_diameter <= 62e-3) return {0.023, 2.25, 2.0};
  if (outer_diameter <= 80e-3) return {0.018, 2.25, 20.0};
  if (outer_diameter <= 100e-3) return {0.018, 2.25, 15.0};
  return {0.018, 2.25, 0.0};
}

}  // namespace

double BearingSeal::torque(double counterface_diameter) const {
  return 1e-3 * (k1 * std::pow(1e3 * counterface_diameter, beta) + k2);
}

BearingSeal bearing_seal(std::string_view bearing_type, double outer_diameter) {
  auto const is = [&](std::string_view type) { return edit_distance(type, bearing_type) == 0; };
  if (is("deep groove ball")) return deep_groove_seal(outer_diameter);
  if (is("angular contact ball") || is("self-aligning ball")) return {0.014, 2.0, 10.0};
  if (is("cylindrical roller")) return {0.032, 2.0, 50.0};
  if (is("spherical roller")) return {0.057, 2.0, 50.0};
  throw InputError("no seal torque for bearing type '" + std::string(bearing_type) + "'; " +
                   did_you_mean(bearing_type, bearing_seal_types()));
}

std::vector<std::string> const& bearing_seal_types() {
  static std::vector<std::string> const names = {"deep groove ball", "angular contact ball", "self-aligning ball",
                                                 "cylindrical roller", "spherical roller"};
  return names;
}

}  // namespace thermotwin::thermal
