#pragma once

#include <Eigen/Core>

#include "models/exhaustive_selection.h"
#include "models/selection.h"
#include "models/subset_validation.h"

namespace thermotwin::models {

/// A selection against the truth of a simulated world.
struct SelectionScore {
  int informative = 0;          ///< truly informative points: see `score`
  int found = 0;                ///< how many of these it chose
  double rank_correlation = 0;  ///< Spearman's, of the method's score with the true one
};

/// `truth`: how informative each sensor really is, ≥ 0 (std::invalid_argument for another length or no number). Truly
/// informative are the sensors of most truth, as many as were chosen, together with those that equal the last of these,
/// without those of truth 0.
SelectionScore score(Selection const& selection, Eigen::VectorXd const& truth);

/// Spearman's rank correlation: Pearson's of the ranks, equal values sharing their mean rank. 0 where one of the two
/// does not vary.
double rank_correlation(Eigen::VectorXd const& a, Eigen::VectorXd const& b);

/// RMSE of the selected sensors less that of the best set of the same size, both by `validation` [µm]; ≥ 0.
/// std::invalid_argument for an optimum of another size.
double regret(Selection const& selection, SubsetValidation const& validation, BestSubset const& optimum);

}  // namespace thermotwin::models
