#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "twin/volumetric/nine_functions.h"
#include "twin/volumetric/step_diagonal.h"

namespace thermotwin::twin {

/// What is left over when four diagonals give three components: per axis and segment
///
///   c_{r,j} = Σ_k (s_x s_y s_z / s_r)_k m_{k,r,j}     (X: M1 + M2 − M3 − M4 = 0)
///
/// White laser noise σ makes closures that are uncorrelated with variance 8σ², so that c²/8σ² sums are χ². A mirror
/// that is not square to its diagonal moves the mean of an axis' closures, angular errors of the axes move them along
/// the way, too.
struct Closure {
  Eigen::Matrix3Xd residuals;  ///< axis × segment [m]
  double noise = 0.0;          ///< √8 σ: their standard deviation from the laser alone, σ at least 10 nm [m]

  [[nodiscard]] double rms() const;
  /// Probabilities that laser noise alone makes at least these means, and this much change along the axes.
  [[nodiscard]] double mean_by_chance() const;
  [[nodiscard]] double change_by_chance() const;
};

/// Nine functions by least squares over the four diagonals. (methods.md §5.4)
///
///   m_{k,r,j} = s_r (s ∘ (a, b, c))_k · e_{r,j},   e_i = Σ_k s_r s_i m_k/(4 a_i);   sums over j are the functions
///
/// m: increment of the reading over segment j of axis r along diagonal k; where the axis runs backwards the i-th step
/// is segment n − i + 1. What it cannot know: misaligned mirrors look like squareness and scale errors, and angular
/// errors like translations.
struct PlainIdentification {
  NineFunctions functions;
  Closure closure;
};

[[nodiscard]] PlainIdentification identify_plain(StepDiagonals const& measured);

/// The same with shapes as there, and slopes from a joint solution with the mirrors. (methods.md §5.5)
///
///   M_{k,r} = s_r T_r (u_kᵀ S e_r + μ_k · e_r),   L_r = T_r S_rr
///
/// Unknown: the symmetric strain S (six: three scales, three half squarenesses; rotation of the whole is gauge and
/// hides in the mirrors) and two misalignments μ_k ⊥ u_k per diagonal: 14. Given: 12 totals M of the diagonals' axes,
/// and the three linear totals L measured on their own. Each equation has the weight 1/its standard deviation.
struct JointIdentification {
  NineFunctions functions;
  int rank = 0;                                 ///< of 14; 12 without linear totals
  std::array<Eigen::Vector3d, 4> misalignment;  ///< μ_k [rad]; contains the gauge rotation
};

[[nodiscard]] JointIdentification identify_jointly(StepDiagonals const& measured, Eigen::Vector3d const& linear_totals,
                                                   double linear_noise);

/// What stands in the way of the plain identification, in sentences; empty if nothing shows. A limit is told when it
/// happens by chance less than once in a thousand measurements.
[[nodiscard]] std::vector<std::string> limits(Closure const& closure);

}  // namespace thermotwin::twin
