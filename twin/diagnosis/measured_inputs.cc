#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>

#include "models/quantile.h"
#include "scenarios/course.h"
#include "scenarios/motion_limit.h"
#include "thermal/error.h"
#include "thermal/machine_temperature.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"
#include "twin/diagnosis/input_gap.h"
#include "twin/diagnosis/measured_data.h"
#include "twin/file/tables.h"
#include "twin/needed_channels.h"

namespace thermotwin::twin {
namespace {

using scenarios::SampledInput;
using thermal::InputError;

constexpr double most_revolutions_lost = 0.02;  ///< of all

/// An experiment's own channels that a record may lack.
struct Supposition {
  std::string channel;
  std::string said;  ///< for people
};

std::vector<Supposition> const& suppositions() {
  static std::vector<Supposition> const all = {
      {"machine.on", "the machine is on"},
      {"servo.on", "the drives are on"},
      {"coolant.on", "the coolant is off"},
      {"coolant.temperature", "the coolant is supplied at 20 degC"},
      {"chiller.on", "the chiller may run"},
      {"chiller.offset", "the chiller's set point is the machine's"},
      {"ambient.gradient", "the air is as warm above as below"},
      {"ambient.reference_height", "the air's temperature is that at 1 m"},
      {"ambient.door", "no door is open"},
  };
  return all;
}

SampledInput const* find(std::vector<SampledInput> const& inputs, std::string const& name) {
  auto const found = std::find_if(inputs.begin(), inputs.end(), [&](auto const& input) { return input.name == name; });
  return found == inputs.end() ? nullptr : &*found;
}

bool recorded(SampledInput const& input) {
  return std::any_of(input.values.begin(), input.values.end(), [](double x) { return std::isfinite(x); });
}

/// What follows from other channels; a sampled copy of it would be a coarse one.
bool is_derived(SampledInput const& input, MeasuredData const& data) {
  auto const dot = input.name.find('.');
  std::string const owner = input.name.substr(0, dot),
                    what = dot == std::string::npos ? "" : input.name.substr(dot + 1);
  if (input.name == "ambient.floor_temperature" || input.name == "time_of_day") return true;
  if (owner == "spindle")
    return (what == "running" || what == "time_running" || what == "revolutions") &&
           find(data.inputs, "spindle.speed") != nullptr;
  return what == "running" && find(data.inputs, owner + ".feed") != nullptr;
}

/// The record without which a needed channel is unknown; empty if it can be supposed.
std::string due_for(std::string const& channel, Machine const& machine) {
  if (channel.starts_with("spindle.")) return "spindle.speed";
  if (channel == "ambient.temperature" || channel == "ambient.floor_temperature") return "ambient.temperature";
  for (auto const& axis : machine.limits.axes)
    if (channel.starts_with(axis.name + ".")) return "";
  for (auto const& known : suppositions())
    if (channel == known.channel) return "";
  return channel == "time_of_day" || channel.starts_with("clock.") ? "" : channel;
}

std::vector<std::string> names_of(std::vector<thermal::InputChannel> const& channels) {
  std::vector<std::string> names;
  for (auto const& channel : channels) names.push_back(channel.name);
  return names;
}

/// In words of the measurement file, where the channel is of another dimension than its unit there.
void check_unit(Value const& table, std::string const& name, thermal::Dimension due) {
  if (Value const* value = table.find("value"); value && value->is_text())
    return static_cast<void>(thermal::parse_value(std::get<std::string>(value->content), due));
  Value const* unit = table.find("unit");
  std::string const text = unit && unit->is_text() ? std::get<std::string>(unit->content) : "1";
  try {
    thermal::require_unit(text, due);
  } catch (InputError const& error) {
    bool const share =
        due == thermal::dimension::angular_speed && thermal::dimension_of(text) == thermal::dimension::dimensionless;
    throw InputError(fmt::format("{}; the channel is {}{}", error.what(), name,
                                 share ? scenarios::or_a_factor : std::string_view()));
  }
}

void check_unit_among(std::vector<thermal::InputChannel> const& own, Value const& table, SampledInput const& input) {
  auto const channel = std::find_if(own.begin(), own.end(), [&](auto const& c) { return c.name == input.name; });
  if (channel == own.end()) return;
  auto const due = thermal::dimension_of(channel->unit);
  if (due != thermal::dimension_of(input.unit)) check_unit(table, input.name, due);
}

void check_units(MeasuredData const& data, Machine const& machine) {
  auto const own = scenarios::own_channels(machine.limits);
  for (auto const& input : data.inputs)
    if (auto const table = data.input_tables.find(input.name); table != data.input_tables.end())
      located(table->second, [&] { check_unit_among(own, table->second, input); });
}

/// Of a measurement file, whose names somebody wrote: a name that is nearly one that is read, and not given, is a
/// mistake. Others may belong to what the machine's file does not have yet.
void check_names_of_inputs(MeasuredData const& data, Machine const& machine, std::vector<std::string>& remarks) {
  auto read = names_of(scenarios::own_channels(machine.limits));
  for (auto const& name : needed_channels(machine)) read.push_back(name);
  auto const is_read = [&](std::string const& name) { return std::find(read.begin(), read.end(), name) != read.end(); };
  std::vector<std::string> not_given, unread;
  for (auto const& name : read)
    if (!find(data.inputs, name)) not_given.push_back(name);
  for (auto const& [name, table] : data.input_tables) {
    if (is_read(name)) continue;
    if (auto const near = thermal::meant_name(name, not_given); !near.empty())
      located(data.input_tables, name, [&, &name = name] {
        throw InputError(fmt::format("nothing on '{}' reads '{}'; did you mean '{}'?", machine.name, name, near));
      });
    unread.push_back(name);
  }
  if (!unread.empty())
    remarks.push_back(
        fmt::format("in the data, but nothing on '{}' reads it: {}", machine.name, fmt::join(unread, ", ")));
}

void check_needs(MeasuredData const& data, Machine const& machine) {
  std::vector<std::string> missing, given;
  for (auto const& input : data.inputs) given.push_back(input.name);
  for (auto const& channel : needed_channels(machine)) {
    std::string const due = due_for(channel, machine);
    if (due.empty() || find(data.inputs, due) || find(data.inputs, channel)) continue;
    if (std::find(missing.begin(), missing.end(), due) == missing.end()) missing.push_back(due);
  }
  if (missing.empty()) return;
  auto const known = names_of(scenarios::own_channels(machine.limits));
  std::string hints;  // a name of the machine's file, or of the data, may be misspelt
  for (auto const& name : missing) {
    bool const own = std::find(known.begin(), known.end(), name) != known.end();
    auto const hint = thermal::meant_name(name, own ? given : known);
    if (!hint.empty()) hints += fmt::format("; '{}': {} '{}'?", name, own ? "is it" : "did you mean", hint);
  }
  throw MissingInputs(fmt::format("the machine '{}' needs inputs that the data lack: {}; the data have {}{}",
                                  machine.name, fmt::join(missing, ", "),
                                  given.empty() ? "none" : fmt::format("{}", fmt::join(given, ", ")), hints));
}

void check_motion(MeasuredData const& data, Machine const& machine) {
  for (auto const& input : data.inputs) {
    double largest = 0.0;
    for (double const value : input.values)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    auto const words = scenarios::beyond_limit(input.name, largest, machine.limits, scenarios::overshoot);
    if (!words.empty())
      located(data.input_tables, input.name,
              [&] { throw InputError(fmt::format("input '{}' {}", input.name, words)); });
  }
}

void remark_suppositions(MeasuredData const& data, Machine const& machine, std::vector<std::string>& remarks) {
  auto const needed = needed_channels(machine);
  std::vector<std::string> said;
  for (auto const& known : suppositions()) {
    bool const tried = known.channel == "coolant.temperature" && find(data.inputs, "coolant.on");
    bool const due = tried || std::find(needed.begin(), needed.end(), known.channel) != needed.end();
    if (due && !find(data.inputs, known.channel)) said.push_back(known.said);
  }
  for (auto const& axis : machine.limits.axes) {
    bool const due =
        std::any_of(needed.begin(), needed.end(), [&](auto const& name) { return name.starts_with(axis.name + "."); });
    bool const feed = find(data.inputs, axis.name + ".feed"), speed = find(data.inputs, axis.name + ".speed");
    if (due && !feed && !speed) said.push_back("axis " + axis.name + " stands still");
    if (due && feed != speed && !find(data.inputs, axis.name + ".duty"))
      said.push_back(fmt::format("axis {} moves whenever it has a {}", axis.name, feed ? "feed" : "speed"));
  }
  if (!said.empty()) remarks.push_back(fmt::format("not in the data, and supposed: {}", fmt::join(said, "; ")));
}

/// What the spindle was given between two rows is lost; its counter of revolutions tells.
void remark_revolutions(MeasuredData const& data, std::vector<scenarios::DrivenChannel> const& driven,
                        std::vector<std::string>& remarks) {
  SampledInput const* counter = find(data.inputs, "spindle.revolutions");
  auto const given =
      std::find_if(driven.begin(), driven.end(), [](auto const& d) { return d.channel.name == "spindle.speed"; });
  if (!counter || given == driven.end()) return;
  auto const counted = scenarios::driven_channel(*counter).signal, speed = given->signal.magnitude();
  if (!std::is_sorted(counted.values().begin(), counted.values().end())) return;  // it was set back
  double const from = counted.times().front(), to = counted.times().back();
  double const shown = counted.at(to) - counted.at(from);
  double const made = (speed.integral(to) - speed.integral(from)) / (2.0 * std::numbers::pi);
  if (std::abs(made - shown) <= most_revolutions_lost * std::max(std::abs(made), std::abs(shown))) return;
  remarks.push_back(fmt::format(
      "'spindle.speed' makes {:.0f} revolutions in all, 'spindle.revolutions' {:.0f}: the speed changes between two "
      "rows, where nothing is known of it; rows closer together show what was given",
      made, shown));
}

/// Of the recorded clock [s]: rows may begin before the run, and the first may be empty.
std::optional<double> start_time_of_day(SampledInput const& clock) {
  constexpr double day = 86400.0;
  for (std::size_t i = 0; i < clock.values.size(); ++i) {
    if (!std::isfinite(clock.values[i])) continue;
    double const start = std::fmod(clock.values[i] - clock.times[i], day);
    double const positive = start < 0.0 ? start + day : start;
    return positive < day ? positive : 0.0;
  }
  return std::nullopt;
}

/// A change is where the course jumps: jumps that are one are one change.
void move_to_jumps(std::vector<InputChange>& changes, thermal::Course const& course) {
  for (auto& change : changes) {
    double const jump = course.next_jump(std::nextafter(change.time, -INFINITY));
    if (jump - change.time <= scenarios::same_jump) change.time = jump;
  }
}

}  // namespace

void check_unit_of_channel(Value const& table, SampledInput const& input) {
  check_unit_among(scenarios::own_channels({}), table, input);
}

void leave_out_impossible(SampledInput& input, std::vector<std::string>& remarks) {
  if (!scenarios::is_temperature(input)) return;
  auto const is_impossible = [](double T) { return std::isfinite(T) && !thermal::is_machine_temperature(T); };
  std::vector<double> finite;
  std::copy_if(input.values.begin(), input.values.end(), std::back_inserter(finite),
               [](double T) { return std::isfinite(T); });
  if (finite.empty()) return;
  if (double const usual = models::upper_median(std::move(finite)); is_impossible(usual))
    throw InputError(fmt::format("input '{}' is at {:.2f} degC most of the time; {}", input.name,
                                 thermal::to_unit(usual, "degC"), thermal::machine_temperatures));
  auto const impossible = std::count_if(input.values.begin(), input.values.end(), is_impossible);
  if (impossible == 0) return;
  remarks.push_back(fmt::format("input '{}' has temperatures that no machine meets in {} row{}: left out", input.name,
                                impossible, impossible == 1 ? "" : "s"));
  std::replace_if(input.values.begin(), input.values.end(), is_impossible, NAN);
}

std::vector<std::string> misspelt_inputs(MeasuredData const& data) {
  auto const known = names_of(scenarios::own_channels({}));
  std::vector<std::string> remarks;
  for (auto const& [name, table] : data.input_tables) {
    bool const is_known = std::find(known.begin(), known.end(), name) != known.end();
    auto const near = is_known ? "" : thermal::meant_name(name, known);
    if (!near.empty())
      remarks.push_back(
          fmt::format("{}: input '{}': did you mean '{}'?", place_of(table, "'" + name + "'").text(), name, near));
  }
  return remarks;
}

void add_courses(MeasuredRun& run, MeasuredData data, Machine const& machine) {
  scenarios::Experiment experiment;
  experiment.duration = data.time[data.time.size() - 1];
  experiment.start_time_of_day = data.start_time_of_day.value_or(experiment.start_time_of_day);
  if (SampledInput const* clock = find(data.inputs, "time_of_day"))
    experiment.start_time_of_day = start_time_of_day(*clock).value_or(experiment.start_time_of_day);
  std::erase_if(data.inputs, [](SampledInput const& input) { return !recorded(input); });
  check_names_of_inputs(data, machine, run.remarks);
  check_units(data, machine);
  check_needs(data, machine);
  check_motion(data, machine);
  remark_suppositions(data, machine, run.remarks);
  std::vector<std::vector<RecordGap>> gaps;
  for (auto const& input : data.inputs) {
    if (is_derived(input, data)) continue;
    experiment.driven.push_back(scenarios::driven_channel(input));
    gaps.push_back(gaps_of(input, data.max_gap, experiment.duration));
    if (double const begin = scenarios::recorded_times(input).front(); begin > run.time[0] + data.max_gap)
      run.remarks.push_back(
          fmt::format("'{}' is recorded from {:.2f} h on only; for the readings before that its first "
                      "value is taken",
                      input.name, begin / 3600.0));
    auto const changes = changes_of(input, experiment.driven.back().signal);
    std::copy_if(changes.begin(), changes.end(), std::back_inserter(run.changes), [&](auto const& change) {
      return std::none_of(gaps.back().begin(), gaps.back().end(),
                          [&](RecordGap const& gap) { return gap.to == change.time; });
    });
  }
  remark_revolutions(data, experiment.driven, run.remarks);
  remark_gaps(gaps, experiment, run.remarks);
  run.course = std::make_shared<scenarios::ExperimentCourse const>(experiment, machine.limits);
  move_to_jumps(run.changes, *run.course);
  run.changes = merged(std::move(run.changes));
  add_alternatives(run, gaps, experiment, machine.limits);
  add_other_air(run, experiment, machine.limits);
}

}  // namespace thermotwin::twin
