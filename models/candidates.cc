#include "models/candidates.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numeric>
#include <stdexcept>

namespace thermotwin::models {

namespace {

bool moves(Eigen::Ref<Eigen::VectorXd const> const& readings) {
  double const size = readings.cwiseAbs().maxCoeff();
  return readings.maxCoeff() - readings.minCoeff() > 1e-12 * size;
}

std::string left_out(std::vector<std::string> const& still) {
  return still.empty() ? "" : fmt::format("left out, for the readings stand still: {}", fmt::join(still, ", "));
}

}  // namespace

Candidates candidates(std::span<Batch const> batches, SelectionOptions const& options) {
  for (auto const& batch : batches) check(batch);
  Batch const given = stacked(batches);
  if (given.time.size() < 2)
    throw std::invalid_argument(fmt::format("batch '{}': one instant; a selection needs two at least", given.name));
  Candidates result;
  result.sensors = given.temperature_rise.cols();
  std::vector<std::string> still;
  for (Eigen::Index j = 0; j < result.sensors; ++j)
    if (moves(given.temperature_rise.col(j)))
      result.columns.push_back(j);
    else
      still.push_back(given.sensors[static_cast<std::size_t>(j)]);
  result.remark = left_out(still);
  if (result.columns.empty())
    throw std::invalid_argument(fmt::format("batch '{}': no sensor's readings move; nothing to choose", given.name));
  if (options.count && (*options.count < 1 || *options.count > result.count()))
    throw std::invalid_argument(fmt::format("{} sensors are asked for; 1 to {} can be chosen{}{}", *options.count,
                                            result.count(), still.empty() ? "" : "; ", result.remark));
  result.all = with_sensors(given, result.columns);
  for (auto const& batch : batches) result.batches.push_back(with_sensors(batch, result.columns));
  return result;
}

void require_error_that_moves(Candidates const& from) {
  if (!moves(from.all.error))
    throw std::invalid_argument(fmt::format("batch '{}': the error is {} µm throughout; there is nothing to explain",
                                            from.all.name, from.all.error(0)));
}

Selection selection(Candidates const& from, std::vector<Eigen::Index> const& chosen, Eigen::VectorXd const& score,
                    std::string const& remark) {
  Selection result;
  for (auto candidate : chosen) result.sensors.push_back(from.columns[static_cast<std::size_t>(candidate)]);
  result.score.setConstant(from.sensors, std::min(0.0, score.minCoeff()));
  for (Eigen::Index j = 0; j < from.count(); ++j) result.score(from.columns[static_cast<std::size_t>(j)]) = score(j);
  result.remark = remark;
  if (!from.remark.empty()) result.remark += (remark.empty() ? "" : "; ") + from.remark;
  return result;
}

std::vector<Eigen::Index> by_falling_score(Eigen::VectorXd const& score) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(score.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return score(a) > score(b); });
  return order;
}

Eigen::MatrixXd centred(Eigen::MatrixXd const& columns) { return columns.rowwise() - columns.colwise().mean(); }

}  // namespace thermotwin::models
