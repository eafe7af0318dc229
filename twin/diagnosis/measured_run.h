#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/dataset.h"
#include "thermal/error.h"
#include "thermal/operating_point.h"
#include "twin/diagnosis/input_change.h"
#include "twin/diagnosis/warm_start.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// What one of the machine's channels showed, in SI: temperatures in K, displacements in m, rotations in rad.
struct MeasuredChannel {
  std::string name;  ///< of a sensor, or of a displacement channel of the machine
  bool displacement = false;
  Eigen::VectorXd values;         ///< NaN: missing
  std::string clock = {};         ///< of its logger, where that is not the one that recorded what is switched
  std::optional<double> still{};  ///< what it showed where all its readings were one value, and `values` are missing
  std::optional<double> dead_from{};  ///< from when on it moved no more [s]; `values` are missing from there
};

/// What the machine may have been given instead where its inputs were not recorded, or late.
struct AlternativeCourse {
  std::string name;  ///< "spindle.speed from 6.00 h to 7.60 h, first half"
  std::shared_ptr<thermal::Course const> course;
  double deviation = 0.0;  ///< of the share of what channels show more with it
  bool for_drawn = false;  ///< only where the machine's structural loop is known (has_drawings)
};

/// One run to calibrate or diagnose with: the inputs that the machine was given, and what its channels showed.
struct MeasuredRun {
  std::string name;
  std::shared_ptr<thermal::Course const> course;
  /// Two of each gap in what is held between rows, one of each half; and those of the air.
  std::vector<AlternativeCourse> alternatives;
  std::vector<InputChange> changes;           ///< when its inputs changed, as far as the record tells
  Eigen::VectorXd time;                       ///< [s], strictly increasing
  std::vector<MeasuredChannel> channels;      ///< those of the machine that the data have, in the machine's order
  std::optional<double> initial_temperature;  ///< of the whole machine [K]; default: that of the air around each part
  std::optional<WarmStart> warm_start;        ///< how far its parts were from that
  std::vector<std::string> remarks;  ///< for people: another machine, dead sensors, gaps, channels that the data lack

  /// One of the inputs at these times [SI]; empty where the course does not have it.
  [[nodiscard]] Eigen::VectorXd input(std::string_view name, Eigen::VectorXd const& times) const;
  /// Says so in the remarks where there is any.
  void begin_with(std::optional<WarmStart> warmth);
  /// What a channel, by its number, read where the run began [SI]; NaN where that has a past before any reading.
  [[nodiscard]] double first_reading(Eigen::Index channel) const;
};

/// v450_fine is v450 in more cells.
[[nodiscard]] bool is_same_machine(std::string const& one, std::string const& other);

/// The median time between neighbours [s]; infinite for fewer than two.
[[nodiscard]] double usual_interval(std::span<double const> times);

/// What is wrong in a file, for whoever reads it is told its place.
template <class Action>
auto naming(std::filesystem::path const& path, Action action) {
  try {
    return action();
  } catch (thermal::InputError const& error) {
    std::string const message = error.what();
    if (message.find(path.string()) != std::string::npos) throw;
    throw thermal::InputError(path.string() + ": " + message);
  }
}

/// A data set (`.h5` as `run -o` writes it, `.csv` as `export` does) or a measurement file (`.toml`), which maps the
/// columns of a table to inputs and channels. InputError when the inputs that the machine needs are not in it, or none
/// of its channels, or when units contradict.
[[nodiscard]] MeasuredRun read_measured_run(std::filesystem::path const& path, Machine const& machine);

/// A data set in memory: its inputs become the course, its readings and displacements the channels.
[[nodiscard]] MeasuredRun measured_run(output::Dataset const& dataset, Machine const& machine, std::string const& name);

}  // namespace thermotwin::twin
