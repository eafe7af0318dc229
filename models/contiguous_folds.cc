#include "models/contiguous_folds.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <stdexcept>

namespace thermotwin::models {
namespace {

constexpr std::size_t fewest_runs = 3;

}  // namespace

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

std::vector<Fold> folds_of_runs(std::vector<Eigen::Index> const& run_lengths, int folds) {
  if (run_lengths.size() < fewest_runs)
    return contiguous_folds(std::accumulate(run_lengths.begin(), run_lengths.end(), Eigen::Index{0}), folds);
  auto const runs = static_cast<int>(run_lengths.size());
  std::vector<Fold> result;
  Eigen::Index first = 0;
  for (auto const& group : contiguous_folds(runs, std::min(folds, runs))) {
    auto const begin = run_lengths.begin() + group.first;
    auto const count = std::accumulate(begin, begin + group.count, Eigen::Index{0});
    result.push_back({first, count});
    first += count;
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
