#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "twin/volumetric/geometric_errors.h"

namespace thermotwin::twin {

/// Which axes carry the workpiece: the letters before F (the frame) carry it, those after F carry the tool.
/// From workpiece to tool the axes come in the order X, Y, Z.
enum class KinematicChain { FXYZ, XFYZ, XYFZ, XYZF };

/// What an error element is the motion of. (methods.md §5.2)
///
/// * tool_relative (A): of the tool-side body of the joint against its workpiece-side body. The error is then the same
///   function of the elements for every chain.
/// * body_fixed (B): of the moving carriage, in a frame that it carries along. A carriage that carries the workpiece
///   goes to −q, its errors count with the opposite sign, and its lever has its own travel in it.
enum class ErrorConvention { tool_relative, body_fixed };

[[nodiscard]] std::vector<std::string> chain_names();
[[nodiscard]] KinematicChain chain_of(std::string const& name);
[[nodiscard]] std::string name_of(KinematicChain chain);
[[nodiscard]] std::vector<std::string> convention_names();
[[nodiscard]] ErrorConvention convention_of(std::string const& name);
[[nodiscard]] std::string name_of(ErrorConvention convention);

/// Where tool and workpiece stand to one another when the axes are commanded to q [m].
using PoseFunction = std::function<Eigen::Isometry3d(Eigen::Vector3d const& q)>;

/// A three-axis machine with 21 error elements.
///
/// First order: E(q) = Σ_a σ_a [ δ_a + ε_a × L_a ] − (S_xy y + S_xz z, S_yz z, 0)
///
/// σ_a = −1 for a workpiece-carrying axis in convention body_fixed, else +1; lever L_a = p_t + Σ_b q_b e_b over the
/// axes b on the tool side of a, and over a itself where σ_a = −1; p_t tool offset from the reference point of the
/// last carriage [m].
///
/// Exact: the product of rigid motions T_a = (translation q_a e_a + δ_a + squareness, rotation by the vector ε_a), for
/// body_fixed (T of the workpiece's carriages at −q)⁻¹ (T of the tool's). Both agree to second order in ε.
class VolumetricModel {
 public:
  VolumetricModel(KinematicChain chain, ErrorConvention convention, Eigen::Vector3d tool_offset,
                  GeometricErrors errors);

  /// E(q) by the first-order formula [m].
  [[nodiscard]] Eigen::Vector3d error(Eigen::Vector3d const& q) const;

  /// Tool against workpiece by the exact product; its translation is that of the tool tip.
  [[nodiscard]] Eigen::Isometry3d pose(Eigen::Vector3d const& q) const;

  /// pose(q) less the commanded tool tip q + p_t [m].
  [[nodiscard]] Eigen::Vector3d exact_error(Eigen::Vector3d const& q) const;

  [[nodiscard]] GeometricErrors const& errors() const { return errors_; }
  [[nodiscard]] Eigen::Vector3d const& tool_offset() const { return tool_offset_; }

 private:
  [[nodiscard]] bool reversed(int axis) const;
  [[nodiscard]] Eigen::Vector3d lever(int axis, Eigen::Vector3d const& q) const;
  [[nodiscard]] Eigen::Isometry3d motion(int axis, double q, double direction) const;

  int workpiece_axes_;  ///< how many axes carry the workpiece
  ErrorConvention convention_;
  Eigen::Vector3d tool_offset_;
  GeometricErrors errors_;
};

}  // namespace thermotwin::twin
