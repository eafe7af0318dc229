#include "twin/volumetric/error_field.h"

#include <Eigen/QR>
#include <cmath>
#include <utility>

namespace thermotwin::twin {

Eigen::Matrix3Xd VolumeGrid::positions() const {
  Eigen::Matrix3Xd result(3, points[0] * points[1] * points[2]);
  Eigen::Index at = 0;
  for (int k = 0; k < points[2]; ++k)
    for (int j = 0; j < points[1]; ++j)
      for (int i = 0; i < points[0]; ++i) {
        Eigen::Vector3d const share(double(i) / (points[0] - 1), double(j) / (points[1] - 1),
                                    double(k) / (points[2] - 1));
        result.col(at++) = workspace.from + workspace.travel().cwiseProduct(share);
      }
  return result;
}

double ErrorField::largest() const { return errors.colwise().norm().maxCoeff(); }

double ErrorField::root_mean_square() const { return std::sqrt(errors.squaredNorm() / double(errors.cols())); }

ErrorField sample(ErrorFunction const& error, Eigen::Matrix3Xd positions) {
  ErrorField field{std::move(positions), {}};
  field.errors.resize(3, field.positions.cols());
  for (Eigen::Index i = 0; i < field.positions.cols(); ++i) field.errors.col(i) = error(field.positions.col(i));
  return field;
}

ErrorField without_rigid_motion(ErrorField field) {
  Eigen::Vector3d const middle = field.positions.rowwise().mean();
  auto const n = field.positions.cols();
  Eigen::MatrixXd motion(3 * n, 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::Vector3d const arm = field.positions.col(i) - middle;
    motion.block<3, 3>(3 * i, 0).setIdentity();
    for (int axis = 0; axis < 3; ++axis) motion.block<3, 1>(3 * i, 3 + axis) = Eigen::Vector3d::Unit(axis).cross(arm);
  }
  Eigen::Map<Eigen::VectorXd> errors(field.errors.data(), 3 * n);
  Eigen::VectorXd const fit = motion.colPivHouseholderQr().solve(errors);
  errors -= motion * fit;
  return field;
}

ErrorFunction error_of(PoseFunction pose, Eigen::Vector3d const& origin) {
  Eigen::Vector3d const start = pose(origin).translation() - origin;
  return [pose = std::move(pose), start](Eigen::Vector3d const& q) -> Eigen::Vector3d {
    return pose(q).translation() - q - start;
  };
}

}  // namespace thermotwin::twin
