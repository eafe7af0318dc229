#pragma once

#include <filesystem>
#include <string>

#include "scenarios/experiment.h"
#include "twin/file/schema.h"

namespace thermotwin::twin {

/// An experiment from its document; FileError with the place of what is wrong. `file` is where recordings start from.
[[nodiscard]] scenarios::Experiment read_experiment(Value const& document, std::filesystem::path const& file);

/// The complaint of a check on an experiment, which begins with the path of a field ("spindle.blocks[2].duration: …"),
/// with the place in the file where that field stands. A complaint about a recording has its own place and stays.
[[nodiscard]] thermal::InputError located_in(Value const& document, thermal::InputError const& error);

/// Such a complaint with the path as a setting has it: "experiment.spindle.blocks.2.duration: …"; any other as it is.
[[nodiscard]] std::string as_setting(std::string const& complaint);

/// A path, or the name of one in scenarios/catalogue.
[[nodiscard]] std::filesystem::path experiment_file(std::string const& name_or_path);

}  // namespace thermotwin::twin
