#pragma once

#include <Eigen/Core>
#include <vector>

namespace thermotwin::models {

/// A stretch of rows that are left out together.
struct Fold {
  Eigen::Index first = 0, count = 0;
};

/// `rows` rows in `folds` stretches that differ by at most one row, in order. Neighbouring instants of a thermal record
/// are alike; folds that shuffle them test on what they trained on (methods.md §4.4). Refuses fewer than two folds and
/// fewer rows than folds (std::invalid_argument).
std::vector<Fold> contiguous_folds(Eigen::Index rows, int folds);

/// The same of runs of these lengths, one below the other: of three or more whole runs, as many folds as there are runs
/// at most. What a run is predicted from shall not be the rest of it: other runs begin in another state. Of two runs
/// stretches as of one: without either, nothing would be known of what stands still in the other.
std::vector<Fold> folds_of_runs(std::vector<Eigen::Index> const& run_lengths, int folds);

/// Numbers of the rows outside the fold, ascending.
std::vector<Eigen::Index> rows_outside(Fold const& fold, Eigen::Index rows);

}  // namespace thermotwin::models
