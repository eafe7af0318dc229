#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>

#include "twin/volumetric/volumetric_model.h"

namespace thermotwin::twin {

/// E(q) [m].
using ErrorFunction = std::function<Eigen::Vector3d(Eigen::Vector3d const& q)>;

/// Evenly spaced points of a workspace, x fastest.
struct VolumeGrid {
  Workspace workspace;
  std::array<int, 3> points = {11, 11, 7};  ///< along x, y, z; at least 2

  [[nodiscard]] Eigen::Matrix3Xd positions() const;  ///< [m]
};

/// Vectors at points.
struct ErrorField {
  Eigen::Matrix3Xd positions;  ///< [m]
  Eigen::Matrix3Xd errors;     ///< [m]

  [[nodiscard]] double largest() const;  ///< max ‖E‖
  [[nodiscard]] double root_mean_square() const;
};

[[nodiscard]] ErrorField sample(ErrorFunction const& error, Eigen::Matrix3Xd positions);

/// The field less the rigid motion t + w × q that fits it best (least squares): where the workpiece lies, and how it is
/// turned, is no error of the machine's volume.
[[nodiscard]] ErrorField without_rigid_motion(ErrorField field);

/// The error function of a machine by its exact poses: pose(q) less pose(q₀) less the command.
[[nodiscard]] ErrorFunction error_of(PoseFunction pose, Eigen::Vector3d const& origin);

}  // namespace thermotwin::twin
