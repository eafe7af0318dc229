#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/diagnosis/measured_run.h"

namespace thermotwin::twin {

/// The files of measured runs that a command was given.
using RunFiles = std::vector<std::filesystem::path>;

/// One after the other, by names that tell them from one another and from those `beside` them; what is odd goes to
/// `remarks`, under the names of those that are. InputError that names the file.
[[nodiscard]] std::vector<MeasuredRun> read_runs(RunFiles const& files, Machine const& machine,
                                                 std::vector<std::string>& remarks, RunFiles const& beside = {});

/// Where one of a machine's runs does not begin at rest, any may (warm_start.h).
void let_begin_alike(std::vector<MeasuredRun>& runs, Machine const& machine);

/// Each averaged to its fitting interval. `runs` must outlive the result.
[[nodiscard]] std::vector<BinnedRun> binned(std::vector<MeasuredRun> const& runs);

/// "run1.h5, run2.h5"
[[nodiscard]] std::string names_of(RunFiles const& files);

}  // namespace thermotwin::twin
