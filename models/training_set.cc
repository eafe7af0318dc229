#include "models/training_set.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "models/quantile.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double uneven_step = 0.01, other_period = 1e-3;

void check_sensors_move(Batch const& all) {
  for (Index j = 0; j < all.temperature_rise.cols(); ++j) {
    auto const column = all.temperature_rise.col(j);
    if (column.maxCoeff() == column.minCoeff())
      throw std::invalid_argument(fmt::format("sensor '{}' does not move: {:.6g} K in all {} samples",
                                              all.sensors[static_cast<std::size_t>(j)], column(0), column.size()));
  }
}

double common_period(std::span<Batch const> batches) {
  double const period = sample_period(batches.front());
  for (auto const& batch : batches)
    if (double const own = sample_period(batch); std::abs(own - period) > other_period * period)
      throw std::invalid_argument(
          fmt::format("batch '{}' has a sample every {:.6g} s, batch '{}' every {:.6g} s; lags "
                      "need one sample period",
                      batch.name, own, batches.front().name, period));
  return period;
}

/// What a method fits of a batch.
Index kept_rows(Batch const& batch, int longest, History history) {
  Index const kept = batch.time.size() - (history == History::dropped ? without_history(batch, longest) : 0);
  if (kept < 1)
    throw std::invalid_argument(
        fmt::format("batch '{}' has {} samples; lags of {} samples need more", batch.name, batch.time.size(), longest));
  return kept;
}

}  // namespace

TrainingSet training_set(std::span<Batch const> batches, std::vector<int> const& lags, History history) {
  for (auto const& batch : batches) check(batch);
  Batch const all = stacked(batches);
  if (all.sensors.empty()) throw std::invalid_argument("no sensor at all");
  check_sensors_move(all);

  int const longest = lags.back();
  int const dropped = history == History::dropped ? longest : 0;
  TrainingSet set{all.sensors, longest > 0 ? common_period(batches) : 0.0, lags, {}, {}, {}, dropped};
  Index rows = 0;
  for (auto const& batch : batches) rows += kept_rows(batch, longest, history);
  set.regressors.resize(rows, all.temperature_rise.cols() * static_cast<Index>(lags.size()));
  set.error.resize(rows);
  Index row = 0;
  for (auto const& batch : batches) {
    Index const kept = kept_rows(batch, longest, history);
    set.regressors.middleRows(row, kept) = with_lags(batch, lags).bottomRows(kept);
    set.error.segment(row, kept) = batch.error.tail(kept);
    add_rows(set.run_lengths, batch, kept);
    row += kept;
  }
  return set;
}

MatrixXd with_lags(Batch const& batch, std::vector<int> const& lags) {
  Index const rows = batch.time.size(), inputs = batch.temperature_rise.cols(), known = batch.before.rows();
  MatrixXd readings(known + rows, inputs);
  if (known > 0) readings.topRows(known) = batch.before;
  readings.bottomRows(rows) = batch.temperature_rise;
  MatrixXd lagged(rows, inputs * static_cast<Index>(lags.size()));
  for (std::size_t l = 0; l < lags.size(); ++l)
    for (Index row = 0; row < rows; ++row)
      lagged.block(row, static_cast<Index>(l) * inputs, 1, inputs) =
          readings.row(std::max<Index>(0, known + row - lags[l]));
  return lagged;
}

Index without_history(Batch const& batch, int lag) { return std::max<Index>(0, lag - batch.before.rows()); }

double sample_period(Batch const& batch) {
  auto const rows = batch.time.size();
  if (rows < 2) throw std::invalid_argument(fmt::format("batch '{}': one instant has no sample period", batch.name));
  double const period = (batch.time(rows - 1) - batch.time(0)) / static_cast<double>(rows - 1);
  std::vector<double> steps;
  for (Index i = 1; i < rows; ++i) steps.push_back(batch.time(i) - batch.time(i - 1));
  double const usual = upper_median(steps);
  for (Index i = 1; i < rows; ++i)
    if (double const step = steps[static_cast<std::size_t>(i - 1)]; std::abs(step - usual) > uneven_step * usual)
      throw std::invalid_argument(
          fmt::format("batch '{}': row {} comes {:.6g} s after the one before, others {:.6g} s; "
                      "lags need even steps (it is the one at {:.6g} s; rows that are left out do not count)",
                      batch.name, i + 1, step, usual, batch.time(i)));
  return period;
}

std::vector<std::string> regressor_names(TrainingSet const& set) {
  std::vector<std::string> names;
  for (int const lag : set.lags)
    for (auto const& input : set.inputs)
      names.push_back(lag == 0 ? input : fmt::format("{}, {} sample{} ago", input, lag, lag == 1 ? "" : "s"));
  return names;
}

void require_samples(TrainingSet const& set, Index needed) {
  if (set.error.size() < needed)
    throw std::invalid_argument(fmt::format("{} samples are too few for {} regressors: at least {}", set.error.size(),
                                            set.regressors.cols(), needed));
}

ErrorModel linear_model(std::string method, TrainingSet const& set, double intercept, VectorXd const& coefficients,
                        double parameters, std::string remark) {
  auto const inputs = static_cast<Index>(set.inputs.size());
  MatrixXd const table = coefficients.reshaped(inputs, static_cast<Index>(set.lags.size()));
  if (set.regressors.cols() >= set.error.size())
    remark += fmt::format("; {} regressors for {} samples", set.regressors.cols(), set.error.size());
  return {
      std::move(method), set.inputs, set.sample_period, parameters, LinearForm{intercept, set.lags, table, set.dropped},
      std::move(remark)};
}

}  // namespace thermotwin::models
