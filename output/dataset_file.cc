#include "output/dataset_file.h"

#include <algorithm>
#include <exception>
#include <fmt/core.h>
#include <utility>

#include "output/atomic_file.h"
#include "output/error.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

constexpr double largest_share_of_run = 0.05;

void set_row(char const* group, std::vector<Channel>& channels, Eigen::VectorXd const& values, Eigen::Index row) {
  if (static_cast<Eigen::Index>(channels.size()) != values.size())
    throw thermal::InputError(
        fmt::format("a row has {} values for {} channels of {}", values.size(), channels.size(), group));
  for (std::size_t i = 0; i < channels.size(); ++i) channels[i].values[row] = values[static_cast<Eigen::Index>(i)];
}

/// Of the place of a partial file: what an interrupted run left there may go, anything else is somebody's.
void refuse_foreign(std::filesystem::path const& partial) {
  if (!std::filesystem::exists(partial)) return;
  try {
    if (!read(partial).complete) return;
  } catch (thermal::InputError const&) {  // no data set at all
  }
  throw OutputError(
      fmt::format("'{}' is not what an interrupted run left, and a run keeps its rows in a file of this name; move it, "
                  "or name another output",
                  partial.string()));
}

}  // namespace

void write(Dataset const& dataset, std::filesystem::path const& path) { write_atomically(path, to_hdf5(dataset)); }

std::filesystem::path partial_of(std::filesystem::path path) { return path += ".partial"; }

DatasetWriter::DatasetWriter(std::filesystem::path path, Dataset head,
                             std::chrono::duration<double> between_checkpoints)
    : path_(std::move(path)), dataset_(std::move(head)), between_checkpoints_(between_checkpoints) {
  dataset_.complete = false;
  if (std::filesystem::is_directory(path_))
    throw OutputError(fmt::format("cannot write '{}': it is a directory", path_.string()));
  refuse_foreign(partial_path());
  fresh_ = !std::filesystem::exists(partial_path());
  if (fresh_) checkpoint();
}

DatasetWriter::~DatasetWriter() {
  if (finished_) return;
  try {
    if (rows_ > rows_saved_) checkpoint();
  } catch (std::exception const&) {  // the partial file stays as it was at the last checkpoint
  }
  std::error_code ignored;
  if (fresh_ && rows_saved_ == 0) std::filesystem::remove(partial_path(), ignored);
}

void DatasetWriter::append(Row const& row) {
  if (rows_ > 0 && row.time_s <= dataset_.time_s[rows_ - 1])
    throw thermal::InputError(
        fmt::format("time must increase strictly, but {} s follows {} s", row.time_s, dataset_.time_s[rows_ - 1]));
  if (rows_ == dataset_.time_s.size()) resize_rows(dataset_, std::max<Eigen::Index>(256, 2 * rows_));
  dataset_.time_s[rows_] = row.time_s;
  set_row("inputs", dataset_.inputs, row.inputs, rows_);
  set_row("readings", dataset_.readings, row.readings, rows_);
  set_row("displacements", dataset_.displacements, row.displacements, rows_);
  set_row("truth readings", dataset_.truth_readings, row.truth_readings, rows_);
  set_row("truth displacements", dataset_.truth_displacements, row.truth_displacements, rows_);
  set_row("heat", dataset_.heat, row.heat, rows_);
  if (dataset_.node_temperatures) {
    if (row.node_temperatures.size() != dataset_.node_temperatures->cols())
      throw thermal::InputError(fmt::format("a row has {} node temperatures for {} nodes", row.node_temperatures.size(),
                                            dataset_.node_temperatures->cols()));
    dataset_.node_temperatures->row(rows_) = row.node_temperatures.transpose();
  }
  ++rows_;
  if (Clock::now() >= next_checkpoint_) checkpoint();
}

void DatasetWriter::set_positioning(std::vector<Positioning> measured, std::vector<Positioning> truth) {
  dataset_.positioning = std::move(measured);
  dataset_.truth_positioning = std::move(truth);
}

void DatasetWriter::set_measured(std::vector<Channel> readings, std::vector<Channel> displacements,
                                 std::vector<Channel> truth_displacements) {
  for (auto const* channels : {&readings, &displacements, &truth_displacements})
    for (auto const& channel : *channels)
      if (channel.values.size() != rows_)
        throw thermal::InputError(
            fmt::format("'{}' has {} values for {} rows", channel.name, channel.values.size(), rows_));
  dataset_.readings = std::move(readings);
  dataset_.displacements = std::move(displacements);
  dataset_.truth_displacements = std::move(truth_displacements);
}

Dataset DatasetWriter::finish(std::map<std::string, std::string> const& provenance) {
  Dataset whole = dataset_;
  resize_rows(whole, rows_);
  for (auto const& [key, text] : provenance) whole.provenance[key] = text;
  whole.complete = true;
  write(whole, path_);
  finished_ = true;
  std::filesystem::remove(partial_path());
  return whole;
}

void DatasetWriter::checkpoint() {
  auto const start = Clock::now();
  Dataset so_far = dataset_;
  resize_rows(so_far, rows_);
  write(so_far, partial_path());
  rows_saved_ = rows_;
  std::chrono::duration<double> const cost = Clock::now() - start;
  auto const pause = std::max(between_checkpoints_, cost / largest_share_of_run);
  bool const always = between_checkpoints_.count() == 0;
  next_checkpoint_ = always ? start : start + std::chrono::duration_cast<Clock::duration>(pause);
}

}  // namespace thermotwin::output
