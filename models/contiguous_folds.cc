#include "models/contiguous_folds.h"

#include <fmt/format.h>
#include <stdexcept>

namespace thermotwin::models {

std::vector<Fold> contiguous_folds(Eigen::Index rows, int folds) {
  if (folds < 2) throw std::invalid_argument(fmt::format("{} folds for a cross-validation; at least 2", folds));
  if (rows < folds) throw std::invalid_argument(fmt::format("{} samples are too few for {} folds", rows, folds));
  std::vector<Fold> result;
  for (int k = 0; k < folds; ++k) {
    auto const first = rows * k / folds;
    result.push_back({first, rows * (k + 1) / folds - first});
  }
  return result;
}

std::vector<Eigen::Index> rows_outside(Fold const& fold, Eigen::Index rows) {
  std::vector<Eigen::Index> outside;
  for (Eigen::Index row = 0; row < rows; ++row)
    if (row < fold.first || row >= fold.first + fold.count) outside.push_back(row);
  return outside;
}

}  // namespace thermotwin::models
