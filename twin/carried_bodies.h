#pragma once

#include <string>
#include <vector>

#include "thermal/growth_field.h"
#include "twin/description.h"

namespace thermotwin::twin {

/// A body as its table hangs it on another.
struct HungBody {
  std::string name;
  CarriedDescription description;
  thermal::Body const* body = nullptr;
  int first_node = 0;
  double expansion = 0.0;  ///< 0: not known, it rides along
};

/// All of them, carriers first; what nobody carries stands on the floor, `up` points away from it. InputError for a
/// carrier that is not there, or one that its own load carries.
[[nodiscard]] std::vector<thermal::GrowingBody> carried_bodies(std::vector<HungBody> const& bodies,
                                                               Eigen::Vector3d const& up);

}  // namespace thermotwin::twin
