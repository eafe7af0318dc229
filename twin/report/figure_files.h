#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/figure.h"

namespace thermotwin::twin {

/// `thermotwin figure`: one panel of the report page as a figure for a paper.
struct FigureFiles {
  std::vector<std::filesystem::path> data;  ///< data sets and answers, as for the page (report_files.h)
  std::string panel;                        ///< the name that the page gives the panel's CSV file
  std::vector<std::string> only;            ///< of its curves; none: all
  std::filesystem::path output;             ///< .svg or .pdf; empty: the panels are listed
  double width = output::Figure::one_column, height = 56.0;  ///< [mm]
};

/// A panel that can be drawn: curves over time or along a stroke, or rows with intervals.
struct FigurePanel {
  std::string name;
  output::Figure figure;
  std::vector<std::size_t> runs{};  ///< of each curve, where several data sets are drawn by their dashes
};

/// All panels that these files have, in the page's order: `input_<unit>`, `sensor_temperatures_degC`,
/// `displacements_um`, `tilt_urad`, `residual_…` of several data sets, `heat` (`heat_<run>` where several differ),
/// `positioning_<run>_<axis>`, `unknown_heat`, `unaccounted_heat`, `ranking_<world>`, `functions_<axis>`, `drift`.
/// InputError names the file.
[[nodiscard]] std::vector<FigurePanel> figure_panels(std::vector<std::filesystem::path> const& files);

/// Writes the panel and says what it is, or lists the panels. InputError when the files have none of that name, or no
/// such curve.
[[nodiscard]] std::string write_figure_files(FigureFiles const& files);

}  // namespace thermotwin::twin
