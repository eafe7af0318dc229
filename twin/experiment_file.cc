#include "twin/experiment_file.h"

#include <algorithm>
#include <fmt/format.h>

#include "scenarios/programmed_channels.h"
#include "thermal/nearest_name.h"
#include "twin/file/document.h"
#include "twin/file/shipped_file.h"
#include "twin/file/temperature_limits.h"
#include "twin/file_kind.h"

namespace thermotwin::twin {
namespace {

/// The first of a path's parts, "axes[0]" of "axes[0].feed", as key and index (−1: none); takes it off the path.
std::pair<std::string, int> take_step(std::string& path) {
  auto const dot = path.find('.');
  std::string step = path.substr(0, dot);
  path = dot == std::string::npos ? "" : path.substr(dot + 1);
  auto const bracket = step.find('[');
  if (bracket == std::string::npos) return {step, -1};
  return {step.substr(0, bracket), std::atoi(step.c_str() + bracket + 1)};
}

/// Whether an experiment has the field with which a path begins; "speeds.csv" is none.
bool begins_with_field(std::string path) {
  auto const fields = list_fields<scenarios::Experiment>();
  return std::any_of(fields.begin(), fields.end(),
                     [key = take_step(path).first](auto const& field) { return field.key == key; });
}

/// The path of a field with which a complaint begins; empty where it names a file, or something else.
std::string path_in(std::string const& message) {
  auto path = message.substr(0, message.find(": "));
  return path.find_first_of("/: ") != std::string::npos || !begins_with_field(path) ? "" : path;
}

/// The entry of a list that a path means: by its number, or, of axes, by the axis that is the path's next part.
Value const* entry_of(Value::List const& list, int index, std::string& path) {
  if (index >= 0) return std::size_t(index) < list.size() ? &list[std::size_t(index)] : nullptr;
  auto const meant = take_step(path).first;
  auto const is_meant = [&](Value const& table) {
    if (!table.is_table()) return false;
    auto const axis = texts_of(table, "axis");
    return (axis.empty() ? scenarios::FeedProgram().axis : axis[0]) == meant;
  };
  auto const found = std::find_if(list.begin(), list.end(), is_meant);
  return found == list.end() ? nullptr : &*found;
}

/// The paths of what stands in an experiment's tables: "spindle.cycles", "axes.0.blocks".
std::vector<std::string> written_paths(Value const& document) {
  std::vector<std::string> paths;
  auto const add = [&](Value const& table, std::string const& prefix) {
    for (auto const& key : table.keys()) paths.push_back(prefix + key);
  };
  for (auto const& [key, where, value] : std::get<Value::Table>(document.content)) {
    if (value.is_table()) add(value, key + ".");
    if (!value.is_list()) continue;
    auto const& items = std::get<Value::List>(value.content);
    for (std::size_t i = 0; i < items.size(); ++i)
      if (items[i].is_table()) add(items[i], fmt::format("{}.{}.", key, i));
  }
  return paths;
}

/// Whether a channel that a table drives follows another one, which an input programme drives: "z.feed" from "z.speed".
bool is_driven_by(std::string const& input, std::string const& channel) {
  auto const dot = channel.rfind(".feed");
  return input == channel || (dot != std::string::npos && input == channel.substr(0, dot) + ".speed");
}

/// A table and an input programme for one channel: which of them is meant, nobody knows.
void refuse_two_programmes(Value const& document, scenarios::Experiment const& experiment) {
  if (experiment.inputs.empty()) return;
  for (auto const& path : written_paths(document)) {
    auto const channels = scenarios::programmed_channels(experiment, path);
    std::size_t driven = 0, last = 0;
    for (auto const& channel : channels)
      for (std::size_t i = 0; i < experiment.inputs.size(); ++i)
        if (is_driven_by(experiment.inputs[i].channel, channel)) ++driven, last = i;
    if (channels.empty() || driven < channels.size()) continue;
    throw thermal::InputError(
        fmt::format("inputs[{}].channel: '{}' would stand in place of '{}', which is written, too; leave out one of "
                    "them",
                    last, experiment.inputs[last].channel, path));
  }
}

}  // namespace

thermal::InputError located_in(Value const& document, thermal::InputError const& error) {
  std::string const message = error.what();
  auto path = path_in(message);
  if (path.empty()) return error;
  Value const* here = &document;
  while (!path.empty() && here->is_table()) {
    auto const [key, index] = take_step(path);
    Value const* next = here->find(key);
    if (!next) break;
    here = next;
    if (!here->is_list() || (index < 0 && path.empty())) continue;
    next = entry_of(std::get<Value::List>(here->content), index, path);
    if (!next) break;
    here = next;
  }
  return FileError(here->where, message);
}

std::string as_setting(std::string const& complaint) {
  auto path = path_in(complaint);
  if (path.empty()) return complaint;
  auto const rest = complaint.substr(path.size());
  std::replace(path.begin(), path.end(), '[', '.');
  std::erase(path, ']');
  return "experiment." + path + rest;
}

scenarios::Experiment read_experiment(Value const& document, std::filesystem::path const& file) {
  scenarios::Experiment experiment;
  read_file_fields(document, FileKind::experiment, experiment);
  check_temperatures(document, list_fields<scenarios::Experiment>());
  experiment.directory = file.has_parent_path() ? file.parent_path() : ".";
  try {
    scenarios::check(experiment);
    scenarios::check_readings(experiment);
    refuse_two_programmes(document, experiment);
  } catch (FileError const&) {
    throw;
  } catch (thermal::InputError const& error) {
    throw located_in(document, error);
  }
  return experiment;
}

std::filesystem::path experiment_file(std::string const& name_or_path) {
  return shipped_file("experiment", "scenarios/catalogue", name_or_path);
}

}  // namespace thermotwin::twin
