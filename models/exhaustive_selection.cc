#include "models/exhaustive_selection.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

#include "models/candidates.h"
#include "models/subsets.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
constexpr double unbounded = std::numeric_limits<double>::infinity();

double rmse_without(SubsetValidation const& validation, std::vector<Index> set, Index sensor) {
  std::erase(set, sensor);
  return validation.rmse(set);
}

BestSubset grown(SubsetValidation const& validation) {
  int const most = std::min({6, static_cast<int>(validation.sensors()), validation.largest_set()});
  auto best = best_subset(validation, 1);
  for (int count = 2; count <= most; ++count) {
    auto larger = best_subset(validation, count);
    if (!validation.worthwhile(best.rmse, larger.rmse)) break;
    best = std::move(larger);
  }
  return best;
}

}  // namespace

BestSubset best_subset(SubsetValidation const& validation, int count) {
  Index const sensors = validation.sensors();
  if (sensors > largest_exhaustive)
    throw std::invalid_argument(
        fmt::format("{} sensors are too many to try all sets; up to {} (choose some first, or take 'forward')", sensors,
                    largest_exhaustive));
  if (count < 1 || count > sensors)
    throw std::invalid_argument(
        fmt::format("sets of {} among {} sensors; 1 to {} are possible", count, sensors, sensors));
  BestSubset best{{}, unbounded, {}};
  Eigen::VectorXd with = Eigen::VectorXd::Constant(sensors, unbounded), without = with;
  for_each_subset(sensors, count, [&](std::vector<Index> const& set) {
    double const rmse = validation.rmse(set);
    Eigen::Array<bool, Eigen::Dynamic, 1> member = Eigen::Array<bool, Eigen::Dynamic, 1>::Zero(sensors);
    member(set) = true;
    with = member.select(with.cwiseMin(rmse), with);
    without = member.select(without, without.cwiseMin(rmse));
    if (validation.less(rmse, best.rmse)) {
      best.rmse = rmse;
      best.sensors = set;
    }
  });
  for (Index j = 0; j < sensors; ++j)
    if (count == sensors) without(j) = rmse_without(validation, best.sensors, j);
  best.margin = without - with;
  return best;
}

Selection select_exhaustive(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const from = candidates(batches, options);
  require_error_that_moves(from);
  SubsetValidation const validation(from.batches);
  auto best = options.count ? best_subset(validation, *options.count) : grown(validation);
  std::stable_sort(best.sensors.begin(), best.sensors.end(),
                   [&](Index a, Index b) { return best.margin(a) > best.margin(b); });
  return selection(from, best.sensors, best.margin, fmt::format("blocked cross-validation: RMSE {:.3g} µm", best.rmse));
}

}  // namespace thermotwin::models
