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

/// One column of a recording, and the input channel that it drives.
struct RecordedColumn {
  std::string column;                    ///< exact name in the file's header
  std::string channel;                   ///< "spindle.speed", or a new name
  std::string unit = "1";                ///< of the numbers in the file
  std::string interpolation = "linear";  ///< "linear" or "step"

  template <class Fields>
  static void fields(Fields& f) {
    f.name("column", &RecordedColumn::column, "exact name of the column in the file's header");
    f.name("channel", &RecordedColumn::channel, "input channel that it drives, of the machine's or a new one");
    f("unit", &RecordedColumn::unit, "unit of the numbers in the file, for example \"rpm\", \"degC\", \"%\"");
    f.choice("interpolation", &RecordedColumn::interpolation, {"linear", "step"},
             "between two rows: a straight line, or held until the next");
  }
};

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
std::vector<DrivenChannel> read_recordings(std::vector<Recording> const& recordings,
                                           std::filesystem::path const& directory, double duration);

/// The file's name with ${NAME} replaced by the environment's value, and ${NAME:-default} by the default where there is
/// none. Relative values start at the working directory, relative defaults at `directory`.
std::filesystem::path resolved_path(std::string_view file, std::filesystem::path const& directory);

}  // namespace thermotwin::scenarios
