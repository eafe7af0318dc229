#include "twin/setting.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>
#include <utility>

#include "scenarios/programmed_channels.h"
#include "thermal/error.h"
#include "twin/file/schema.h"
#include "twin/machine.h"
#include "twin/machine_tables.h"

namespace thermotwin::twin {
namespace {

constexpr std::string_view experiment_prefix = "experiment.";

/// What the table at a path of an experiment may hold; nothing where none can be.
std::vector<FieldRecord> fields_at(std::vector<std::string> const& path) {
  auto fields = list_fields<scenarios::Experiment>();
  for (auto const& part : path) {
    auto const field = std::find_if(fields.begin(), fields.end(), [&](auto const& f) { return f.key == part; });
    if (field == fields.end() || !field->kind.starts_with("table")) return {};
    fields = std::vector<FieldRecord>(field->nested);
  }
  return fields;
}

/// Puts the tables on a path that an experiment may have and this one lacks: [coolant] of "coolant.on". A campaign
/// comes here for every setting of every run, so that what may be is looked up only where a table is lacking.
void add_lacking_tables(Value& experiment, std::string const& path) {
  Value* here = &experiment;
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (auto dot = path.find('.'); dot != std::string::npos; dot = path.find('.', begin)) {
    parts.push_back(path.substr(begin, dot - begin));
    begin = dot + 1;
    if (!here->find(parts.back())) {
      if (fields_at(parts).empty()) return;
      std::get<Value::Table>(here->content).push_back({parts.back(), here->where, Value{here->where, Value::Table{}}});
    }
    here = here->find(parts.back());
    if (!here->is_table()) return;
  }
}

/// What an experiment has and a machine has not is meant for the experiment; which machine runs, no setting changes.
void refuse_experiment_key(Value const& machine, std::string const& path) {
  std::string const first = path.substr(0, path.find('.'));
  auto const& of_machine = machine_keys();
  bool const may_stand_there = std::find(of_machine.begin(), of_machine.end(), first) != of_machine.end();
  if (machine.find(first) || may_stand_there || first == "machine") return;
  auto const experiment = list_fields<scenarios::Experiment>();
  if (std::any_of(experiment.begin(), experiment.end(), [&](auto const& field) { return field.key == first; }))
    throw thermal::InputError(
        fmt::format("parameter '{0}': a machine has no '{1}'; did you mean '{2}{0}'?", path, first, experiment_prefix));
}

/// What drives a channel in place of a programme, for people; empty: nothing does.
std::string replacement_of(std::string const& channel, scenarios::Experiment const& experiment) {
  for (auto const& recording : experiment.recorded)
    for (auto const& column : recording.columns)
      if (column.channel == channel) return fmt::format("'{}' is recorded in '{}'", channel, recording.file);
  for (auto const& program : experiment.inputs)
    if (program.channel == channel) return fmt::format("'{}' has a programme of its own in 'inputs'", channel);
  return "";
}

}  // namespace

Setting setting(std::string const& text) {
  auto const equals = text.find('=');
  if (equals == std::string::npos)
    throw thermal::InputError(
        fmt::format("--set {}: write it as path=value, for example bearing.front.grease_factor=0.8", text));
  Setting result{text.substr(0, equals), text.substr(equals + 1)};
  auto& value = result.value;
  if (value.size() >= 2 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
  return result;
}

std::vector<Setting> settings_in(std::string const& lines) {
  std::vector<Setting> settings;
  std::istringstream text(lines);
  for (std::string line; std::getline(text, line);) settings.push_back(setting(line));
  return settings;
}

std::string text_of(Setting const& setting) {
  bool const plain = setting.value.find(' ') == std::string::npos;
  return plain ? fmt::format("{}={}", setting.path, setting.value)
               : fmt::format("{}=\"{}\"", setting.path, setting.value);
}

void apply(Setting const& setting, Value& machine, Value& experiment) {
  if (setting.of_experiment()) {
    std::string const path = setting.path.substr(experiment_prefix.size());
    add_lacking_tables(experiment, path);
    set_parameter(experiment, path, setting.value, experiment_prefix);
  } else {
    refuse_experiment_key(machine, setting.path);
    set_parameter(machine, setting.path, setting.value);
  }
}

void refuse_repeated(std::vector<Setting> const& settings) {
  for (auto here = settings.begin(); here != settings.end(); ++here)
    if (std::any_of(settings.begin(), here, [&](Setting const& other) { return other.path == here->path; }))
      throw thermal::InputError(fmt::format("parameter '{}' is set twice; leave out one of the two", here->path));
}

void refuse_replaced(Setting const& setting, scenarios::Experiment const& experiment) {
  if (!setting.of_experiment()) return;
  auto const channels = scenarios::programmed_channels(experiment, setting.path.substr(experiment_prefix.size()));
  std::vector<std::string> replacements;
  for (auto const& channel : channels)
    if (auto text = replacement_of(channel, experiment); !text.empty()) replacements.push_back(std::move(text));
  if (channels.empty() || replacements.size() < channels.size()) return;
  throw thermal::InputError(
      fmt::format("parameter '{}' would change nothing: {}", setting.path, fmt::join(replacements, ", and ")));
}

std::filesystem::path machine_of(scenarios::Experiment const& experiment,
                                 std::filesystem::path const& experiment_file) {
  if (experiment.machine.empty())
    throw FileError({experiment_file.string(), 0, 0}, "the experiment names no machine; give one with --machine");
  if (experiment.machine.ends_with(".toml")) return experiment.directory / experiment.machine;
  return machine_file(experiment.machine);
}

}  // namespace thermotwin::twin
