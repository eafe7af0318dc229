#include "models/correlation_grouping.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "models/candidates.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double joined_above = 0.9;
constexpr double alike_within = 1e-12;  // of 1: correlations that differ by rounding

/// The sensors, in the order of their score, that are the first of their group.
std::vector<Index> best_of_groups(std::vector<Index> const& groups, Eigen::VectorXd const& score) {
  std::vector<Index> best;
  std::set<Index> seen;
  for (auto sensor : by_falling_score(score))
    if (seen.insert(groups[static_cast<std::size_t>(sensor)]).second) best.push_back(sensor);
  return best;
}

}  // namespace

std::vector<Merge> average_linkage(MatrixXd const& distance) {
  Index const n = distance.rows();
  MatrixXd d = distance;
  d.triangularView<Eigen::Lower>().setConstant(infinite);
  Eigen::VectorXd size = Eigen::VectorXd::Ones(n);
  std::vector<Merge> merges;
  for (Index step = 1; step < n; ++step) {
    Index first = 0, second = 0;
    double const least = d.minCoeff(&first, &second);
    merges.push_back({first, second, least});
    double const share = size(first) / (size(first) + size(second));
    for (Index k = 0; k < n; ++k) {
      double& to_first = d(std::min(k, first), std::max(k, first));
      double& to_second = d(std::min(k, second), std::max(k, second));
      if (k != first && k != second) to_first = share * to_first + (1 - share) * to_second;
      to_second = infinite;
    }
    size(first) += size(second);
  }
  return merges;
}

std::vector<Index> groups_of(std::vector<Merge> const& merges, Index count) {
  std::vector<Index> groups(merges.size() + 1);
  std::iota(groups.begin(), groups.end(), 0);
  for (std::size_t m = 0; m + static_cast<std::size_t>(count) < groups.size(); ++m)
    std::replace(groups.begin(), groups.end(), merges[m].second, merges[m].first);
  std::map<Index, Index> number;
  for (auto& group : groups) group = number.try_emplace(group, static_cast<Index>(number.size())).first->second;
  return groups;
}

Selection select_by_correlation(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const from = candidates(batches, options);
  require_error_that_moves(from);
  MatrixXd const readings = centred(from.all.temperature_rise).colwise().normalized();
  Eigen::VectorXd const error = (from.all.error.array() - from.all.error.mean()).matrix().normalized();
  Eigen::VectorXd score = (readings.transpose() * error).cwiseAbs();
  score = (score.array() > 1.0 - alike_within).select(1.0, score);
  MatrixXd distance = 1.0 - (readings.transpose() * readings).array().abs();
  distance = (distance.array() < alike_within).select(0.0, distance);
  auto const merges = average_linkage(distance);
  auto const far = std::count_if(merges.begin(), merges.end(),
                                 [](Merge const& merge) { return merge.distance > 1.0 - joined_above; });
  auto const count = options.count ? *options.count : far + 1;
  return selection(from, best_of_groups(groups_of(merges, count), score), score,
                   options.count ? "" : fmt::format("{} groups of mean |r| ≥ {}", count, joined_above));
}

}  // namespace thermotwin::models
