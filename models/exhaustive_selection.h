#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/selection.h"
#include "models/subset_validation.h"

namespace thermotwin::models {

/// Most sensors among which all sets are tried: 20 have 184,756 sets of ten.
inline constexpr Eigen::Index largest_exhaustive = 20;

/// The best of all sets of one size, and what each sensor is worth in it.
struct BestSubset {
  std::vector<Eigen::Index> sensors;
  double rmse = 0;         ///< [µm]
  Eigen::VectorXd margin;  ///< RMSE of the best set without the sensor − that of the best set with it [µm]
};

/// Tries every set of `count` of the validation's sensors; where only one is possible, "without" is that set less the
/// sensor. std::invalid_argument above `largest_exhaustive` sensors, and for a count that is not 1 to all.
BestSubset best_subset(SubsetValidation const& validation, int count);

/// Exhaustive search, the truth against which other selections are measured: least RMSE of the blocked cross-validation
/// of a linear regression. Without a count: size 1, 2, … up to 6, as long as one more sensor lowers the RMSE by 1 %.
/// The score is the margin.
Selection select_exhaustive(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
