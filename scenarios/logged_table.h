#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/csv.h"
#include "scenarios/field.h"
#include "scenarios/time_stamp.h"
#include "thermal/dimension.h"

namespace thermotwin::scenarios {

/// A CSV file that a logger wrote, and what cannot be seen in it.
struct LoggedFile {
  std::string file;  ///< relative to the file that names it; ${NAME} and ${NAME:-default} are read from the environment
  std::string time_column = "time_s";
  std::string time_unit;               ///< of the numbers of that column; empty: s, or time stamps
  int header_line = 1;                 ///< what stands above the columns' names is skipped
  std::optional<double> clock_offset;  ///< added to the file's times to give those of the run [s]
  std::vector<std::string> missing;    ///< words for no value, where values may be missing

  template <class Fields>
  static void fields(Fields& f) {
    f.name("file", &LoggedFile::file,
           "CSV file, relative to this one; ${NAME} and ${NAME:-default} are read from the environment");
    f("time_column", &LoggedFile::time_column, "exact name of the column of times: numbers or time stamps");
    f("time_unit", &LoggedFile::time_unit, "unit of the times in the file; default: s; time stamps have none");
    f("header_line", &LoggedFile::header_line, "line of the columns' names, from 1; those above are skipped",
      {1.0, unbounded});
    f("clock_offset", &LoggedFile::clock_offset, thermal::dimension::time,
      "added to the file's times to give those of the run; due where one table has numbers and another time stamps");
  }
};

/// Its rows.
struct LoggedTable {
  std::filesystem::path file;
  std::vector<std::size_t> lines;            ///< of each row in the file
  std::vector<double> times;                 ///< on the clock of the run [s], strictly increasing
  std::vector<std::vector<double>> columns;  ///< in the order in which they were asked for, in the file's units
  std::string remark;                        ///< of what was skipped, or empty
  std::string clock_remark;                  ///< of a clock that was probably put forward, or empty
  std::string repeats_remark;                ///< of rows with the time of the one before, or empty
  std::size_t units_line = 0;                ///< of a row of units, or 0
  std::vector<std::string> units;            ///< in it: of the times, unless they are stamps, then of the columns
};

/// Reads the tables of one run onto one clock. Those whose times are numbers count from a 0 of their own; those with
/// time stamps (time_stamp.h) from the first row of the first of them. A row below the names that holds no number in
/// the columns asked for, and no date, is one of units and skipped. Of rows with the same time, as a log of events has
/// where two fall into one second, the last counts; a tenth of all at most.
///
/// Throws InputError as CsvFile does, and for a unit that is none of time, a time that is missing or goes back or
/// stays, and for clocks of two kinds of which nobody says how they lie: numbers, stamps with and without a time zone.
class TableReader {
 public:
  explicit TableReader(MissingValue missing) : missing_(missing) {}

  /// The columns of `file`, which lies at `path`.
  [[nodiscard]] LoggedTable read(LoggedFile const& file, std::filesystem::path const& path,
                                 std::vector<std::string> const& columns);

  /// What the clock of the stamps shows at a time of the run [s]; nothing if no table has any.
  [[nodiscard]] std::optional<double> time_of_day(double t) const;

 private:
  void set_clock(LoggedFile const& file, CsvFile const& csv, std::size_t place);
  [[nodiscard]] double value(LoggedFile const& file, CsvFile& csv, std::size_t place) const;

  MissingValue missing_;
  std::string clock_;               ///< of the first table: its kind, for people
  std::optional<TimeStamp> start_;  ///< the first row of the first table with stamps
  double time_at_start_ = 0.0;      ///< [s]
};

/// InputError where the table's row of units says another one than the file that names the table: of its times, or of a
/// column; `units` as those of the columns, an empty one is not compared.
void check_units(LoggedTable const& table, LoggedFile const& file, std::vector<std::string> const& columns,
                 std::vector<std::string> const& units);

/// The error for a file's time_unit, or none.
void check_time_unit(LoggedFile const& file);

}  // namespace thermotwin::scenarios
