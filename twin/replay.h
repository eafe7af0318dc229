#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "scenarios/experiment.h"
#include "twin/file/value.h"
#include "twin/run.h"

namespace thermotwin::twin {

/// All that a run was made from, as its provenance keeps it: the texts of the machine's and the experiment's files, the
/// settings line by line, recorded inputs, and the elastic solutions that the machine's displacements rest on, from
/// whichever file beside it. `document` is the machine's with the settings.
[[nodiscard]] std::map<std::string, std::string> origin(std::filesystem::path const& machine, Value const& document,
                                                        std::filesystem::path const& experiment,
                                                        std::string const& settings,
                                                        scenarios::Experiment const& nominal);

/// InputError where a run would take the place of any file that is none, or its partial file that of a `compensate`
/// that was killed: what was measured cannot be made again. Every command that writes a run where the user says asks
/// this before any work.
void refuse_to_replace_other_than_run(std::filesystem::path const& output);

/// A run made anew from its own output, and how that compares.
struct Replay {
  bool same_bytes = false;
  std::string text;  ///< for people: the same, or what differs and by how much
};

/// Runs again what a data set says it was made from, with no other file, and compares the two byte for byte. `output`
/// keeps the new data set. InputError when the data set does not hold its origin: a measured one, a partial one; and of
/// a reduced model.
[[nodiscard]] Replay replay(std::filesystem::path const& dataset, std::filesystem::path const& output,
                            std::function<void(double)> const& progress, std::atomic<bool> const* stop);

}  // namespace thermotwin::twin
