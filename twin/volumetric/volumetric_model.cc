#include "twin/volumetric/volumetric_model.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::twin {
namespace {

/// Translation that squareness adds when an axis stands at q.
Eigen::Vector3d lean(Eigen::Vector3d const& squareness, int axis, double q) {
  if (axis == 1) return {-squareness[0] * q, 0.0, 0.0};
  if (axis == 2) return {-squareness[1] * q, -squareness[2] * q, 0.0};
  return Eigen::Vector3d::Zero();
}

Eigen::Matrix3d rotation_by(Eigen::Vector3d const& vector) {
  double const angle = vector.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

int index_of(std::string const& name, std::vector<std::string> const& names, std::string_view what) {
  auto const it = std::find(names.begin(), names.end(), name);
  if (it == names.end())
    throw thermal::InputError(fmt::format("unknown {} '{}'; {}", what, name, thermal::did_you_mean(name, names)));
  return int(it - names.begin());
}

}  // namespace

std::vector<std::string> chain_names() { return {"FXYZ", "XFYZ", "XYFZ", "XYZF"}; }
KinematicChain chain_of(std::string const& name) {
  return KinematicChain(index_of(name, chain_names(), "kinematic chain"));
}
std::string name_of(KinematicChain chain) { return chain_names()[std::size_t(chain)]; }

std::vector<std::string> convention_names() { return {"tool-relative", "body-fixed"}; }
ErrorConvention convention_of(std::string const& name) {
  return ErrorConvention(index_of(name, convention_names(), "convention"));
}
std::string name_of(ErrorConvention convention) { return convention_names()[std::size_t(convention)]; }

VolumetricModel::VolumetricModel(KinematicChain chain, ErrorConvention convention, Eigen::Vector3d tool_offset,
                                 GeometricErrors errors)
    : workpiece_axes_(int(chain)),
      convention_(convention),
      tool_offset_(std::move(tool_offset)),
      errors_(std::move(errors)) {}

bool VolumetricModel::reversed(int axis) const {
  return convention_ == ErrorConvention::body_fixed && axis < workpiece_axes_;
}

Eigen::Vector3d VolumetricModel::lever(int axis, Eigen::Vector3d const& q) const {
  Eigen::Vector3d lever = tool_offset_;
  for (int b = reversed(axis) ? axis : axis + 1; b < 3; ++b) lever[b] += q[b];
  return lever;
}

Eigen::Vector3d VolumetricModel::error(Eigen::Vector3d const& q) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    auto const own = errors_.at(axis, q[axis]);
    double const sign = reversed(axis) ? -1.0 : 1.0;
    sum += sign * (own.translation + own.rotation.cross(lever(axis, q))) + lean(errors_.squareness, axis, q[axis]);
  }
  return sum;
}

Eigen::Isometry3d VolumetricModel::motion(int axis, double q, double direction) const {
  auto const own = errors_.at(axis, q);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = rotation_by(own.rotation);
  motion.translation() =
      direction * (q * Eigen::Vector3d::Unit(axis) + lean(errors_.squareness, axis, q)) + own.translation;
  return motion;
}

Eigen::Isometry3d VolumetricModel::pose(Eigen::Vector3d const& q) const {
  Eigen::Isometry3d workpiece = Eigen::Isometry3d::Identity(), tool = Eigen::Isometry3d::Identity();
  for (int axis = 0; axis < 3; ++axis)
    if (reversed(axis))
      workpiece = motion(axis, q[axis], -1.0) * workpiece;
    else
      tool = tool * motion(axis, q[axis], 1.0);
  return workpiece.inverse() * tool * Eigen::Translation3d(tool_offset_);
}

Eigen::Vector3d VolumetricModel::exact_error(Eigen::Vector3d const& q) const {
  return pose(q).translation() - q - tool_offset_;
}

}  // namespace thermotwin::twin
