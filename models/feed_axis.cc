#include "models/feed_axis.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void check(AxisRecord const& record) {
  auto const refuse = [&](std::string const& why) {
    throw std::invalid_argument(fmt::format("feed axis record '{}': {}", record.name, why));
  };
  if (record.error.rows() != record.time.size() || record.error.cols() != record.position.size())
    refuse(fmt::format("{} × {} errors for {} instants and {} positions", record.error.rows(), record.error.cols(),
                       record.time.size(), record.position.size()));
  if (!record.error.allFinite() || !record.position.allFinite()) refuse("an error or a position is no number");
  if (record.position.size() < 2 || record.position.maxCoeff() == record.position.minCoeff())
    refuse("a line needs at least two positions");
}

}  // namespace

AxisLines axis_lines(AxisRecord const& record) {
  check(record);
  double const middle = record.position.mean();
  VectorXd const way = record.position.array() - middle;
  AxisLines lines;
  lines.slope = record.error * way / way.squaredNorm();
  lines.intercept = record.error.rowwise().mean() - middle * lines.slope;
  return lines;
}

Batch slope_batch(AxisRecord const& record) {
  return {
      record.name, record.time, record.sensors, record.components, record.temperature_rise, axis_lines(record).slope};
}

double zero_position(std::span<AxisRecord const> records, double share) {
  std::vector<AxisLines> all;
  double steepest = 0;
  for (auto const& record : records) {
    all.push_back(axis_lines(record));
    steepest = std::max(steepest, all.back().slope.cwiseAbs().maxCoeff());
  }
  if (!(steepest > 0)) throw std::invalid_argument("no feed axis record has a slope: the zero position is undefined");
  double sum = 0;
  int count = 0;
  for (auto const& lines : all)
    for (Index i = 0; i < lines.slope.size(); ++i)
      if (std::abs(lines.slope(i)) > share * steepest) {
        sum -= lines.intercept(i) / lines.slope(i);
        ++count;
      }
  return sum / count;
}

MatrixXd FeedAxisModel::predict(AxisRecord const& record) const {
  VectorXd const way = record.position.array() - zero_position;
  return slope.predict(slope_batch(record)) * way.transpose();
}

Metrics FeedAxisModel::at_instant(AxisRecord const& record, Index instant, double from, double to) const {
  MatrixXd const prediction = predict(record);
  std::vector<Index> inside;
  for (Index q = 0; q < record.position.size(); ++q)
    if (record.position(q) >= from && record.position(q) <= to) inside.push_back(q);
  VectorXd const truth = record.error(instant, inside), predicted = prediction(instant, inside);
  return metrics(truth, predicted);
}

}  // namespace thermotwin::models
