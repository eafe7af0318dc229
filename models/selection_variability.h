#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/selection.h"

namespace thermotwin::models {

/// How much the chosen points depend on the batch they were chosen from: the "variability of temperature-sensitive
/// points" of paper 004 (methods.md §7.4).
struct SelectionVariability {
  std::vector<Selection> selections;  ///< of each batch by itself
  double switch_frequency = 0;   ///< share of the batches, from the second on, whose set is not that of the one before
  int different_sets = 0;        ///< order within a set does not count
  Eigen::VectorXd chosen_share;  ///< p: share of the batches in which each sensor is chosen
};

/// Chooses per batch. The same options for each, hence the same seed. Throws std::invalid_argument without batches, for
/// batches whose sensors differ, and what the method refuses.
SelectionVariability selection_variability(SelectionMethod const& method, std::span<Batch const> batches,
                                           SelectionOptions const& options = {});

}  // namespace thermotwin::models
