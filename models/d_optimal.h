#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/selection.h"

namespace thermotwin::models {

/// A set S of `count` variables for which log det Σ_SS is large: greedily the variable of most conditional variance,
/// then single exchanges until none raises it (Fedorov 1972; Shewry & Wynn, J. Appl. Stat. 14 (1987) 165). In the order
/// of conditional variance. Σ positive definite. The greedy start alone is the order of a column-pivoted QR.
std::vector<Eigen::Index> largest_determinant(Eigen::MatrixXd const& covariance, int count);

/// D-optimal sensors: log det (Σ + σ²I)_SS with Σ the covariance of the readings and σ² = resolution²/12 the variance
/// of rounding, so that readings which tell the same are worth no more than their noise. The score is the deviation
/// that the sensors before leave; of those not taken, that all taken ones leave [K]. The error is not looked at.
/// Without a count: until less than 1 % of the sum of all variances is left.
Selection select_d_optimal(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
