#include "models/ordered_selection.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdexcept>
#include <vector>

#include "models/candidates.h"
#include "models/class_count.h"
#include "models/linear_regression.h"
#include "models/ranking.h"
#include "models/shared_screen.h"

namespace thermotwin::models {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr double significant_below = 0.05;

/// What the three rules share: the sensors in order, and their partitions.
struct OrderedSensors {
  Candidates from;
  InformationScreen screen;
  std::vector<Index> order;  ///< candidates by rising temperature
  OrderedPartitions partitions;
  std::vector<int> counts;  ///< bends

  /// Of each of k classes the candidate of most information.
  [[nodiscard]] std::vector<Index> sensors(int k) const {
    std::vector<Index> chosen;
    for (auto const& places : partitions.classes(k)) {
      std::vector<Index> members;
      for (Index const place : places) members.push_back(order[static_cast<std::size_t>(place)]);
      std::sort(members.begin(), members.end());
      chosen.push_back(best(screen.information, members));
    }
    return chosen;
  }
};

OrderedSensors ordered_sensors(std::span<Batch const> batches, SelectionOptions const& options) {
  auto from = candidates(batches, options);
  require_error_that_moves(from);
  auto const shared = shared_screen(options);
  auto const& screen = shared->screen(from, options);
  bool const enough = options.count.value_or(0) <= std::ssize(screen.kept);
  auto const& [order, partitions] = shared->ordered(from, options, !enough);
  auto counts = options.count ? std::vector{*options.count} : bends(partitions.loss());
  return {std::move(from), screen, order, partitions, std::move(counts)};
}

ClassCountTrial trial(OrderedSensors const& ordered, int k) {
  ClassCountTrial trial{k, ordered.sensors(k), {}, {}};
  RegressionOptions options;
  for (Index const i : trial.sensors) options.names.push_back(ordered.from.all.sensors[static_cast<std::size_t>(i)]);
  for (auto const& batch : ordered.from.batches) options.run_lengths.push_back(batch.time.size());
  try {
    MatrixXd const rise = ordered.from.all.temperature_rise(Eigen::all, trial.sensors);
    trial.regression = linear_regression(rise, ordered.from.all.error, options);
  } catch (std::invalid_argument const& refusal) {
    trial.obstacle = refusal.what();
  }
  return trial;
}

std::vector<ClassCountTrial> trials(OrderedSensors const& ordered) {
  auto const samples = ordered.from.all.time.size();
  int const fewest = ordered.counts.front();
  if (samples < fewest + 2)
    throw std::invalid_argument(
        fmt::format("batch '{}': {} samples are too few to judge {} classes by regression: at "
                    "least {}",
                    ordered.from.all.name, samples, fewest, fewest + 2));
  std::vector<ClassCountTrial> tried;
  for (int const k : ordered.counts) tried.push_back(trial(ordered, k));
  return tried;
}

Selection chosen(OrderedSensors const& ordered, std::vector<Index> const& sensors, std::string remark,
                 std::vector<ClassCountTrial> const& tried = {}) {
  if (!ordered.screen.remark.empty()) remark += "; " + ordered.screen.remark;
  auto result =
      selection(ordered.from, ranked(ordered.screen.information, sensors), ordered.screen.information, remark);
  result.evidence = evidence_of(ordered.from, ordered.screen);
  for (auto const& one : tried) result.evidence.push_back(evidence_of(one));
  return result;
}

Selection as_asked(OrderedSensors const& ordered, int count) {
  return chosen(ordered, ordered.sensors(count), fmt::format("k = {} as asked", count));
}

std::string by(int k, std::string_view rule, OrderedSensors const& ordered) {
  return fmt::format("k = {} by the {} among {}, N = {}", k, rule, fmt::join(ordered.counts, ", "),
                     ordered.from.all.time.size());
}

}  // namespace

Selection select_by_ordered_clustering_improved(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const ordered = ordered_sensors(batches, options);
  if (options.count) return as_asked(ordered, *options.count);
  auto const tried = trials(ordered);
  auto const verdict = count_by_regression(tried);
  if (!verdict.trial)
    return chosen(ordered, {best(ordered.screen.information, ordered.order)},
                  fmt::format("one sensor, since no number of classes has a regression ({})", verdict.reason), tried);
  auto const& taken = tried[*verdict.trial];
  std::string_view const rule =
      verdict.accepted ? "improved rule" : "improved rule without F and t, which every number fails,";
  return chosen(ordered, taken.sensors, fmt::format("{} ({})", by(taken.k, rule, ordered), verdict.reason), tried);
}

Selection select_by_ordered_clustering_ratio(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const ordered = ordered_sensors(batches, options);
  if (options.count) return as_asked(ordered, *options.count);
  auto const tried = trials(ordered);
  auto const order = counts_by_ratio(ordered.partitions.loss(), ordered.counts);
  auto const significant = [&](int k) {
    auto const found = std::find_if(tried.begin(), tried.end(), [&](auto const& one) { return one.k == k; });
    return found->obstacle.empty() && found->regression.p_F < significant_below;
  };
  auto const first = std::find_if(order.begin(), order.end(), significant);
  int const k = first == order.end() ? order.front() : *first;
  return chosen(ordered, ordered.sensors(k),
                by(k, first == order.end() ? "ratio rule, though no F is significant," : "ratio rule", ordered), tried);
}

Selection select_by_ordered_clustering_slope(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const ordered = ordered_sensors(batches, options);
  if (options.count) return as_asked(ordered, *options.count);
  int const k = count_by_slope(ordered.partitions.loss(), ordered.counts);
  return chosen(ordered, ordered.sensors(k), by(k, "slope rule", ordered));
}

}  // namespace thermotwin::models
