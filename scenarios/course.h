#pragma once

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "scenarios/experiment.h"
#include "scenarios/machine_limits.h"
#include "thermal/operating_point.h"

namespace thermotwin::scenarios {

/// Jumps that are as close as this are one: 4.1 min of one record are not quite the 246 s of another [s].
constexpr double same_jump = 1e-6;

/// An experiment on a machine as the course of its input channels, in SI.
///
/// | channel | unit | |
/// |---|---|---|
/// | spindle.speed | rad/s | magnitude |
/// | spindle.running | 1 | 1 while the speed is not zero |
/// | spindle.time_running | s | since the last start; 0 at standstill |
/// | spindle.revolutions | 1 | since the start of the run |
/// | <axis>.feed | m/s | while moving |
/// | <axis>.duty | 1 | share of the time in motion |
/// | <axis>.speed | rad/s | mean magnitude of the screw's speed, duty included: 2π feed/lead · duty |
/// | <axis>.moving_speed | rad/s | magnitude of the screw's speed while moving: 2π feed/lead |
/// | <axis>.running | 1 | 1 while the screw's speed is not zero |
/// | <axis>.stroke_from, <axis>.stroke_to | m | where the nut's heat is spread; equal while the nut is followed |
/// | <axis>.position | m | of the nut; the middle of the stroke unless it is followed |
/// | ambient.temperature | K | at the reference height |
/// | ambient.gradient | K/m | upwards |
/// | ambient.reference_height | m | |
/// | ambient.floor_temperature | K | at the machine's zero, from the three above |
/// | ambient.door | 1 | 1 while a door stands open |
/// | coolant.on, chiller.on, machine.on, servo.on | 1 | 0 or 1 |
/// | coolant.temperature | K | of the supply |
/// | chiller.offset | K | added to the machine's set point |
/// | time_of_day | s | 0 to 86400 |
/// | clock.day_cosine, clock.day_sine | 1 | of 2π time_of_day/86400 s |
///
/// Recorded columns and input programmes replace a channel of the same name, or add one. A replaced spindle.speed,
/// <axis>.feed, <axis>.duty or <axis>.speed carries along what follows from it, whatever its sign.
///
/// Of jumps that are one the last counts: until then every channel is as it was just before the first.
class ExperimentCourse : public thermal::Course {
 public:
  /// Throws InputError that names field, value and what is allowed; for a recording also file, line and column.
  ExperimentCourse(Experiment const& experiment, MachineLimits const& machine);

  [[nodiscard]] std::vector<thermal::InputChannel> const& channels() const override { return channels_; }
  void evaluate(double t, std::span<double> values) const override;
  [[nodiscard]] double next_jump(double t) const override;
  [[nodiscard]] double next_bend(double t) const override;
  [[nodiscard]] double longest_step() const override { return longest_step_; }

 private:
  using Formula = std::function<double(double)>;

  void add_spindle(Experiment const& experiment, MachineLimits const& machine);
  void add_axis(Experiment const& experiment, AxisLimits const& axis);
  void add_screw(AxisMotion const& motion, AxisLimits const& axis);
  void add_ambient(Experiment const& experiment);
  void add_switches(Experiment const& experiment);
  void add_clock(Experiment const& experiment);
  void replace_or_add(DrivenChannel const& driven);
  void add_floor_temperature();
  void sort_times();
  void join_jumps();
  [[nodiscard]] double instant(double t) const;

  void add(thermal::InputChannel channel, Formula formula);
  void add(thermal::InputChannel channel, Signal const& signal);
  void add_times(Signal const& signal);
  void add_jumps(std::vector<double> const& times);

  std::vector<DrivenChannel> driven_;  ///< by recordings and input programmes
  std::vector<thermal::InputChannel> channels_;
  std::vector<Formula> formulas_;
  std::vector<double> jumps_;                      ///< each where the last of those that are one is
  std::vector<std::pair<double, double>> joined_;  ///< first and last of jumps that are one
  std::vector<double> bends_;
  double longest_step_ = std::numeric_limits<double>::infinity();
};

/// The channels that every experiment on such a machine has.
[[nodiscard]] std::vector<thermal::InputChannel> own_channels(MachineLimits const& machine);

}  // namespace thermotwin::scenarios
