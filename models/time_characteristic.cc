#include "models/time_characteristic.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "models/candidates.h"
#include "models/time_ranked_clusters.h"

namespace thermotwin::models {

namespace {

/// In units of the resolution, in the direction of the largest change.
Eigen::VectorXd quantised(Eigen::Ref<Eigen::VectorXd const> const& readings, double resolution) {
  Eigen::VectorXd x = readings;
  if (resolution > 0) x = resolution * (readings / resolution).array().round();
  return x.maxCoeff() >= -x.minCoeff() ? x : Eigen::VectorXd(-x);
}

double rank_of(Eigen::VectorXd const& x, TimeRank form) {
  double const maximum = x.maxCoeff();
  if (maximum <= x.minCoeff()) return 0;
  auto const at_maximum = [&](double value) { return value >= maximum - 1e-9 * std::abs(maximum); };
  if (form == TimeRank::at_maximum) return static_cast<double>(std::count_if(x.begin(), x.end(), at_maximum));
  return static_cast<double>(x.end() - std::find_if(x.begin(), x.end(), at_maximum));
}

Selection select(std::span<Batch const> batches, SelectionOptions const& options, TimeRank form) {
  auto const from = candidates(batches, options);
  auto const characteristic = time_characteristic(from.batches, options.resolution, form);
  auto order = order_of(characteristic);
  auto const [count, rule] = count_or_clusters(from, options, ClusterScale::raw);
  order.resize(static_cast<std::size_t>(count));
  bool const separates = characteristic.rank.maxCoeff() > characteristic.rank.minCoeff();
  return selection(from, order, score_of(characteristic),
                   separates ? rule
                             : fmt::format("every sensor has rank {}: only the range of the readings decides{}{}",
                                           characteristic.rank(0), rule.empty() ? "" : "; ", rule));
}

}  // namespace

TimeCharacteristic time_characteristic(Eigen::MatrixXd const& temperature_rise, double resolution, TimeRank form) {
  if (!(resolution >= 0)) throw std::invalid_argument(fmt::format("resolution {} K; it must be ≥ 0", resolution));
  TimeCharacteristic result{Eigen::VectorXd(temperature_rise.cols()), Eigen::VectorXd(temperature_rise.cols())};
  for (Eigen::Index j = 0; j < temperature_rise.cols(); ++j) {
    Eigen::VectorXd const x = quantised(temperature_rise.col(j), resolution);
    result.rank(j) = rank_of(x, form);
    result.range(j) = x.maxCoeff() - x.minCoeff();
  }
  return result;
}

TimeCharacteristic time_characteristic(std::span<Batch const> batches, double resolution, TimeRank form) {
  auto total = time_characteristic(batches.front().temperature_rise, resolution, form);
  for (auto const& batch : batches.subspan(1)) {
    auto const one = time_characteristic(batch.temperature_rise, resolution, form);
    total.rank += one.rank;
    total.range += one.range;
  }
  return total;
}

std::vector<Eigen::Index> order_of(TimeCharacteristic const& characteristic) {
  return by_falling_score(score_of(characteristic));
}

Eigen::VectorXd score_of(TimeCharacteristic const& characteristic) {
  return characteristic.rank + characteristic.range / (1.0 + characteristic.range.maxCoeff());
}

Selection select_by_time_at_maximum(std::span<Batch const> batches, SelectionOptions const& options) {
  return select(batches, options, TimeRank::at_maximum);
}

Selection select_by_first_maximum(std::span<Batch const> batches, SelectionOptions const& options) {
  return select(batches, options, TimeRank::first_maximum);
}

}  // namespace thermotwin::models
