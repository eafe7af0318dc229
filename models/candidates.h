#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "models/selection.h"

namespace thermotwin::models {

/// The sensors that a method chooses from: those whose readings move. One that stands still carries no information; it
/// is left out, and the remark of the selection says so.
struct Candidates {
  std::vector<Batch> batches;         ///< checked, with only the sensors that move
  Batch all;                          ///< those, one below the other
  std::vector<Eigen::Index> columns;  ///< of each candidate in the batches as they were given
  Eigen::Index sensors = 0;           ///< how many the batches had
  std::string remark;                 ///< which were left out, or empty

  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(columns.size()); }
};

/// std::invalid_argument: a batch that `check` refuses, batches whose sensors differ, fewer than two instants, no
/// sensor that moves, options.count that is not between 1 and the number of candidates.
Candidates candidates(std::span<Batch const> batches, SelectionOptions const& options);

/// Throws std::invalid_argument if the error stands still: the methods that look at it have nothing to explain.
void require_error_that_moves(Candidates const& from);

/// The selection in terms of the columns that were given: `chosen` and `score` count candidates, best first. What was
/// left out has no more score than the least of the candidates, and none above 0.
Selection selection(Candidates const& from, std::vector<Eigen::Index> const& chosen, Eigen::VectorXd const& score,
                    std::string const& remark = {});

/// Candidate numbers in the order of falling score; of equal ones the first comes first.
std::vector<Eigen::Index> by_falling_score(Eigen::VectorXd const& score);

/// Columns less their means.
Eigen::MatrixXd centred(Eigen::MatrixXd const& columns);

}  // namespace thermotwin::models
