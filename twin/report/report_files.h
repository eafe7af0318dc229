#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/report_page.h"

namespace thermotwin::twin {

/// `thermotwin report`.
struct ReportFiles {
  /// Data sets (.h5, .csv, measurement files .toml) and answers (.json: answer_section.h). Several data sets are shown
  /// over one another, with the residual against the first that was measured, or else against the first.
  std::vector<std::filesystem::path> data;
  std::filesystem::path machine;  ///< to draw; empty: the one that a data set was made with
  std::filesystem::path output;   ///< the page
};

struct BuiltReport {
  output::ReportPage page;
  std::vector<std::string> remarks;  ///< what the page shows and what it does not
};

/// InputError for files that cannot serve.
[[nodiscard]] BuiltReport build_report(ReportFiles const& files);

/// Writes the page atomically and says in a few lines what it shows and what it does not. InputError for files that
/// cannot serve; `output` is never one of them.
[[nodiscard]] std::string write_report(ReportFiles const& files);

}  // namespace thermotwin::twin
