#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>

#include "twin/instruments/laser_interferometer.h"
#include "twin/volumetric/volumetric_description.h"
#include "twin/volumetric/volumetric_model.h"

namespace thermotwin::twin {

/// The body diagonals by the directions in which X, Y and Z move along them. (methods.md §5.4)
inline constexpr std::array<std::string_view, 4> diagonal_names = {"PPP", "NPP", "PNP", "PPN"};

/// s = (±1, ±1, ±1) of diagonal k.
[[nodiscard]] Eigen::Vector3d diagonal_signs(int k);
/// u_k = s ∘ (X, Y, Z)/D: its direction over a workspace.
[[nodiscard]] Eigen::Vector3d diagonal_direction(int k, Workspace const& workspace);

/// The stops along diagonal k: its first corner, then n times an X step, a Y step, a Z step. 3 × (3n + 1) [m].
[[nodiscard]] Eigen::Matrix3Xd diagonal_stops(int k, Workspace const& workspace, int steps);

/// A step-diagonal measurement: per diagonal the laser's reading at each of its 3n + 1 stops, less the commanded
/// travel along the diagonal [m]; zero at the first stop but for noise.
struct StepDiagonals {
  Workspace workspace;
  int steps = 0;
  std::array<Eigen::VectorXd, 4> errors;
  double noise = 0.0;                             ///< of one reading, standard deviation [m]
  std::array<Eigen::Vector3d, 4> mirror_normals;  ///< as they were: truth
};

/// What a laser along diagonal k reads: a beam along b from where the tool starts, on a flat mirror that the spindle
/// carries with normal n in the tool's frame,
///
///   s(q) = n(q) · (P(q) − P(q₀)) / (n(q) · b),   n(q) = R(q) n
///
/// P tool tip, R its orientation. Sideways motion passes along the mirror; if n is not along the diagonal, or the tool
/// turns, it shows. The mirror is squared to nothing: n and b deviate from the diagonal independently, by normal angles
/// in two directions each. The rest of the instrument (air, dead path, noise, resolution) is LaserInterferometer.
[[nodiscard]] StepDiagonals measure_diagonals(PoseFunction const& pose, Workspace const& workspace,
                                              LaserInterferometer const& laser, StepDiagonalDescription const& how,
                                              std::uint64_t seed);

/// The travel error of each axis over its whole stroke along the workspace's edges at `from`, measured on its own [m].
[[nodiscard]] Eigen::Vector3d measure_linear_totals(PoseFunction const& pose, Workspace const& workspace, double noise,
                                                    std::uint64_t seed);

}  // namespace thermotwin::twin
