#pragma once

#include <Eigen/Core>
#include <vector>

#include "output/dataset.h"
#include "scenarios/experiment.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// The noise-free course of everything that an instrument could look at, in SI, one row per output time.
struct History {
  explicit History(Machine const& machine) : machine(&machine) {}

  Machine const* machine;
  std::vector<double> time;
  std::vector<std::vector<double>> sensor_body;      ///< per row, per sensor: temperature of its site [K]
  std::vector<std::vector<double>> sensor_air;       ///< per row, per sensor: air at its height [K]
  std::vector<std::vector<double>> displacement;     ///< per row, per channel of displacement [m, rad]
  std::vector<std::vector<double>> screw_rise;       ///< per row, cells of all screws one after another [K]
  std::vector<std::vector<double>> screw_seats;      ///< per row, per screw: its seats have parted by [m]
  std::vector<std::vector<double>> screw_reference;  ///< per row, per screw: strain of what it is measured against [1]
  std::vector<double> spindle_speed;                 ///< [rad/s]
  std::vector<double> air;                           ///< near the tool [K]

  [[nodiscard]] Eigen::VectorXd times() const;
  [[nodiscard]] Eigen::VectorXd column(std::vector<std::vector<double>> const& rows, std::size_t index) const;
  /// E(x) of a ball screw at row r, against its reference [m] (physics.md 3.8).
  [[nodiscard]] double position_error(std::size_t screw, double x, std::size_t row) const;
};

/// Names, units and titles of the displacement channels, in the order of their values: displacements, then each ball
/// screw at each of its positions.
[[nodiscard]] std::vector<output::Channel> displacement_channels(Machine const& machine);

/// The values of those channels at one row, in µm and µrad.
[[nodiscard]] Eigen::VectorXd displacement_row(History const& history, std::size_t row);

/// InputError for a laser that has nothing to measure on this machine: to be asked before a long run.
void check_laser(Machine const& machine, scenarios::Experiment const& experiment);

/// Looks at a history with the machine's instruments: readings, measured displacements, laser passes.
void measure(History const& history, scenarios::Experiment const& experiment, output::Dataset& dataset);

}  // namespace thermotwin::twin
