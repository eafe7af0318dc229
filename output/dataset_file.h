#pragma once

#include <Eigen/Core>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "output/dataset.h"

namespace thermotwin::output {

/// Data sets as HDF5 that others can open (xarray with `engine="h5netcdf"`, netCDF4, h5py, MATLAB, ParaView).
///
/// | place                              | holds                                                              |
/// |------------------------------------|--------------------------------------------------------------------|
/// | `/`                                | attributes `title`, `Conventions`, `source`, `complete` (0: partial) |
/// | `/time`                            | s from the start; the dimension `time` of everything below         |
/// | `/inputs`, `/readings`,            | a variable per channel, double, missing = NaN                      |
/// | `/displacements`, `/heat`          |                                                                    |
/// | `/truth/readings`, …               | the same without noise                                             |
/// | `/positioning/<axis>`,             | `forward`, `backward` [um] over `pass_time` [s] × `position` [mm]  |
/// | `/truth/positioning/<axis>`        |                                                                    |
/// | `/nodes`                           | `temperature` [degC], float, over `time` × `node`, with the names  |
/// | `/provenance`                      | attributes; a text beyond 60,000 bytes is a variable               |
///
/// Every variable has `units` and `long_name`. Each group shows `time` too (a link, no copy), so that opening one group
/// alone gives its time axis. Channels keep their order. The same data give the same bytes: no dates are stored.

/// Replaces `path` by this data set, atomically. OutputError when it cannot be written, thermal::InputError when the
/// data set cannot be: lengths that do not fit, a name twice in a group, a name with '/'.
void write(Dataset const& dataset, std::filesystem::path const& path);

/// The inverse of `write`. thermal::InputError with file and reason when it is no data set or is damaged.
[[nodiscard]] Dataset read(std::filesystem::path const& path);

/// Without reading the rest; empty where that is no data set, or not there.
[[nodiscard]] std::map<std::string, std::string> provenance_in(std::filesystem::path const& path);

/// The file's bytes, before they are anywhere.
[[nodiscard]] std::string to_hdf5(Dataset const& dataset);

/// All channels at one time, in the order of the data set's channels. What the data set does not have stays empty.
struct Row {
  double time_s = 0.0;
  Eigen::VectorXd inputs, readings, displacements, truth_readings, truth_displacements, heat;
  Eigen::VectorXf node_temperatures;
};

/// Where the rows of a data set stand while it grows: `<path>.partial`.
[[nodiscard]] std::filesystem::path partial_of(std::filesystem::path path);

/// A data set that grows while a run goes on.
///
/// The rows so far stand in `<path>.partial`, a whole data set with `complete` = 0, replaced atomically every few
/// seconds (and never so often that it would take more than a twentieth of the run). So a run killed at any moment
/// leaves the old `path` untouched and beside it a readable file that says it is partial. `finish` replaces `path` and
/// removes the partial file. A writer destroyed without `finish` (the run failed) leaves its rows in the partial file;
/// without any row it leaves what was there.
class DatasetWriter {
 public:
  /// `head` has everything but the rows: title, channels, node names, provenance so far; its time is empty.
  /// Writes the empty partial file at once, so that a directory that cannot be written is told before the run; a
  /// partial file of an interrupted run stays until the first row takes its place. OutputError when anything else has
  /// that name. With no time between checkpoints every row is one.
  DatasetWriter(std::filesystem::path path, Dataset head,
                std::chrono::duration<double> between_checkpoints = std::chrono::seconds(5));
  ~DatasetWriter();
  DatasetWriter(DatasetWriter const&) = delete;
  DatasetWriter& operator=(DatasetWriter const&) = delete;

  /// Time must be later than the last row's. thermal::InputError when a part has not as many values as channels.
  void append(Row const& row);

  /// What the instruments showed, once the whole course is known; until then those channels are missing (NaN). A nest
  /// of probes adds channels of its own, and their truth.
  /// Every channel must have a value for each row so far; thermal::InputError otherwise.
  void set_measured(std::vector<Channel> readings, std::vector<Channel> displacements,
                    std::vector<Channel> truth_displacements);
  void set_positioning(std::vector<Positioning> measured, std::vector<Positioning> truth);

  /// Writes the file with what became known at the end (solver summary, energy balance) and gives the data set back.
  Dataset finish(std::map<std::string, std::string> const& provenance = {});

  [[nodiscard]] std::filesystem::path partial_path() const { return partial_of(path_); }

 private:
  void checkpoint();

  using Clock = std::chrono::steady_clock;

  std::filesystem::path path_;
  Dataset dataset_;  ///< columns longer than the rows so far, to grow seldom
  Eigen::Index rows_ = 0;
  Eigen::Index rows_saved_ = 0;
  std::chrono::duration<double> between_checkpoints_;
  Clock::time_point next_checkpoint_;
  bool fresh_ = false;  ///< there was no partial file before
  bool finished_ = false;
};

}  // namespace thermotwin::output
