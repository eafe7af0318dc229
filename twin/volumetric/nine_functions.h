#pragma once

#include <Eigen/Core>
#include <array>

#include "twin/volumetric/volumetric_model.h"

namespace thermotwin::twin {

/// The volumetric error as a sum of nine functions of one coordinate each (methods.md §5.3):
///
///   E(x, y, z) = E(x) + E(y) + E(z),   each of them (Ex, Ey, Ez), zero at the axis' start
///
/// Exactly valid only without angular errors: terms such as ε_y(x) z are products.
struct NineFunctions {
  Workspace workspace;
  std::array<Eigen::Matrix3Xd, 3> values;  ///< per axis: 3 × points, evenly spaced from `from` to `to` [m]

  /// Of an axis at a command, linear between points, held beyond the ends.
  [[nodiscard]] Eigen::Vector3d at(int axis, double q) const;
  /// E(q).
  [[nodiscard]] Eigen::Vector3d error(Eigen::Vector3d const& q) const;
  /// Command of point j of an axis.
  [[nodiscard]] double position(int axis, Eigen::Index j) const;
};

/// Those of a known error field, along the edges that meet at the workspace's `from`.
[[nodiscard]] NineFunctions nine_functions_of(PoseFunction const& pose, Workspace const& workspace, int steps);

/// Angles between the axes less 90°, from the slopes of the functions' end points: S_xy = −(slope Ey(x) + slope Ex(y)),
/// S_xz = −(slope Ez(x) + slope Ex(z)), S_yz = −(slope Ez(y) + slope Ey(z)) [rad].
[[nodiscard]] Eigen::Vector3d squareness_of(NineFunctions const& functions);

}  // namespace thermotwin::twin
