#include "scenarios/feed_program.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "thermal/error.h"

namespace thermotwin::scenarios {
namespace {

using thermal::format_quantity;
using thermal::InputError;
namespace dimension = thermal::dimension;

constexpr double most_passes = 1e6;                            ///< of a nut that is followed to and fro
constexpr double rounding = 1e-9;                              ///< of a number of pitches or intervals, of a place [m]
constexpr double most_targets = 1e5, most_measurements = 1e6;  ///< of a laser

struct Stroke {
  double from;
  double to;
  double length() const { return to - from; }
};

Stroke stroke_of(FeedProgram const& program, AxisLimits const& axis) {
  Stroke const stroke{program.stroke_from.value_or(axis.stroke_from), program.stroke_to.value_or(axis.stroke_to)};
  if (stroke.length() <= 0.0) {
    throw InputError("axes." + axis.name + ".stroke_to: " + format_quantity(stroke.to, dimension::length) +
                     " must be beyond stroke_from, " + format_quantity(stroke.from, dimension::length));
  }
  require_on_screw(stroke.from, axis, "axes." + axis.name + ".stroke_from: ");
  require_on_screw(stroke.to, axis, "axes." + axis.name + ".stroke_to: ");
  return stroke;
}

double feed_of(FeedBlock const& block, AxisLimits const& axis, std::string const& place) {
  if (!(block.duration > 0.0)) {
    throw InputError(place + "duration: " + format_quantity(block.duration, dimension::time) + " must be above 0 s");
  }
  if (block.feed && block.of_rapid) throw InputError(place + "feed: give either feed or of_rapid, not both");
  double const share = block.of_rapid.value_or(0.0);
  if (share < 0.0 || share > 1.0) {
    throw InputError(place + "of_rapid: " + thermal::format_number(share) + " must be from 0 to 1");
  }
  double const feed = block.feed.value_or(share * axis.rapid_feed);
  if (feed < 0.0) throw InputError(place + "feed: " + format_quantity(feed, dimension::speed) + " is negative");
  if (feed > axis.rapid_feed) {
    throw InputError(place + "feed: " + format_quantity(feed, dimension::speed) + " is above the axis' rapid feed, " +
                     format_quantity(axis.rapid_feed, dimension::speed));
  }
  return feed;
}

std::vector<Block> feed_blocks(FeedProgram const& program, AxisLimits const& axis) {
  std::string const place = "axes." + program.axis + ".";
  if (program.blocks.empty())
    throw InputError(place + "blocks: the programme is empty; write blocks, or leave the axis out");
  if (program.cycles < 1) throw InputError(place + "cycles: " + std::to_string(program.cycles) + " must be 1 or more");
  std::vector<Block> blocks;
  for (FeedBlock const& block : program.blocks) {
    blocks.push_back({block.duration, feed_of(block, axis, place + "blocks[" + std::to_string(blocks.size()) + "].")});
  }
  return blocks;
}

void check_rest(FeedProgram const& program) {
  std::string const place = "axes." + program.axis + ".";
  if (program.duty && program.dwell) throw InputError(place + "duty: give either duty or dwell, not both");
  if (program.duty && (*program.duty <= 0.0 || *program.duty > 1.0)) {
    throw InputError(place + "duty: " + thermal::format_number(*program.duty) + " must be above 0 and at most 1");
  }
  if (program.dwell && *program.dwell < 0.0) {
    throw InputError(place + "dwell: " + format_quantity(*program.dwell, dimension::time) + " is negative");
  }
}

double duty_at(FeedProgram const& program, Stroke const& stroke, double feed) {
  if (feed == 0.0) return 0.0;
  if (!program.dwell) return program.duty.value_or(1.0);
  double const moving = stroke.length() / feed;
  return moving / (moving + *program.dwell);
}

AxisMotion mean_motion(FeedProgram const& program, Stroke const& stroke, double lead, Signal const& feed) {
  std::vector<double> duties;
  std::vector<double> speeds;
  for (double const v : feed.values()) {
    duties.push_back(duty_at(program, stroke, v));
    speeds.push_back(2.0 * std::numbers::pi * v / lead * duties.back());
  }
  return {feed,
          Signal(feed.times(), duties, Interpolation::step),
          Signal(feed.times(), speeds, Interpolation::step),
          Signal(stroke.from),
          Signal(stroke.to),
          Signal(0.5 * (stroke.from + stroke.to))};
}

/// Lays the nut's way out pass by pass: a straight line to the end of the stroke, a rest, and back.
class Passes {
 public:
  Passes(FeedProgram const& program, Stroke const& stroke) : program_(program), stroke_(stroke), x_(stroke.from) {}

  void run(double feed, double until) {
    while (t_ < until) {
      double const remaining = (outward_ ? stroke_.to - x_ : x_ - stroke_.from);
      move(feed, std::min(t_ + (feed > 0.0 ? remaining / feed : until), until));
      if (feed == 0.0 || t_ >= until) continue;
      x_ = outward_ ? stroke_.to : stroke_.from;
      outward_ = !outward_;
      double const rest = stroke_.length() / feed * (1.0 / duty_at(program_, stroke_, feed) - 1.0);
      if (rest > 0.0) move(0.0, std::min(t_ + rest, until));
    }
  }

  AxisMotion motion(double lead) {
    breakpoint(feeds_.back());
    Signal const feed(times_, feeds_, Interpolation::step);
    Signal const position(times_, positions_, Interpolation::linear);
    return {feed, feed.running(), feed.scaled(2.0 * std::numbers::pi / lead), position, position, position};
  }

 private:
  void breakpoint(double feed) {
    times_.push_back(t_);
    feeds_.push_back(feed);
    positions_.push_back(x_);
  }

  void move(double feed, double until) {
    if (until <= t_) return;
    breakpoint(feed);
    x_ += (outward_ ? feed : -feed) * (until - t_);
    t_ = until;
  }

  FeedProgram const& program_;
  Stroke stroke_;
  double t_ = 0.0;
  double x_;
  bool outward_ = true;
  std::vector<double> times_;
  std::vector<double> feeds_;
  std::vector<double> positions_;
};

AxisMotion resolved_motion(FeedProgram const& program, Stroke const& stroke, double lead, Signal const& feed,
                           double duration) {
  double const passes = feed.integral(duration) / stroke.length();
  if (passes > most_passes) {
    throw InputError("axes." + program.axis + ".resolved: " + thermal::format_number(std::round(passes)) +
                     " passes are too many to follow; leave resolved out");
  }
  Passes way(program, stroke);
  for (std::size_t k = 0; k < feed.times().size(); ++k) {
    double const end = k + 1 < feed.times().size() ? feed.times()[k + 1] : duration;
    way.run(feed.values()[k], std::min(end, duration));
  }
  return way.motion(lead);
}

}  // namespace

void require_on_screw(double x, AxisLimits const& axis, std::string const& place) {
  if (!std::isfinite(axis.screw_length) || (x >= -rounding && x <= axis.screw_length + rounding)) return;
  throw InputError(place + format_quantity(x, dimension::length) + " is not on the screw of axis '" + axis.name +
                   "', which reaches from 0 mm to " + format_quantity(axis.screw_length, dimension::length));
}

std::vector<double> targets(LaserMeasurement const& laser) {
  if (laser.pitch <= 0.0 || laser.to < laser.from) {
    throw InputError("laser: targets from " + format_quantity(laser.from, dimension::length) + " to " +
                     format_quantity(laser.to, dimension::length) + " every " +
                     format_quantity(laser.pitch, dimension::length) +
                     "; the pitch must be above 0 and to beyond from");
  }
  double const all = std::floor((laser.to - laser.from) / laser.pitch + rounding);
  if (!(all <= most_targets))
    throw InputError("laser.pitch: " + format_quantity(laser.pitch, dimension::length) + " makes " +
                     thermal::format_number(all) + " targets; at most " + thermal::format_number(most_targets));
  int const pitches = static_cast<int>(all);
  std::vector<double> result;
  for (int i = 0; i <= pitches; ++i) result.push_back(laser.from + i * laser.pitch);
  return result;
}

std::vector<double> times_every(double interval, double duration) {
  std::vector<double> times;
  for (int i = 0; i * interval <= duration + rounding * interval; ++i)
    times.push_back(std::min(i * interval, duration));
  return times;
}

std::vector<double> measurement_times(LaserMeasurement const& laser, double duration) {
  if (!(laser.interval > 0.0)) {
    throw InputError("laser.interval: " + format_quantity(laser.interval, dimension::time) + " must be above 0 s");
  }
  if (double const all = duration / laser.interval; !(all <= most_measurements))
    throw InputError("laser.interval: " + format_quantity(laser.interval, dimension::time) + " makes " +
                     thermal::format_number(std::round(all)) + " measurements; at most " +
                     thermal::format_number(most_measurements));
  return times_every(laser.interval, duration);
}

AxisMotion axis_motion(FeedProgram const& program, AxisLimits const& axis, double duration) {
  check_rest(program);
  Stroke const stroke = stroke_of(program, axis);
  Signal const feed = schedule(feed_blocks(program, axis), program.cycles, 0.0, duration);
  return program.resolved ? resolved_motion(program, stroke, axis.lead, feed, duration)
                          : mean_motion(program, stroke, axis.lead, feed);
}

AxisMotion axis_at_rest(AxisLimits const& axis) {
  return mean_motion({}, {axis.stroke_from, axis.stroke_to}, axis.lead, Signal(0.0));
}

}  // namespace thermotwin::scenarios
