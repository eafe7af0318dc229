#pragma once

#include <filesystem>
#include <string>

#include "output/dataset.h"
#include "output/report_page.h"

namespace thermotwin::twin {

/// A data set as the page shows it.
struct ShownRun {
  std::filesystem::path path;
  output::Dataset data;
  bool simulated = false;  ///< with the provenance of a run of this program
  /// A run that goes on: what its instruments show is known at its end only; their channels hold the truth.
  bool without_instruments = false;
};

/// A data set (`.h5`, or `.h5.partial` of a run that has not ended, under the name that it will have), a table
/// (`.csv`), or a measurement file (`.toml`). InputError names the file.
[[nodiscard]] ShownRun read_shown_run(std::filesystem::path const& path);

/// Whether two data sets went through the same, so that their difference tells something: no speed or feed that both
/// know differs by more than a tenth of its highest value (RMS over the times that both have).
[[nodiscard]] bool driven_alike(ShownRun const& reference, ShownRun const& other);

/// Channels with their courses, positioning, and what is known of the run. An input that never changes is one number.
[[nodiscard]] output::Json run_json(ShownRun const& run, output::ReportPage& page);

}  // namespace thermotwin::twin
