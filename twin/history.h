#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "output/dataset.h"
#include "scenarios/experiment.h"
#include "thermal/operating_point.h"
#include "twin/input_motion.h"
#include "twin/machine.h"
#include "twin/room_air.h"

namespace thermotwin::twin {

/// What instruments look at, as weighted sums of node temperatures, in this order: sensors, displacements, and of every
/// ball screw its seats, its reference, its zero and its cells.
[[nodiscard]] std::vector<NodeWeights> watched_sums(Machine const& machine);

/// The noise-free course of everything that an instrument could look at, in SI, one row per look (sampling.h).
class History {
 public:
  /// Of a run through the course, read at the sample times.
  History(Machine const& machine, thermal::Course const& course, std::vector<double> const& sample_times);

  [[nodiscard]] Machine const& machine() const { return *machine_; }
  /// When the machine has to be shown; the sample times are among them.
  [[nodiscard]] std::vector<double> const& looks() const { return looks_; }
  [[nodiscard]] std::vector<double> const& sample_times() const { return samples_; }

  /// Takes the next look, with the inputs of the course and the values of watched_sums at its time. Whether it is a
  /// sample.
  bool add(std::span<double const> inputs, std::span<double const> watched);

  [[nodiscard]] std::size_t rows() const { return rows_; }
  /// Rows of the samples so far.
  [[nodiscard]] std::vector<std::size_t> const& sampled() const { return sampled_; }

  // Over all rows.
  [[nodiscard]] Eigen::VectorXd times() const;
  [[nodiscard]] Eigen::VectorXd sensor_body(std::size_t sensor) const;    ///< temperature of its site [K]
  [[nodiscard]] Eigen::VectorXd sensor_air(std::size_t sensor) const;     ///< at its height [K]
  [[nodiscard]] Eigen::VectorXd displacement(std::size_t channel) const;  ///< [m, rad]
  [[nodiscard]] Eigen::VectorXd spindle_speed() const;                    ///< [rad/s]
  [[nodiscard]] Eigen::VectorXd air() const;                              ///< near the tool [K]

  /// Temperatures of all sensors' sites at one row [K].
  [[nodiscard]] Eigen::VectorXd bodies_at(std::size_t row) const;
  /// E(x) of a ball screw at one row, against its reference [m] (physics.md 3.8).
  [[nodiscard]] double position_error(std::size_t screw, double x, std::size_t row) const;
  /// The displacement channels at one row, displacements, then each ball screw at each of its positions [µm, µrad].
  [[nodiscard]] Eigen::VectorXd displacements_at(std::size_t row) const;

 private:
  using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  [[nodiscard]] Eigen::VectorXd column(std::size_t index) const;
  [[nodiscard]] std::size_t first_displacement() const { return 2 * machine_->sensors.size(); }
  [[nodiscard]] std::size_t first_of_screw(std::size_t screw) const;

  Machine const* machine_;
  std::vector<double> samples_, looks_;
  RoomAir air_;
  std::vector<InputMotion> motions_;  ///< of every displacement
  int speed_;                         ///< place among the channels; −1: not there
  std::vector<double> first_inputs_, first_watched_;
  std::vector<std::size_t> sampled_;
  std::size_t rows_ = 0;
  Values values_;  ///< sites of sensors, air at sensors, displacements, screws, speed, air near the tool
};

/// Names, units and titles of the displacement channels, in the order of their values.
[[nodiscard]] std::vector<output::Channel> displacement_channels(Machine const& machine);

/// InputError for a laser that has nothing to measure on this machine: to be asked before a long run.
void check_laser(Machine const& machine, scenarios::Experiment const& experiment);

/// Looks at a history with the machine's instruments: readings, measured displacements, laser passes.
void measure(History const& history, scenarios::Experiment const& experiment, output::Dataset& dataset);

}  // namespace thermotwin::twin
