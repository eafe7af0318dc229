#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace thermotwin::output {

/// A curve; where x or y is NaN it is interrupted.
struct FigureLine {
  std::string name;  ///< in the key; empty: not there
  Eigen::VectorXd x, y;
  std::array<double, 3> colour{0.0, 0.0, 0.0};  ///< red, green, blue, 0 to 1
  std::vector<double> dashes{};                 ///< lengths on and off [pt]; none: solid
  double width = 0.9;                           ///< [pt]
};

/// Ground shaded between two curves.
struct FigureBand {
  Eigen::VectorXd x, low, high;
  std::array<double, 3> colour{0.8, 0.8, 0.8};
};

/// A value with its interval, a row of its own with a name instead of a number on the axis.
struct FigureRow {
  std::string name;
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Curves over common axes, or rows, in the size in which they are printed.
struct Figure {
  static constexpr double one_column = 84.0, two_columns = 174.0;  ///< usual widths in papers [mm]

  double width = one_column;  ///< [mm]
  double height = 56.0;       ///< [mm]
  std::string x_label, y_label;
  std::vector<FigureBand> bands;
  std::vector<FigureLine> lines;
  std::vector<FigureRow> rows;                       ///< of a figure without lines
  std::optional<std::pair<double, double>> x_range;  ///< default: of the lines
};

/// Where the axes stand, in pt from the upper left corner of the figure: x of the data lies at
/// left + (x − x_low) / (x_high − x_low) · (right − left), y likewise from bottom to top.
struct FigureFrame {
  double left, right, top, bottom;
  double x_low, x_high, y_low, y_high;
  std::vector<double> x_ticks, y_ticks;
};

/// Writes an SVG (letters as outlines) or a PDF (fonts embedded as subsets), by the ending of the path; the same figure
/// gives the same bytes. Replaced atomically. Every point of the data lies on its curve to 1/256 pt; corners that lie
/// on a straight line between their neighbours are left out. thermal::InputError for another
/// ending, a figure without any finite value, or curves whose x and y are not of one length.
FigureFrame write_figure(Figure const& figure, std::filesystem::path const& path);

/// For the i-th of several curves: seven colours that the colour-blind can tell apart (Okabe and Ito 2008, without
/// yellow), then the same dashed, then dotted.
void set_style(FigureLine& line, std::size_t i);

}  // namespace thermotwin::output
