#include "models/batch.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <stdexcept>

namespace thermotwin::models {

namespace {

[[noreturn]] void refuse(Batch const& batch, std::string const& why) {
  throw std::invalid_argument(fmt::format("batch '{}': {}", batch.name, why));
}

}  // namespace

void check(Batch const& batch) {
  auto const rows = batch.time.size();
  auto const columns = static_cast<std::size_t>(batch.temperature_rise.cols());
  if (rows == 0) refuse(batch, "no instant at all");
  if (batch.temperature_rise.rows() != rows || batch.error.size() != rows)
    refuse(batch, fmt::format("{} instants, {} rows of temperatures and {} errors; all three must agree", rows,
                              batch.temperature_rise.rows(), batch.error.size()));
  if (batch.sensors.size() != columns || batch.components.size() != columns)
    refuse(batch, fmt::format("{} columns of temperatures, {} sensor names and {} components; all three must agree",
                              columns, batch.sensors.size(), batch.components.size()));
  if (batch.before.rows() > 0 && batch.before.cols() != batch.temperature_rise.cols())
    refuse(batch, fmt::format("{} columns of temperatures, {} of those before it; they must agree", columns,
                              batch.before.cols()));
  if (!batch.before.allFinite()) refuse(batch, "a reading before it is no number");
  std::set<std::string> seen;
  for (auto const& name : batch.sensors)
    if (!seen.insert(name).second) refuse(batch, fmt::format("sensor '{}' occurs twice", name));
  for (Eigen::Index row = 0; row < rows; ++row) {
    if (row > 0 && !(batch.time(row) > batch.time(row - 1)))
      refuse(batch, fmt::format("time does not ascend at row {} ({} s)", row + 1, batch.time(row)));
    if (!std::isfinite(batch.error(row))) refuse(batch, fmt::format("the error in row {} is no number", row + 1));
    for (std::size_t column = 0; column < columns; ++column)
      if (!std::isfinite(batch.temperature_rise(row, static_cast<Eigen::Index>(column))))
        refuse(batch, fmt::format("sensor '{}' has no number in row {}", batch.sensors[column], row + 1));
  }
}

bool same_readings(Batch const& a, Batch const& b) {
  return a.time.size() == b.time.size() && a.time == b.time && a.temperature_rise == b.temperature_rise;
}

bool same_data(Batch const& a, Batch const& b) { return same_readings(a, b) && a.error == b.error; }

Batch stacked(std::span<Batch const> batches) {
  if (batches.empty()) throw std::invalid_argument("no batch at all");
  Batch all = batches.front();
  Eigen::Index rows = 0;
  for (auto const& batch : batches) {
    if (batch.sensors != all.sensors)
      refuse(batch, fmt::format("its sensors ({}) are not those of batch '{}' ({})", fmt::join(batch.sensors, ", "),
                                all.name, fmt::join(all.sensors, ", ")));
    rows += batch.time.size();
  }
  all.before.resize(0, 0);
  all.time.resize(rows);
  all.error.resize(rows);
  all.temperature_rise.resize(rows, batches.front().temperature_rise.cols());
  Eigen::Index row = 0;
  for (auto const& batch : batches) {
    auto const count = batch.time.size();
    all.time.segment(row, count) = batch.time;
    all.error.segment(row, count) = batch.error;
    all.temperature_rise.middleRows(row, count) = batch.temperature_rise;
    row += count;
  }
  return all;
}

Batch with_sensors(Batch const& batch, std::span<Eigen::Index const> sensors) {
  Batch chosen{batch.name, batch.time, {}, {}, {batch.time.size(), static_cast<Eigen::Index>(sensors.size())},
               batch.error};
  chosen.before.resize(batch.before.rows(), chosen.temperature_rise.cols());
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    auto const column = static_cast<std::size_t>(sensors[i]);
    chosen.sensors.push_back(batch.sensors.at(column));
    chosen.components.push_back(batch.components.at(column));
    chosen.temperature_rise.col(static_cast<Eigen::Index>(i)) = batch.temperature_rise.col(sensors[i]);
    if (batch.before.rows() > 0) chosen.before.col(static_cast<Eigen::Index>(i)) = batch.before.col(sensors[i]);
  }
  return chosen;
}

void add_rows(std::vector<Eigen::Index>& run_lengths, Batch const& batch, Eigen::Index rows) {
  if (batch.before.rows() > 0 && !run_lengths.empty())
    run_lengths.back() += rows;
  else
    run_lengths.push_back(rows);
}

std::vector<Eigen::Index> run_lengths(std::span<Batch const> batches) {
  std::vector<Eigen::Index> lengths;
  for (auto const& batch : batches) add_rows(lengths, batch, batch.time.size());
  return lengths;
}

std::vector<Eigen::Index> columns_of(Batch const& batch, std::span<std::string const> names) {
  std::vector<Eigen::Index> columns;
  for (auto const& name : names) {
    auto const found = std::find(batch.sensors.begin(), batch.sensors.end(), name);
    if (found == batch.sensors.end())
      refuse(batch, fmt::format("no sensor '{}'; it has {}", name, fmt::join(batch.sensors, ", ")));
    columns.push_back(found - batch.sensors.begin());
  }
  return columns;
}

}  // namespace thermotwin::models
