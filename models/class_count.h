#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "models/linear_regression.h"
#include "models/selection.h"

namespace thermotwin::models {

/// How many classes: what the course of the least loss ψ*(k) says by itself (methods.md §3.5). ψ*(k) stands at index
/// k − 1, as in OrderedPartitions::loss.

/// β(k) = ψ*(k)/ψ*(k+1) for k = 1 … l − 1, at index k − 1: what one more class would help. 1 where both vanish.
Eigen::VectorXd loss_ratios(Eigen::VectorXd const& loss);

/// α(k) = ψ*(k−1) − ψ*(k) ≥ 0 for k = 2 … l, at index k − 2: what the last class helped.
Eigen::VectorXd loss_slopes(Eigen::VectorXd const& loss);

/// The k ≥ 2, k < l, at which the course bends: ψ*(k−1) − 2ψ*(k) + ψ*(k+1) > τ ψ*(1). Ascending; of more than `most`
/// the strongest bends, and the strongest of all where none is that strong. l itself for l ≤ 2.
std::vector<int> bends(Eigen::VectorXd const& loss, double threshold = 0.005, int most = 3);

/// The candidate with the largest α: for convex ψ* the smallest candidate.
int count_by_slope(Eigen::VectorXd const& loss, std::vector<int> const& candidates);

/// The candidates by falling β(k−1), which is what going from k − 1 to k classes helps; the ratio rule takes the first
/// whose regression is significant. (A large β(k) speaks for k + 1, not for k; hence the shift against the wording.)
std::vector<int> counts_by_ratio(Eigen::VectorXd const& loss, std::vector<int> const& candidates);

/// The regression of the error on one sensor of each of k classes.
struct ClassCountTrial {
  int k = 0;
  std::vector<Eigen::Index> sensors;
  LinearRegression regression;
  std::string obstacle;  ///< why there is no regression (collinear sensors, too few samples); empty if there is one
};

/// "k = 4": p of F, the largest p of a t and the same under autocorrelation, R², σ_res and e_max [µm]; none where there
/// is no regression.
Evidence evidence_of(ClassCountTrial const& trial);

/// What a number of classes must do to replace a smaller one.
struct ImprovedRule {
  double significance = 0.05;     ///< p_F and every p_i below
  double r_squared_rise = 0.001;  ///< at least
  double residual_fall = 0.05;    ///< σ_res and e_max, relative, at least
};

struct ClassCountVerdict {
  std::optional<std::size_t> trial;  ///< which is chosen; none if no trial has a regression
  bool accepted = false;             ///< false: every trial fails a test of F or t, and the walk took no notice of them
  std::string reason;                ///< the figures that decided
};

/// The improved rule of paper 000 (methods.md §3.6) on trials of rising k. Those whose F is not significant, or that
/// have a sensor whose t is not, are out. The walk begins with the smallest of the others and goes to the next whenever
/// R² rises and σ_res and e_max fall by more than the tolerances: it ends at the smallest k that no other improves.
ClassCountVerdict count_by_regression(std::vector<ClassCountTrial> const& trials, ImprovedRule const& rule = {});

}  // namespace thermotwin::models
