#include "twin/experiment_remarks.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

#include "scenarios/course.h"
#include "scenarios/recorded.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"
#include "twin/experiment_file.h"
#include "twin/needed_channels.h"

namespace thermotwin::twin {
namespace {

constexpr double rounding_of_sum = 1e-9;  ///< of durations

/// The channels that every experiment has, and those that the machine asks for.
std::vector<std::string> channels_known(scenarios::Experiment experiment, Machine const& machine) {
  experiment.recorded.clear();
  experiment.inputs.clear();
  experiment.driven.clear();
  scenarios::ExperimentCourse const own(experiment, machine.limits);
  auto names = needed_channels(machine);
  for (auto const& channel : own.channels()) names.push_back(channel.name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// Finds what is odd, each after the path of its field.
class OddityFinder {
 public:
  OddityFinder(scenarios::Experiment const& experiment, Machine const& machine)
      : experiment_(experiment),
        machine_(machine),
        known_(channels_known(experiment, machine)),
        asked_for_(needed_channels(machine)) {}

  std::vector<std::string> operator()() {
    look_at_sampling();
    look_at_records();
    look_at_inputs();
    look_at_spindle();
    look_at_axes();
    look_at_laser();
    look_at_doors();
    look_at_settings();
    look_at_switch("coolant", experiment_.coolant.blocks, experiment_.coolant.on);
    look_at_switch("chiller", experiment_.chiller.blocks, experiment_.chiller.on);
    look_at_switch("power", experiment_.power.blocks, experiment_.power.on);
    look_at_switch("servo", experiment_.servo.blocks, experiment_.servo.on);
    return std::move(found_);
  }

 private:
  static std::string text(double seconds) { return thermal::format_quantity(seconds, thermal::dimension::time); }

  void look_at_sampling() {
    double const last = scenarios::sample_times(experiment_).back();
    if (last < experiment_.duration)
      found_.push_back(
          fmt::format("sampling: the last row is at {}, and the run ends at {}; what comes later is left out",
                      text(last), text(experiment_.duration)));
  }

  void look_at_records() {
    auto const& recorded = experiment_.recorded;
    auto const tables = scenarios::read_tables(recorded, experiment_.directory, experiment_.duration);
    auto const driven = scenarios::driven_channels(recorded, tables);
    std::size_t next = 0;
    for (std::size_t r = 0; r < recorded.size(); ++r) {
      for (auto const& remark : {tables[r].clock_remark, tables[r].repeats_remark})
        if (!remark.empty()) found_.push_back(remark);
      look_at_end_of_record(r, tables[r].times);
      for (std::size_t c = 0; c < recorded[r].columns.size(); ++c) {
        std::string const column = fmt::format("recorded[{}].columns[{}].", r, c);
        look_at_channel(column + "channel", recorded[r].columns[c].channel);
        look_at_changes(column + "column", driven[next++].signal);
      }
    }
  }

  /// A row stands for as long as it is from the row before.
  void look_at_end_of_record(std::size_t record, std::vector<double> const& times) {
    double const last = times.back(), row = times.size() > 1 ? last - times[times.size() - 2] : 0.0;
    if (experiment_.duration - last > row * (1.0 + rounding_of_sum))
      found_.push_back(
          fmt::format("recorded[{}].file: it ends at {}, and the run at {}; until then its last values hold", record,
                      text(last), text(experiment_.duration)));
  }

  void look_at_inputs() {
    for (std::size_t i = 0; i < experiment_.inputs.size(); ++i) {
      auto const& programme = experiment_.inputs[i];
      look_at_channel(fmt::format("inputs[{}].channel", i), programme.channel);
      look_at_changes(fmt::format("inputs[{}].blocks", i),
                      scenarios::driven_channel(programme, experiment_.duration).signal);
    }
  }

  void look_at_spindle() {
    if (!experiment_.spindle) return;
    auto const& spindle = *experiment_.spindle;
    look_for_reader("spindle", "spindle.");
    look_at_blocks("spindle.blocks", spindle.blocks, spindle.cycles);
    look_at_changes("spindle", scenarios::spindle_speed(spindle, machine_.limits, experiment_.duration));
  }

  /// Of a nut that is followed, the passes are not asked for.
  void look_at_axes() {
    for (std::size_t a = 0; a < experiment_.axes.size(); ++a) {
      auto programme = experiment_.axes[a];
      look_for_reader(fmt::format("axes[{}].axis", a), programme.axis + ".");
      look_at_blocks(fmt::format("axes[{}].blocks", a), programme.blocks, programme.cycles);
      auto const axis = std::find_if(machine_.limits.axes.begin(), machine_.limits.axes.end(),
                                     [&](auto const& one) { return one.name == programme.axis; });
      programme.resolved = false;
      look_at_changes(fmt::format("axes[{}].blocks", a),
                      scenarios::axis_motion(programme, *axis, experiment_.duration).feed,
                      ", or one block with a `duty`,");
    }
  }

  /// Of all the channels that begin so.
  void look_for_reader(std::string const& path, std::string const& channel) {
    bool const read = std::any_of(asked_for_.begin(), asked_for_.end(),
                                  [&](std::string const& name) { return name.starts_with(channel); });
    if (!read)
      found_.push_back(fmt::format("{}: nothing on '{}' reads '{}'; it changes nothing", path, machine_.name,
                                   channel.ends_with('.') ? channel + "…" : channel));
  }

  /// What is switched to and fro is let be: so one looks for what the machine's file lacks.
  void look_at_settings() {
    auto const& [coolant, chiller, power, servo] =
        std::tie(experiment_.coolant, experiment_.chiller, experiment_.power, experiment_.servo);
    if (coolant.blocks.empty() && coolant.on) look_for_reader("coolant.on", "coolant.on");
    if (coolant.blocks.empty() && coolant.temperature != scenarios::Coolant().temperature)
      look_for_reader("coolant.temperature", "coolant.temperature");
    if (chiller.blocks.empty() && !chiller.on) look_for_reader("chiller.on", "chiller.on");
    if (chiller.blocks.empty() && chiller.offset != 0.0) look_for_reader("chiller.offset", "chiller.offset");
    if (power.blocks.empty() && !power.on) look_for_reader("power.on", "machine.on");
    if (servo.blocks.empty() && !servo.on) look_for_reader("servo.on", "servo.on");
  }

  /// Targets count from the start of the stroke.
  void look_at_laser() {
    if (!experiment_.laser) return;
    auto const& laser = *experiment_.laser;
    auto const length = [](double x) { return fmt::format("{:g} mm", 1e3 * x); };
    for (auto const& axis : machine_.limits.axes) {
      if (axis.name != laser.axis) continue;
      double const stroke = axis.stroke_to - axis.stroke_from;
      auto const look = [&](std::string const& key, double target) {
        if (target >= -rounding_of_sum && target <= stroke + rounding_of_sum) return;
        found_.push_back(fmt::format("laser.{}: the target {} is outside the stroke of axis '{}', 0 mm to {}", key,
                                     length(target), axis.name, length(stroke)));
      };
      auto const targets = scenarios::targets(laser);
      look("from", targets.front());
      if (targets.size() > 1) look("to", targets.back());
    }
  }

  void look_at_doors() {
    auto const& doors = experiment_.ambient.door_openings;
    for (std::size_t d = 0; d < doors.size(); ++d)
      if (doors[d].time >= experiment_.duration)
        found_.push_back(fmt::format("ambient.door_openings[{}].time: it opens at {}, and the run ends at {}", d,
                                     text(doors[d].time), text(experiment_.duration)));
  }

  void look_at_switch(std::string const& name, std::vector<scenarios::SwitchBlock> const& blocks, bool afterwards) {
    look_at_changes(name + ".blocks", scenarios::switching(blocks, afterwards, experiment_.duration, name));
  }

  /// A row shows what an input is then: of several changes since the row before, the last.
  void look_at_changes(std::string const& path, scenarios::Signal const& signal, std::string const& instead = "") {
    auto const changes = signal.jumps();
    auto const shown_in = [&](double time) { return std::ceil(time / experiment_.sampling - rounding_of_sum); };
    std::size_t hidden = 0;
    double shortest = experiment_.sampling;
    for (std::size_t i = 1; i < changes.size() && changes[i] <= experiment_.duration; ++i) {
      if (shown_in(changes[i]) == shown_in(changes[i - 1])) ++hidden;
      shortest = std::min(shortest, changes[i] - changes[i - 1]);
    }
    if (hidden == 0) return;
    found_.push_back(fmt::format(
        "{}: {} of {} changes are followed by another one before the next row, and the inputs in the data lack them; "
        "a `sampling` of {} or less{} shows what was given",
        path, hidden, changes.size(), text(shortest), instead));
  }

  void look_at_channel(std::string const& path, std::string const& channel) {
    if (std::binary_search(known_.begin(), known_.end(), channel)) return;
    found_.push_back(fmt::format("{}: nothing on '{}' reads '{}'; {}", path, machine_.name, channel,
                                 thermal::did_you_mean(channel, known_)));
  }

  template <class Block>
  void look_at_blocks(std::string const& path, std::vector<Block> const& blocks, int cycles) {
    double length = 0.0;
    for (auto const& block : blocks) length += cycles * block.duration;
    if (length <= experiment_.duration * (1.0 + rounding_of_sum)) return;
    found_.push_back(fmt::format("{}: they last {} in all, and the run {}; what comes later is left out", path,
                                 text(length), text(experiment_.duration)));
  }

  scenarios::Experiment const& experiment_;
  Machine const& machine_;
  std::vector<std::string> known_;  ///< in order
  std::vector<std::string> asked_for_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> experiment_remarks(Value const& document, scenarios::Experiment const& experiment,
                                            Machine const& machine) {
  auto remarks = OddityFinder(experiment, machine)();
  for (auto& remark : remarks) remark = located_in(document, thermal::InputError(remark)).what();
  return remarks;
}

}  // namespace thermotwin::twin
