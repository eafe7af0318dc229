#pragma once

#include "models/remaining_variance.h"

namespace thermotwin::models {

/// A number that V of no set of at most `count` sensors within the budget undercuts.
///
/// A sensor that is there by the share w_i has the noise r_i/w_i; V(w) is convex in w (Joshi and Boyd, IEEE Trans.
/// Signal Process. 57 (2009) 451), so that with s_i = −∂V/∂w_i = |c_i|²/r_i, c_i the covariance of x_i and y given all
/// shares, every set v ∈ {0, 1}ⁿ has
///
///   V(v) ≥ V(w) + sᵀw − max { sᵀv : 0 ≤ v ≤ 1, Σv ≤ count, Σ cost v ≤ budget },
///
/// whatever w. The w come from the multiplicative algorithm w_i ← w_i √(s_i/p_i) with the prices p of that linear
/// programme (Silvey, Titterington and Torsney 1978), which goes on until the bound is within `tolerance` of V(w).
/// O(m n³) per step at first; sites whose share vanishes drop out. At most 400 steps, 50 in many worlds.
[[nodiscard]] double placement_bound(PlacementProblem const& problem, Eigen::Index count, double tolerance = 1e-3);

}  // namespace thermotwin::models
