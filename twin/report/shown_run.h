#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "output/dataset.h"
#include "output/report_page.h"
#include "twin/file/distinct_names.h"

namespace thermotwin::twin {

/// A data set as the page, a figure and a difference show it: its inputs, readings and displacements in the units in
/// which `run` writes them, whatever those of its file are.
struct ShownRun {
  std::filesystem::path path;
  output::Dataset data;
  bool simulated = false;  ///< with the provenance of a run of this program
  /// A run that goes on: what its instruments show is known at its end only; their channels hold the truth.
  bool without_instruments = false;
  std::string machine{};                 ///< that a measurement file names; empty: none
  std::filesystem::path machine_file{};  ///< where it names a file
  /// Samples farther apart than this, and than ten usual intervals of their channel, have nothing between them [s].
  double max_gap = std::numeric_limits<double>::infinity();
  std::filesystem::path name{};  ///< of its file, as it is told from the others of its page

  [[nodiscard]] std::string stem() const { return name_of_run(name); }
};

/// A data set (`.h5`, or `.h5.partial` of a run that has not ended, under the name that it will have), a table
/// (`.csv`), or a measurement file (`.toml`). InputError names the file.
[[nodiscard]] ShownRun read_shown_run(std::filesystem::path const& path);

/// Gives the runs of a page names that tell them apart.
void name_distinctly(std::vector<ShownRun>& runs);

/// When a channel was read, and what it showed.
struct Samples {
  Eigen::VectorXd time_s, values;
};

/// Values on the rows of a run as they are drawn and compared: of what was measured without the rows in which nothing
/// was read (an empty cell, a row of another table), and with a NaN in each gap. What was simulated stays as it is.
[[nodiscard]] Samples samples_of(ShownRun const& run, Eigen::VectorXd const& values);

/// Whether two data sets went through the same, so that their difference tells something: no speed or feed that both
/// know differs by more than a tenth of its highest value (RMS over the times that both have).
[[nodiscard]] bool driven_alike(ShownRun const& reference, ShownRun const& other);

/// Channels with their courses, positioning, and what is known of the run. An input that never changes is one number.
[[nodiscard]] output::Json run_json(ShownRun const& run, output::ReportPage& page);

}  // namespace thermotwin::twin
