#include "twin/volumetric/nine_functions.h"

#include <algorithm>

namespace thermotwin::twin {

double NineFunctions::position(int axis, Eigen::Index j) const {
  auto const last = values[std::size_t(axis)].cols() - 1;
  return workspace.from[axis] + workspace.travel()[axis] * double(j) / double(last);
}

Eigen::Vector3d NineFunctions::at(int axis, double q) const {
  auto const& own = values[std::size_t(axis)];
  double const share = std::clamp((q - workspace.from[axis]) / workspace.travel()[axis], 0.0, 1.0);
  double const place = share * double(own.cols() - 1);
  auto const below = std::min(Eigen::Index(place), own.cols() - 2);
  double const rest = place - double(below);
  return (1.0 - rest) * own.col(below) + rest * own.col(below + 1);
}

Eigen::Vector3d NineFunctions::error(Eigen::Vector3d const& q) const { return at(0, q[0]) + at(1, q[1]) + at(2, q[2]); }

NineFunctions nine_functions_of(PoseFunction const& pose, Workspace const& workspace, int steps) {
  NineFunctions functions{workspace, {}};
  Eigen::Vector3d const start = pose(workspace.from).translation() - workspace.from;
  for (int axis = 0; axis < 3; ++axis) {
    auto& own = functions.values[std::size_t(axis)];
    own.resize(3, steps + 1);
    for (int j = 0; j <= steps; ++j) {
      Eigen::Vector3d q = workspace.from;
      q[axis] = functions.position(axis, j);
      own.col(j) = pose(q).translation() - q - start;
    }
  }
  return functions;
}

Eigen::Vector3d squareness_of(NineFunctions const& functions) {
  Eigen::Matrix3d slopes;  // column: axis
  for (int axis = 0; axis < 3; ++axis) {
    auto const& own = functions.values[std::size_t(axis)];
    slopes.col(axis) = (own.col(own.cols() - 1) - own.col(0)) / functions.workspace.travel()[axis];
  }
  return -Eigen::Vector3d(slopes(1, 0) + slopes(0, 1), slopes(2, 0) + slopes(0, 2), slopes(2, 1) + slopes(1, 2));
}

}  // namespace thermotwin::twin
