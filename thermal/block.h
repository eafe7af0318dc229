#pragma once

#include "thermal/body.h"

namespace thermotwin::thermal {

/// A box with edges along the machine's axes (bed, column, headstock): G = kA/Δ, C = ρ c V in three dimensions.
struct Block {
  Material material;
  Eigen::Vector3d corner{0.0, 0.0, 0.0};  ///< the one with the least coordinates [m]
  Eigen::Vector3d size{0.0, 0.0, 0.0};    ///< [m]
  std::array<int, 3> cells{4, 4, 4};
  double solidity = 1.0;  ///< fraction of metal in a ribbed casting, 0 < s ≤ 1: scales conductivity and capacity
};

/// Faces: "x_min", "x_max", "y_min", "y_max", "z_min", "z_max".
[[nodiscard]] Body make_body(std::string const& name, Block const& block);

}  // namespace thermotwin::thermal
