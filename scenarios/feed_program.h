#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/field.h"
#include "scenarios/machine_limits.h"
#include "scenarios/signal.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {

/// Reciprocation at one feed for a while. Without `feed` and `of_rapid` the axis stands still.
struct FeedBlock {
  double duration = required;      ///< [s] > 0
  std::optional<double> feed;      ///< [m/s], 0 to the axis' rapid feed
  std::optional<double> of_rapid;  ///< share of the rapid feed, 0 to 1

  template <class Fields>
  static void fields(Fields& f) {
    f("duration", &FeedBlock::duration, thermal::dimension::time, "how long the axis goes to and fro",
      {0.0, unbounded});
    f("feed", &FeedBlock::feed, thermal::dimension::speed, "feed; without any feed: standstill", {0.0, unbounded});
    f("of_rapid", &FeedBlock::of_rapid, thermal::dimension::dimensionless,
      "share of the axis' rapid feed, instead of feed", {0.0, 1.0});
  }
};

/// An axis going to and fro between the ends of its stroke.
///
/// Mean |screw speed| = 2π v/l · d, duty d = t_move/(t_move + t_dwell), ramps counted as dwell. (physics.md 2.11)
/// As a rule the model sees the mean over the stroke, good while a pass takes less than a twentieth of the screw's time
/// constant (physics.md 2.10); `resolved` follows the nut to and fro.
struct FeedProgram {
  std::string axis = "z";
  std::vector<FeedBlock> blocks;
  int cycles = 1;                     ///< how often the blocks are run through
  std::optional<double> stroke_from;  ///< ends of the nut's stroke [m]; default: the machine's
  std::optional<double> stroke_to;
  std::optional<double> duty;   ///< share of the time in motion, 0 < d <= 1; default 1
  std::optional<double> dwell;  ///< rest at each end of the stroke [s], instead of duty
  bool resolved = false;

  template <class Fields>
  static void fields(Fields& f) {
    f("axis", &FeedProgram::axis, "name of the axis");
    f("blocks", &FeedProgram::blocks, "feeds one after another; afterwards standstill");
    f("cycles", &FeedProgram::cycles, "how often the blocks are run through");
    f("stroke_from", &FeedProgram::stroke_from, thermal::dimension::length,
      "first end of the nut's stroke; default: the machine's");
    f("stroke_to", &FeedProgram::stroke_to, thermal::dimension::length,
      "other end of the nut's stroke; default: the machine's");
    f("duty", &FeedProgram::duty, thermal::dimension::dimensionless, "share of the time in motion; default 1",
      {0.0, 1.0});
    f("dwell", &FeedProgram::dwell, thermal::dimension::time, "rest at each end of the stroke, instead of duty",
      {0.0, unbounded});
    f("resolved", &FeedProgram::resolved, "follow the nut to and fro instead of the mean over the stroke");
  }
};

/// When and where a laser interferometer measures the position error of an axis.
struct LaserMeasurement {
  std::string axis = "z";
  double interval = 15 * 60.0;  ///< from the start on [s]
  double from = 0.0;            ///< first target, from the start of the stroke [m]
  double to = 0.6;              ///< last target [m]
  double pitch = 0.05;          ///< between targets [m]
  bool both_directions = true;  ///< targets approached from either side

  template <class Fields>
  static void fields(Fields& f) {
    f("axis", &LaserMeasurement::axis, "name of the axis");
    f("interval", &LaserMeasurement::interval, thermal::dimension::time, "time between measurements, from the start on",
      {0.0, unbounded});
    f("from", &LaserMeasurement::from, thermal::dimension::length, "first target, from the start of the stroke");
    f("to", &LaserMeasurement::to, thermal::dimension::length, "last target, from the start of the stroke");
    f("pitch", &LaserMeasurement::pitch, thermal::dimension::length, "distance between targets", {0.0, unbounded});
    f("both_directions", &LaserMeasurement::both_directions, "targets approached from either side");
  }
};

/// InputError for a place of the nut, x from the start of the screw [m], beyond the screw's ends; `place`: of the
/// number.
void require_on_screw(double x, AxisLimits const& axis, std::string const& place);

/// 0, interval, 2 interval, … up to the duration [s], which is the last if it is a whole number of intervals but for
/// rounding.
std::vector<double> times_every(double interval, double duration);

/// The targets from `from` to `to` [m], and the times of measurement from 0 to `duration` [s].
std::vector<double> targets(LaserMeasurement const& laser);
std::vector<double> measurement_times(LaserMeasurement const& laser, double duration);

/// How one axis moves.
struct AxisMotion {
  Signal feed;         ///< while moving [m/s]
  Signal duty;         ///< share of the time in motion; 0 at standstill
  Signal screw_speed;  ///< mean |angular speed| of the screw [rad/s]
  Signal stroke_from;  ///< the nut's heat is spread over this interval [m]; resolved: both are its position
  Signal stroke_to;
  Signal position;  ///< of the nut [m]; not resolved: the middle of the stroke
};

/// The motion from 0 to `duration` [s]. Throws InputError naming the block.
AxisMotion axis_motion(FeedProgram const& program, AxisLimits const& axis, double duration);

/// An axis that nothing moves.
AxisMotion axis_at_rest(AxisLimits const& axis);

}  // namespace thermotwin::scenarios
