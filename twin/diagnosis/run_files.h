#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/file/text_file.h"

namespace thermotwin::twin {

/// The files of measured runs that a command was given.
using RunFiles = std::vector<std::filesystem::path>;

/// One after the other; what is odd about one goes to `remarks`, under its name. InputError that names the file.
[[nodiscard]] std::vector<MeasuredRun> read_runs(RunFiles const& files, Machine const& machine,
                                                 std::vector<std::string>& remarks);

/// Each averaged to its fitting interval. `runs` must outlive the result.
[[nodiscard]] std::vector<BinnedRun> binned(std::vector<MeasuredRun> const& runs);

/// "run1.h5, run2.h5"
[[nodiscard]] std::string names_of(RunFiles const& files);

/// InputError when `output` is the machine's file or one of the data, by whatever path or link: before any work, not
/// after it. Every command that writes a file asks this first.
void refuse_to_overwrite(std::filesystem::path const& output, std::filesystem::path const& machine,
                         RunFiles const& data);

/// InputError when a file's suffix says another format than `what` ("a data set") is written in; none says nothing.
void check_suffix(std::filesystem::path const& output, std::string_view what, std::vector<std::string> const& suffixes);

}  // namespace thermotwin::twin
