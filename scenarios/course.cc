#include "scenarios/course.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "scenarios/motion_limit.h"
#include "thermal/error.h"
#include "thermal/machine_temperature.h"
#include "thermal/nearest_name.h"

namespace thermotwin::scenarios {
namespace {

using thermal::InputError;

constexpr double seconds_per_day = 86400.0;
constexpr double rounding_of_share = 1e-9;  ///< of a share that is written in another unit

void check_range(DrivenChannel const& driven, std::string const& place) {
  for (double const value : driven.signal.values())
    if (!thermal::is_machine_temperature(value))
      throw InputError(place + "reaches " + thermal::format_temperature(value) + "; " +
                       std::string(thermal::machine_temperatures));
}

/// As the programmes of an experiment are: air that a machine may stand in, no offset that is a point on the scale.
void check_temperature(DrivenChannel const& driven) {
  std::string const place = "channel '" + driven.channel.name + "': " + driven.channel.description + " ";
  if (driven.absolute_temperature && driven.channel.name == "chiller.offset")
    throw InputError(place + "is in degC; a difference is due, for example \"2 K\"");
  if (driven.channel.name != "ambient.temperature") {
    if (driven.channel.name.ends_with("temperature")) check_range(driven, place);
    return;
  }
  for (double const value : driven.signal.values())
    if (!(value >= coldest_air && value <= hottest_air))
      throw InputError(place + "reaches " + thermal::format_temperature(value) + "; allowed is " +
                       thermal::format_temperature(coldest_air) + " to " + thermal::format_temperature(hottest_air) +
                       "; is its unit right?");
}

/// What is off, on or in between: switches that every experiment has, and what the machine's parts take so.
bool is_switch(std::string const& channel, MachineLimits const& machine) {
  constexpr std::array<std::string_view, 6> own = {"spindle.running", "ambient.door", "coolant.on",
                                                   "chiller.on",      "machine.on",   "servo.on"};
  return std::find(own.begin(), own.end(), channel) != own.end() ||
         std::find(machine.shares.begin(), machine.shares.end(), channel) != machine.shares.end() ||
         std::any_of(machine.axes.begin(), machine.axes.end(),
                     [&](AxisLimits const& axis) { return channel == axis.name + ".running"; });
}

/// What counts, tool changes or revolutions, may be any number. `most`: in place of 1.
void check_switch(DrivenChannel const& driven, MachineLimits const& machine, double most) {
  auto const& [name, unit, description] = driven.channel;
  if (unit != "1" || !is_switch(name, machine)) return;
  for (double const value : driven.signal.values())
    if (!(value >= 1.0 - most - rounding_of_share && value <= most + rounding_of_share))
      throw InputError("channel '" + name + "': " + description + " reaches " + thermal::format_number(value) +
                       "; allowed is 0 (off) to 1 (on); is its unit right?");
}

/// `most`: times what the machine can do.
void check_motion(DrivenChannel const& driven, MachineLimits const& machine, double most) {
  auto const& [name, unit, description] = driven.channel;
  if (auto const words = beyond_limit(name, driven.signal.largest_magnitude(), machine, most); !words.empty())
    throw InputError("channel '" + name + "': " + description + " " + words);
}

/// Whether a channel of another dimension is driven is told by ExperimentCourse::replace_or_add.
void check(DrivenChannel const& driven, MachineLimits const& machine, double most) {
  auto const dimension = thermal::dimension_of(driven.channel.unit);
  if (dimension == thermal::dimension::temperature_difference) return check_temperature(driven);
  check_switch(driven, machine, most);
  check_motion(driven, machine, most);
}

/// The fields of an experiment that drive channels, "inputs[0]." and "recorded[0].columns[1].", in the order in which
/// they do; empty where that is in memory.
std::vector<std::string> driving_fields(Experiment const& experiment) {
  std::vector<std::string> fields(experiment.driven.size());
  for (std::size_t i = 0; i < experiment.inputs.size(); ++i) fields.push_back("inputs[" + std::to_string(i) + "].");
  for (std::size_t r = 0; r < experiment.recorded.size(); ++r)
    for (std::size_t c = 0; c < experiment.recorded[r].columns.size(); ++c)
      fields.push_back("recorded[" + std::to_string(r) + "].columns[" + std::to_string(c) + "].");
  return fields;
}

/// Puts such a field and a key in it, "blocks: ", in front of what `action` complains of.
template <class Action>
void of_field(std::string const& field, std::string const& key, Action action) {
  if (field.empty()) return action();
  try {
    action();
  } catch (InputError const& error) {
    throw InputError(field + key + error.what());
  }
}

void refuse_two_drivers(std::vector<DrivenChannel> const& driven, std::vector<std::string> const& fields) {
  for (auto here = driven.begin(); here != driven.end(); ++here)
    of_field(fields[std::size_t(here - driven.begin())], "channel: ", [&] {
      std::string const& name = here->channel.name;
      if (std::any_of(driven.begin(), here, [&](DrivenChannel const& other) { return other.channel.name == name; }))
        throw InputError("channel '" + name + "' is driven twice, by inputs or recorded columns");
    });
}

std::vector<DrivenChannel> driven_channels(Experiment const& experiment, MachineLimits const& machine) {
  std::vector<DrivenChannel> driven = experiment.driven;
  std::vector<std::string> const fields = driving_fields(experiment);
  for (InputProgram const& program : experiment.inputs) {
    std::string const& field = fields[driven.size()];
    of_field(field, "", [&] { driven.push_back(driven_channel(program, experiment.duration)); });
    of_field(field, "blocks: ", [&] { check(driven.back(), machine, 1.0); });
  }
  for (DrivenChannel& channel : read_recordings(experiment.recorded, experiment.directory, experiment.duration))
    of_field(fields[driven.size()],
             "unit: ", [&] { check(driven.emplace_back(std::move(channel)), machine, overshoot); });
  refuse_two_drivers(driven, fields);
  return driven;
}

Signal const* find(std::vector<DrivenChannel> const& driven, std::string const& name) {
  auto const found =
      std::find_if(driven.begin(), driven.end(), [&](DrivenChannel const& d) { return d.channel.name == name; });
  return found == driven.end() ? nullptr : &found->signal;
}

/// What is derived where the channels are made, as others follow from it.
bool carries_others(std::string const& channel) {
  return channel.ends_with(".speed") || channel.ends_with(".feed") || channel.ends_with(".duty");
}

void check_axes(Experiment const& experiment, MachineLimits const& machine) {
  std::vector<std::string> names;
  for (AxisLimits const& axis : machine.axes) names.push_back(axis.name);
  auto const require_axis = [&](std::string const& axis, std::string const& place) {
    if (std::find(names.begin(), names.end(), axis) != names.end()) return;
    throw InputError(place + ".axis: the machine has no axis '" + axis + "'; " + thermal::did_you_mean(axis, names));
  };
  for (std::size_t i = 0; i < experiment.axes.size(); ++i) {
    require_axis(experiment.axes[i].axis, "axes[" + std::to_string(i) + "]");
    bool const twice = std::any_of(experiment.axes.begin(), experiment.axes.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](FeedProgram const& other) { return other.axis == experiment.axes[i].axis; });
    if (twice)
      throw InputError("axes[" + std::to_string(i) + "].axis: axis '" + experiment.axes[i].axis +
                       "' has two programmes");
  }
  if (experiment.laser) require_axis(experiment.laser->axis, "laser");
}

AxisMotion motion_of(Experiment const& experiment, AxisLimits const& axis) {
  for (FeedProgram const& program : experiment.axes) {
    if (program.axis == axis.name) return axis_motion(program, axis, experiment.duration);
  }
  return axis_at_rest(axis);
}

/// Feed v while moving, share d of the time in motion, and mean |speed| of a screw, ω = 2π v/l · d (physics.md 2.11).
struct ScrewMotion {
  std::function<double(double)> feed, duty, speed;
  struct Part {
    Signal values;
    Signal running = values.running();
  };
  std::vector<Part> signals;  ///< of which it is made: it turns where none is zero
};

/// What is driven of the three carries the others along; a feed or a speed alone is motion all the time that it lasts.
ScrewMotion screw_motion(AxisMotion const& programme, std::optional<Signal> const& feed,
                         std::optional<Signal> const& duty, std::optional<Signal> const& speed, double turn) {
  auto const at = [](Signal const& signal) { return [signal](double t) { return signal.at(t); }; };
  ScrewMotion screw{at(programme.feed), at(programme.duty), at(programme.screw_speed), {}};
  for (auto const& signal : {feed, duty, speed})
    if (signal) screw.signals.push_back({*signal});
  if (!feed && !speed) screw.signals.push_back({programme.feed});
  if (!feed && !duty && !speed) screw.signals.push_back({programme.duty});

  if (duty) screw.duty = at(*duty);
  if (feed)
    screw.feed = at(*feed);
  else if (speed && duty)
    screw.feed = [speed = *speed, duty = *duty, turn](double t) {
      return duty.at(t) > 0.0 ? speed.at(t) / (turn * duty.at(t)) : 0.0;
    };
  else if (speed)
    screw.feed = [speed = *speed, turn](double t) { return speed.at(t) / turn; };
  if (!duty && feed && speed)
    screw.duty = [feed = *feed, speed = *speed, turn](double t) {
      return feed.at(t) > 0.0 ? std::min(1.0, speed.at(t) / (turn * feed.at(t))) : 0.0;
    };
  else if (!duty && (feed || speed))
    screw.duty = [feed = screw.feed](double t) { return feed(t) > 0.0 ? 1.0 : 0.0; };
  if (speed)
    screw.speed = at(*speed);
  else if (feed || duty)
    screw.speed = [feed = screw.feed, duty = screw.duty, turn](double t) { return turn * feed(t) * duty(t); };
  return screw;
}

double next_after(double t, std::vector<double> const& times) {
  auto const next = std::upper_bound(times.begin(), times.end(), t);
  return next == times.end() ? std::numeric_limits<double>::infinity() : *next;
}

}  // namespace

ExperimentCourse::ExperimentCourse(Experiment const& experiment, MachineLimits const& machine) {
  check(experiment);
  check_axes(experiment, machine);
  driven_ = driven_channels(experiment, machine);
  add_spindle(experiment, machine);
  for (AxisLimits const& axis : machine.axes) add_axis(experiment, axis);
  add_ambient(experiment);
  add_switches(experiment);
  add_clock(experiment);
  auto const fields = driving_fields(experiment);
  for (std::size_t i = 0; i < driven_.size(); ++i)
    of_field(fields[i], fields[i].starts_with("inputs") ? "blocks: " : "unit: ", [&] { replace_or_add(driven_[i]); });
  add_floor_temperature();
  sort_times();
  join_jumps();
}

void ExperimentCourse::add_spindle(Experiment const& experiment, MachineLimits const& machine) {
  Signal speed;
  if (experiment.spindle) speed = spindle_speed(*experiment.spindle, machine, experiment.duration);
  if (Signal const* recorded = find(driven_, "spindle.speed")) speed = recorded->magnitude();
  Signal const running = speed.running();
  add({"spindle.speed", "rad/s", "spindle speed"}, speed);
  add({"spindle.running", "1", "1 while the spindle turns"}, running);
  add({"spindle.time_running", "s", "time since the spindle started"},
      [running](double t) { return running.at(t) != 0.0 ? t - running.piece_start(t) : 0.0; });
  add({"spindle.revolutions", "1", "revolutions since the start of the run"},
      [speed](double t) { return speed.integral(t) / (2.0 * std::numbers::pi); });
}

void ExperimentCourse::add_axis(Experiment const& experiment, AxisLimits const& axis) {
  AxisMotion const motion = motion_of(experiment, axis);
  add_screw(motion, axis);
  add({axis.name + ".stroke_from", "m", "near end of the nut's stroke"}, motion.stroke_from);
  add({axis.name + ".stroke_to", "m", "far end of the nut's stroke"}, motion.stroke_to);
  add({axis.name + ".position", "m", "nut position"}, motion.position);
  if (motion.position.times().size() > 1) add_jumps(motion.position.times());  // the integrator meets each reversal
}

void ExperimentCourse::add_screw(AxisMotion const& motion, AxisLimits const& axis) {
  double const turn = 2.0 * std::numbers::pi / axis.lead;
  auto const driven = [&](std::string const& what) {
    Signal const* signal = find(driven_, axis.name + what);
    return signal ? std::optional(signal->magnitude()) : std::nullopt;
  };
  auto const screw = screw_motion(motion, driven(".feed"), driven(".duty"), driven(".speed"), turn);
  add({axis.name + ".feed", "m/s", "feed while moving"}, screw.feed);
  add({axis.name + ".duty", "1", "share of the time in motion"}, screw.duty);
  add({axis.name + ".speed", "rad/s", "mean speed of the screw"}, screw.speed);
  add({axis.name + ".moving_speed", "rad/s", "speed of the screw while moving"},
      [feed = screw.feed, turn](double t) { return turn * feed(t); });
  add({axis.name + ".running", "1", "1 while the screw turns"}, [signals = screw.signals](double t) {
    return std::all_of(signals.begin(), signals.end(), [t](auto const& s) { return s.running.at(t) != 0.0; }) ? 1.0
                                                                                                              : 0.0;
  });
  for (auto const& signal : screw.signals) {
    add_times(signal.values);
    add_jumps(signal.running.jumps());
  }
}

void ExperimentCourse::add_ambient(Experiment const& experiment) {
  Ambient const& ambient = experiment.ambient;
  add({"ambient.temperature", "K", "air temperature at the reference height"},
      [ambient, start = experiment.start_time_of_day](double t) { return air_temperature(ambient, start, t); });
  add({"ambient.gradient", "K/m", "rise of the air temperature with height"}, Signal(ambient.stratification));
  add({"ambient.reference_height", "m", "height of the air temperature"}, Signal(ambient.reference_height));
  add({"ambient.door", "1", "1 while a door stands open"},
      [ambient](double t) { return door_open(ambient, t) ? 1.0 : 0.0; });
  for (DoorOpening const& door : ambient.door_openings) {
    add_jumps({door.time, door.time + door.duration});
    longest_step_ = std::min(longest_step_, 0.5 * door.time_constant);
  }
  if (ambient.air_conditioning) longest_step_ = std::min(longest_step_, ambient.air_conditioning->period / 12.0);
}

void ExperimentCourse::add_switches(Experiment const& experiment) {
  auto const add_switch = [&](std::string const& name, std::string const& field, std::string const& description,
                              std::vector<SwitchBlock> const& blocks, bool afterwards) {
    add({name, "1", description}, switching(blocks, afterwards, experiment.duration, field));
  };
  add_switch("coolant.on", "coolant", "1 while the coolant runs", experiment.coolant.blocks, experiment.coolant.on);
  add({"coolant.temperature", "K", "of the coolant supply"}, Signal(experiment.coolant.temperature));
  add_switch("chiller.on", "chiller", "1 while the chiller may run", experiment.chiller.blocks, experiment.chiller.on);
  add({"chiller.offset", "K", "added to the chiller's set point"}, Signal(experiment.chiller.offset));
  add_switch("machine.on", "power", "1 while the machine is on", experiment.power.blocks, experiment.power.on);
  add_switch("servo.on", "servo", "1 while the drives are on", experiment.servo.blocks, experiment.servo.on);
}

void ExperimentCourse::add_clock(Experiment const& experiment) {
  std::vector<double> times = {0.0};
  std::vector<double> midnights = {-experiment.start_time_of_day};
  for (double next = midnights.front() + seconds_per_day; next <= experiment.duration; next += seconds_per_day) {
    times.push_back(next);
    midnights.push_back(next);
  }
  Signal const last_midnight(times, midnights, Interpolation::step);
  add({"time_of_day", "s", "clock"}, [last_midnight](double t) { return t - last_midnight.at(t); });
  add_jumps(last_midnight.jumps());
  auto const angle = [start = experiment.start_time_of_day](double t) {
    return 2.0 * std::numbers::pi * (start + t) / seconds_per_day;
  };
  add({"clock.day_cosine", "1", "1 at midnight, -1 at noon"}, [angle](double t) { return std::cos(angle(t)); });
  add({"clock.day_sine", "1", "1 at six in the morning"}, [angle](double t) { return std::sin(angle(t)); });
}

void ExperimentCourse::replace_or_add(DrivenChannel const& driven) {
  int const place = index_of(driven.channel.name);
  if (place < 0) return add(driven.channel, driven.signal);
  auto const& known = channels_[std::size_t(place)];
  if (thermal::dimension_of(known.unit) != thermal::dimension_of(driven.channel.unit)) {
    bool const share = driven.channel.unit == "1" && known.unit == "rad/s";
    throw InputError("channel '" + known.name + "': " + driven.channel.description + " is in " + driven.channel.unit +
                     ", the channel in " + known.unit + ", for example \"" +
                     thermal::example_of(thermal::dimension_of(known.unit)) + "\"" +
                     (share ? std::string(or_a_factor) : ""));
  }
  if (carries_others(known.name)) return;
  formulas_[std::size_t(place)] = [signal = driven.signal](double t) { return signal.at(t); };
  add_times(driven.signal);
}

/// From the other channels of the air, which a recording may have replaced, if it is not itself recorded.
void ExperimentCourse::add_floor_temperature() {
  if (find(driven_, "ambient.floor_temperature")) return;
  auto const formula_of = [&](std::string const& name) { return formulas_[std::size_t(index_of(name))]; };
  add({"ambient.floor_temperature", "K", "air temperature at the machine's zero"},
      [temperature = formula_of("ambient.temperature"), gradient = formula_of("ambient.gradient"),
       height = formula_of("ambient.reference_height")](double t) { return temperature(t) - gradient(t) * height(t); });
}

void ExperimentCourse::add(thermal::InputChannel channel, Formula formula) {
  channels_.push_back(std::move(channel));
  formulas_.push_back(std::move(formula));
}

void ExperimentCourse::add(thermal::InputChannel channel, Signal const& signal) {
  add(std::move(channel), [signal](double t) { return signal.at(t); });
  add_times(signal);
}

void ExperimentCourse::add_times(Signal const& signal) {
  add_jumps(signal.jumps());
  auto const bends = signal.bends();
  bends_.insert(bends_.end(), bends.begin(), bends.end());
}

void ExperimentCourse::add_jumps(std::vector<double> const& times) {
  jumps_.insert(jumps_.end(), times.begin(), times.end());
}

void ExperimentCourse::sort_times() {
  std::sort(jumps_.begin(), jumps_.end());
  jumps_.erase(std::unique(jumps_.begin(), jumps_.end()), jumps_.end());
  std::sort(bends_.begin(), bends_.end());
  auto const are_one = [](double a, double b) { return b - a <= same_jump; };
  bends_.erase(std::unique(bends_.begin(), bends_.end(), are_one), bends_.end());
  std::erase_if(bends_, [&](double bend) { return next_after(bend - same_jump, jumps_) <= bend + same_jump; });
}

void ExperimentCourse::join_jumps() {
  std::vector<double> last_of_each;
  for (auto first = jumps_.begin(); first != jumps_.end();) {
    auto last = first;
    while (last + 1 != jumps_.end() && *(last + 1) - *last <= same_jump) ++last;
    if (last != first) joined_.emplace_back(*first, *last);
    last_of_each.push_back(*last);
    first = last + 1;
  }
  jumps_ = std::move(last_of_each);
}

/// The time itself, or between jumps that are one: just before the first.
double ExperimentCourse::instant(double t) const {
  for (auto const& [first, last] : joined_)
    if (t >= first && t < last) return std::nextafter(first, -std::numeric_limits<double>::infinity());
  return t;
}

void ExperimentCourse::evaluate(double t, std::span<double> values) const {
  double const at = instant(t);
  for (std::size_t i = 0; i < formulas_.size(); ++i) values[i] = formulas_[i](at);
}

double ExperimentCourse::next_jump(double t) const { return next_after(t, jumps_); }

double ExperimentCourse::next_bend(double t) const { return next_after(t, bends_); }

std::vector<thermal::InputChannel> own_channels(MachineLimits const& machine) {
  Experiment standstill;
  standstill.duration = 3600.0;
  return ExperimentCourse(standstill, machine).channels();
}

}  // namespace thermotwin::scenarios
