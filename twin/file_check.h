#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/experiment.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// What `thermotwin check` says of one file.
struct FileCheck {
  std::string text;                   ///< what it is, for people
  std::vector<std::string> warnings;  ///< what is odd or not plausible, with its place
  std::string mistake;                ///< with its place; empty: none
};

/// A path, or the name of a machine, an experiment, a study or a campaign that comes with the program; what is neither
/// comes back as it is.
[[nodiscard]] std::filesystem::path file_to_check(std::string const& name_or_path);

/// Whatever the program reads, known by its keys (file_kind.h), and tables and data sets of runs by their suffix. An
/// experiment is looked at together with the machine among the files that it names, or the only one; without any, with
/// the machine that it names: every input of the machine must be given. A mistake of that machine is told once. So are
/// the experiments of a study's worlds, and a record of a run with the machine among the files, where there is one.
/// Candidates are looked at together with the only machine. A mistake in one file does not keep the others from being
/// looked at.
[[nodiscard]] std::vector<FileCheck> check_files(std::vector<std::filesystem::path> const& files);

/// What an experiment and a machine have against each other: InputError with its place in the file of the one or of the
/// other.
void check_together(Value const& experiment_document, scenarios::Experiment const& experiment,
                    Value const& machine_document, Machine const& machine);

}  // namespace thermotwin::twin
