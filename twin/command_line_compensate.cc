#include "twin/command_line_compensate.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <unistd.h>

#include "output/atomic_file.h"
#include "output/dataset_file.h"
#include "thermal/error.h"
#include "thermal/units.h"
#include "twin/command_line_number.h"
#include "twin/compensation/compensate.h"
#include "twin/compensation/compensation_record.h"
#include "twin/compensation/play.h"
#include "twin/error_model_file.h"
#include "twin/file/output_path.h"
#include "twin/progress.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

namespace dimension = thermal::dimension;

constexpr double um_per_m = 1e6;

double um(char const* option, std::string const& text) {
  return um_per_m * option_quantity(option, text, dimension::length);
}

double um_per_s(std::string const& slew) { return um_per_m * option_quantity("--slew", slew, dimension::speed); }

double not_negative(char const* option, std::string const& text, thermal::Dimension expected) {
  double const value = option_quantity(option, text, expected);
  if (!(value >= 0.0))
    throw thermal::InputError(fmt::format("{} {}: a {} of 0 or more is due", option, text, thermal::name_of(expected)));
  return value;
}

/// What both sides of the broker are told.
struct ConnectionArguments {
  BrokerOptions broker;
  Topics topics;
  std::string axis = "X", channel;
  double speed = 1.0;

  void add_to(CLI::App& command);
  void require_topics() const;
  /// What the offset works against.
  [[nodiscard]] std::string displacement() const { return channel.empty() ? "E_" + axis : channel; }
  void check_output(std::string const& output, std::vector<std::filesystem::path> read) const;
};

/// None of `read`, nor of what the broker is met with.
void ConnectionArguments::check_output(std::string const& output, std::vector<std::filesystem::path> read) const {
  for (auto const& file : {broker.password_file, broker.ca_file, broker.certificate_file, broker.key_file})
    read.push_back(file);
  refuse_to_overwrite(output, {}, read);
}

/// Of what a topic is made, + and # are for those who subscribe.
void ConnectionArguments::require_topics() const {
  for (auto const& [option, text] : {std::pair{"--axis", axis}, {"--prefix", topics.prefix}})
    if (text.find_first_of("+#") != std::string::npos)
      throw thermal::InputError(fmt::format("{} '{}': it is a part of topics, so without + and #", option, text));
}

void ConnectionArguments::add_to(CLI::App& command) {
  command.add_option("--broker", broker.url, "mqtt://HOST:1883, or mqtts://HOST:8883 for TLS")->capture_default_str();
  command.add_option("--user", broker.user, "name at the broker");
  command.add_option("--password-file", broker.password_file, "file whose first line is the password");
  command.add_option("--ca", broker.ca_file,
                     "certificates (PEM) that the broker's must come from; default: the system's");
  command.add_option("--certificate", broker.certificate_file, "ours (PEM), where the broker wants one");
  command.add_option("--key", broker.key_file, "of our certificate (PEM)");
  command.add_option("--prefix", topics.prefix, "of all topics")->capture_default_str();
  command.add_option("--axis", axis, "that the offset moves")->capture_default_str();
  command.add_option("--channel", channel, "displacement that the offset works against; default: E_ and the axis");
  command.add_option("--speed", speed, "seconds of the run per second; the same on both sides")->capture_default_str();
}

struct CompensateCommand : ConnectionArguments {
  std::string model, machine, record;
  std::string cycle = "10 s", resolution = "1 um", dead_band = "1 um", slew = "1 um/s", largest = "50 um";
  std::string stale = "60 s", stuck = "10 min", jump = "0.3 K", fastest = "0.02 K/s";
  std::string lowest = "-20 degC", highest = "120 degC", hold = "10 min", fade = "10 min", start = "30 s";

  void add_to(CLI::App& command);
  void operator()(std::atomic<bool> const& stop) const;
  [[nodiscard]] LiveModel live_model() const;
  void check_error(SavedErrorModel const& saved) const;
  [[nodiscard]] CompensationSettings settings() const;
};

void CompensateCommand::add_to(CLI::App& command) {
  auto* saved = command.add_option("--model", model, "saved error model (thermotwin fit)");
  command
      .add_option("--observer", machine, "instead of a model: the machine, file or name, running beside the real one")
      ->excludes(saved);
  ConnectionArguments::add_to(command);
  auto const option = [&](char const* name, std::string& value, char const* meaning) {
    command.add_option(name, value, meaning)->capture_default_str();
  };
  command.add_option("--record", record, "data set (HDF5) of readings, errors and offsets, for `thermotwin view`");
  option("--cycle", cycle, "between two decisions");
  option("--resolution", resolution, "of the controller's origin shift");
  option("--dead-band", dead_band, "smaller changes are not followed");
  option("--slew", slew, "fastest change of the offset");
  option("--largest", largest, "offset of either sign");
  option("--stale", stale, "a sensor is at fault without a message for this time");
  option("--stuck", stuck, "a sensor is at fault that shows one number for this time");
  option("--jump", jump, "change of a reading that noise may make");
  option("--fastest", fastest, "change of a sensor's temperature that the machine can make");
  option("--lowest", lowest, "reading that a sensor may show");
  option("--highest", highest, "reading that a sensor may show");
  option("--hold", hold, "how long the last good offset stands when a sensor fails");
  option("--fade", fade, "and how long it then takes to nothing");
  option("--start", start, "within which every input must come, from the first one on");
}

LiveModel CompensateCommand::live_model() const {
  if (model.empty() && machine.empty())
    throw thermal::InputError("compensate needs --model FILE or --observer MACHINE");
  if (!machine.empty()) return TwinObserver(Machine::read(machine_file(machine)), displacement());
  auto const saved = read_error_model(model);
  check_error(saved);
  tell(error_model_text(saved));
  auto const& first = saved.parts.front();
  if (saved.parts.size() == 1 && !first.beside_twin) return SavedModel(first.model, first.ranges);
  return MeanModel(saved);
}

/// An axis follows the error that it was told to follow.
void CompensateCommand::check_error(SavedErrorModel const& saved) const {
  if (saved.unit != "um")
    throw thermal::InputError(fmt::format("{} predicts {} in {}; the offset of an axis needs a displacement in um",
                                          model, saved.error, saved.unit));
  if (saved.error != displacement())
    throw thermal::InputError(
        fmt::format("{} predicts {}, and axis {} works against {}; give the model of {}, or --channel {} if {} shall "
                    "follow that",
                    model, saved.error, axis, displacement(), displacement(), saved.error, axis));
}

CompensationSettings CompensateCommand::settings() const {
  CompensationSettings result;
  result.shift = {um("--resolution", resolution), um("--dead-band", dead_band), um_per_s(slew),
                  um("--largest", largest)};
  result.watch = {positive_quantity("--stale", stale, dimension::time),
                  positive_quantity("--stuck", stuck, dimension::time),
                  not_negative("--jump", jump, dimension::temperature_difference),
                  not_negative("--fastest", fastest, dimension::temperature_rate),
                  thermal::to_unit(option_temperature("--lowest", lowest), "degC"),
                  thermal::to_unit(option_temperature("--highest", highest), "degC")};
  result.fallback = {not_negative("--hold", hold, dimension::time), not_negative("--fade", fade, dimension::time)};
  return result;
}

void CompensateCommand::operator()(std::atomic<bool> const& stop) const {
  require_topics();
  check_suffix(record, "a data set", {".h5"});
  check_output(record, {model, machine.empty() ? std::filesystem::path() : machine_file(machine)});
  auto const set = settings();
  CompensateOptions options{broker, topics, axis, displacement(), {}, {}, {}};
  options.broker.client = fmt::format("thermotwin-compensate-{}-{}", topics.prefix, axis);
  options.loop = {option_quantity("--cycle", cycle, dimension::time), speed, 0.5 * set.watch.stale_time,
                  positive_quantity("--start", start, dimension::time)};
  options.say = [](std::string const& line) { tell(line + "\n"); };
  Compensator compensator(live_model(), set);
  std::optional<CompensationRecord> recorded;
  if (!record.empty()) {
    recorded.emplace(record, compensator.inputs(), axis, options.say);
    options.record = [&](Decision const& decision, Compensator const& now) { recorded->add(decision, now); };
  }
  auto const summary = compensate(std::move(compensator), options, stop);
  fmt::print("{}", summary_text(summary));
  if (recorded) recorded->finish();
}

struct PlayCommand : ConnectionArguments {
  std::string run, output, largest = "100 um", slew = "5 um/s";
  bool quiet = false;

  void add_to(CLI::App& command);
  void operator()(std::atomic<bool> const& stop) const;
};

void PlayCommand::add_to(CLI::App& command) {
  command.add_option("run", run, "data set (HDF5) to play")->required();
  ConnectionArguments::add_to(command);
  command.add_option("--largest", largest, "offset that this machine accepts")->capture_default_str();
  command.add_option("--slew", slew, "fastest change that this machine makes")->capture_default_str();
  command.add_option("--output,-o", output, "CSV to write: error, offset and what is left");
  command.add_flag("--quiet,-q", quiet, "no progress");
}

void PlayCommand::operator()(std::atomic<bool> const& stop) const {
  require_topics();
  check_suffix(output, "a table", {".csv"});
  check_output(output, {run});
  refuse_to_replace_other_table(output, "table of `play`", [](auto const& line) { return line == played_header; });
  VirtualMachineSettings settings{displacement(), axis, {}, {}};
  settings.limits.largest = um("--largest", largest);
  settings.limits.slew = um_per_s(slew);
  PlayOptions options{broker, topics, speed, 10.0, {}, {}};
  options.broker.client = fmt::format("thermotwin-play-{}-{}-{}", topics.prefix, axis, ::getpid());
  options.say = [](std::string const& line) { tell(line + "\n"); };
  std::optional<Progress> bar;
  if (!quiet) {
    bar.emplace(run);
    options.progress = [&](double share) { bar->show(share); };
  }
  auto const played = play(VirtualMachine(output::read(run), settings, topics), axis, options, stop);
  bar.reset();
  if (!output.empty()) output::write_atomically(output, played_csv(played));
  fmt::print("{}", played_text(played));
  if (stop) throw Interrupted("stopped; what is told is of the rows so far");
}

}  // namespace

void add_compensation_commands(CLI::App& app, std::atomic<bool> const& stop) {
  auto compensate = std::make_shared<CompensateCommand>();
  auto* command = app.add_subcommand("compensate", "tell a controller its thermal error, live, over an MQTT broker");
  compensate->add_to(*command);
  command->callback([compensate, &stop] { (*compensate)(stop); });
  auto play = std::make_shared<PlayCommand>();
  command = app.add_subcommand("play", "a recorded run as a virtual machine that applies the offsets it receives");
  play->add_to(*command);
  command->callback([play, &stop] { (*play)(stop); });
}

}  // namespace thermotwin::twin
