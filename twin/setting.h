#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/experiment.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

/// A parameter and what it is set to, as `--set path=value` gives it.
struct Setting {
  std::string path, value;

  [[nodiscard]] bool of_experiment() const { return path.starts_with("experiment."); }
  bool operator==(Setting const&) const = default;
};

/// "bearing.front.grease_factor=0.8"; quotes around the value fall. InputError without an equals sign.
[[nodiscard]] Setting setting(std::string const& text);

/// One in each line, as the provenance of a run keeps them.
[[nodiscard]] std::vector<Setting> settings_in(std::string const& lines);

/// As a word of a command line: experiment.duration="2 h".
[[nodiscard]] std::string text_of(Setting const& setting);

/// Paths that begin with `experiment.` go to the experiment, the others to the machine. Tables that an experiment may
/// have need not be there yet. InputError with the nearest name.
void apply(Setting const& setting, Value& machine, Value& experiment);

/// InputError for a path that is given twice.
void refuse_repeated(std::vector<Setting> const& settings);

/// InputError for a setting of a programme that the experiment's recordings or input programmes replace, so that it
/// would change nothing.
void refuse_replaced(Setting const& setting, scenarios::Experiment const& experiment);

/// The file of the machine that an experiment names; FileError when it names none.
[[nodiscard]] std::filesystem::path machine_of(scenarios::Experiment const& experiment,
                                               std::filesystem::path const& experiment_file);

}  // namespace thermotwin::twin
