#include "models/forward_selection.h"

#include <algorithm>
#include <fmt/format.h>

#include "models/candidates.h"
#include "models/subset_validation.h"

namespace thermotwin::models {

Selection select_forward(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const from = candidates(batches, options);
  require_error_that_moves(from);
  SubsetValidation const validation(from.batches);
  int const most = options.count.value_or(std::min(static_cast<int>(from.count()), validation.largest_set()));
  std::vector<Eigen::Index> chosen;
  std::vector<bool> taken(static_cast<std::size_t>(from.count()), false);
  Eigen::VectorXd gain(from.count());
  double rmse = validation.rmse(chosen);
  for (int step = 0; step < std::max(most, 1); ++step) {
    Eigen::Index best = -1;
    for (Eigen::Index j = 0; j < from.count(); ++j) {
      if (taken[static_cast<std::size_t>(j)]) continue;
      auto trial = chosen;
      trial.push_back(j);
      gain(j) = rmse - validation.rmse(trial);
      if (best < 0 || validation.less(rmse - gain(j), rmse - gain(best))) best = j;
    }
    if (!options.count && !chosen.empty() && !validation.worthwhile(rmse, rmse - gain(best))) break;
    chosen.push_back(best);
    taken[static_cast<std::size_t>(best)] = true;
    rmse -= gain(best);
  }
  return selection(from, chosen, gain, fmt::format("blocked cross-validation: RMSE {:.3g} µm", rmse));
}

}  // namespace thermotwin::models
