#include "twin/setting.h"

#include <fmt/format.h>

#include "thermal/error.h"
#include "twin/machine.h"

namespace thermotwin::twin {
namespace {

constexpr std::string_view experiment_prefix = "experiment.";

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

std::string text_of(Setting const& setting) {
  bool const plain = setting.value.find(' ') == std::string::npos;
  return plain ? fmt::format("{}={}", setting.path, setting.value)
               : fmt::format("{}=\"{}\"", setting.path, setting.value);
}

void apply(Setting const& setting, Value& machine, Value& experiment) {
  if (setting.of_experiment())
    set_parameter(experiment, setting.path.substr(experiment_prefix.size()), setting.value);
  else
    set_parameter(machine, setting.path, setting.value);
}

std::filesystem::path machine_of(scenarios::Experiment const& experiment,
                                 std::filesystem::path const& experiment_file) {
  if (experiment.machine.empty())
    throw FileError({experiment_file.string(), 0, 0}, "the experiment names no machine; give one with --machine");
  if (experiment.machine.ends_with(".toml")) return experiment.directory / experiment.machine;
  return machine_file(experiment.machine);
}

}  // namespace thermotwin::twin
