#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/field.h"
#include "scenarios/logged_table.h"
#include "scenarios/signal.h"
#include "thermal/operating_point.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {

/// One column of a recording, and the input channel that it drives: factor · number + offset.
struct RecordedColumn {
  std::string column;                       ///< exact name in the file's header
  std::string channel;                      ///< "spindle.speed", or a new name
  std::string unit = "1";                   ///< of factor · number
  std::string interpolation = "automatic";  ///< "automatic", "linear" or "step"
  double factor = 1.0;
  std::string offset{};  ///< with its unit; empty: none

  template <class Fields>
  static void fields(Fields& f) {
    f.name("column", &RecordedColumn::column, "exact name of the column in the file's header");
    f.name("channel", &RecordedColumn::channel, "input channel that it drives, of the machine's or a new one");
    f("unit", &RecordedColumn::unit, "of the numbers in the file, times the factor: \"rpm\", \"degC\", \"%\"");
    f.choice("interpolation", &RecordedColumn::interpolation, {"automatic", "linear", "step"},
             "between two rows; automatic: speeds, shares and flags are held, temperatures go straight, both without "
             "their noise; the others take each number at its word");
    f("factor", &RecordedColumn::factor, thermal::dimension::dimensionless,
      "of the numbers; 50 reads per cent of 5000 rpm as rpm");
    f("offset", &RecordedColumn::offset, "added, with its unit: \"-0.5 K\", \"10 rpm\"");
  }
};

/// What is told where the unit of a column is that of a share, and the channel's is not.
inline constexpr std::string_view or_a_factor = "; or give a factor: unit = \"rpm\", factor = 50 reads % of 5000 rpm";

/// Inputs from a CSV file that was measured, in place of programmes. Before the first row the first value holds, after
/// the last the last one, each for `max_gap` at most.
struct Recording : LoggedFile {
  double max_gap = 600.0;  ///< longest time between two rows [s]
  std::vector<RecordedColumn> columns;

  template <class Fields>
  static void fields(Fields& f) {
    LoggedFile::fields(f);
    f("max_gap", &Recording::max_gap, thermal::dimension::time, "longest time between two rows", {0.0, unbounded});
    f("columns", &Recording::columns, "columns to read and the channels that they drive");
  }
};

/// An input channel with its course [SI].
struct DrivenChannel {
  thermal::InputChannel channel;
  Signal signal;
  bool absolute_temperature = false;  ///< written in degC: points on the scale, no differences
};

/// Reads the columns for a run of `duration` [s], of all files onto one clock (logged_table.h); relative file names
/// start at `directory`. Throws InputError with file, line, column and value: a missing column or value, time running
/// backwards, a gap, a unit that is none, a record too short.
std::vector<LoggedTable> read_tables(std::vector<Recording> const& recordings, std::filesystem::path const& directory,
                                     double duration);

/// The channels that the columns of those tables drive, read as those of a measurement are (sampled.h).
std::vector<DrivenChannel> driven_channels(std::vector<Recording> const& recordings,
                                           std::vector<LoggedTable> const& tables);

/// `read_tables`, then `driven_channels`.
std::vector<DrivenChannel> read_recordings(std::vector<Recording> const& recordings,
                                           std::filesystem::path const& directory, double duration);

/// The file's name with ${NAME} replaced by the environment's value, and ${NAME:-default} by the default where there is
/// none. Relative values start at the working directory, relative defaults at `directory`.
std::filesystem::path resolved_path(std::string_view file, std::filesystem::path const& directory);

}  // namespace thermotwin::scenarios
