#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/logged_table.h"
#include "scenarios/recorded.h"
#include "twin/description.h"
#include "twin/diagnosis/measured_data.h"

namespace thermotwin::twin {

/// `[[table.input]]`: a column that says what the machine was given.
struct InputColumn : scenarios::RecordedColumn {
  double average = 0.0;

  template <class Fields>
  static void fields(Fields& f) {
    RecordedColumn::fields(f);
    f("average", &InputColumn::average, dimension::time, "straight ones: one point per this time, the mean of its rows",
      positive);
  }
};

/// `[[table.reading]]`: a column that shows what a sensor or a displacement channel of the machine saw;
/// value = factor · number + offset.
struct ReadingColumn {
  std::string column, sensor, unit;
  double factor = 1.0;
  std::string offset;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("column", &ReadingColumn::column, "exact name of the column in the table's header");
    f.name("sensor", &ReadingColumn::sensor, "sensor or displacement channel of the machine");
    f.name("unit", &ReadingColumn::unit, "of the numbers in the table: \"degC\", \"um\", \"urad\"");
    f("factor", &ReadingColumn::factor, dimension::dimensionless, "of the numbers; -1 turns the sign");
    f("offset", &ReadingColumn::offset, "added, with its unit: \"0.3 K\", \"-12 um\"");
  }
};

/// `[[table]]`: a CSV file and what its columns are. Rows may be irregular, cells empty.
struct MeasuredTable : scenarios::LoggedFile {
  double max_gap = 600.0;
  std::vector<InputColumn> inputs;
  std::vector<ReadingColumn> readings;

  template <class Fields>
  static void fields(Fields& f) {
    LoggedFile::fields(f);
    f("missing", &MeasuredTable::missing, "words that stand for no value, besides an empty cell and \"nan\"");
    f("max_gap", &MeasuredTable::max_gap, dimension::time,
      "longer gaps are told, and what was given in them is estimated", positive);
    f("input", &MeasuredTable::inputs, "columns that the machine was given");
    f("reading", &MeasuredTable::readings, "columns that its sensors showed");
  }
};

/// `[[constant]]`: an input that nobody recorded because it did not change.
struct ConstantInput {
  std::string channel, value;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("channel", &ConstantInput::channel, "input channel");
    f.name("value", &ConstantInput::value, "number with its unit, if it has one: \"18 degC\", 0.88");
  }
};

/// A measurement file: which columns of which tables are the inputs and the readings of one run.
struct MeasurementFile {
  std::string title, machine;
  std::optional<double> from, to, readings_from;
  std::optional<double> initial_temperature;
  std::vector<MeasuredTable> tables;
  std::vector<ConstantInput> constants;

  template <class Fields>
  static void fields(Fields& f) {
    f("title", &MeasurementFile::title, "one line for people");
    f("machine", &MeasurementFile::machine,
      "machine that was measured, which a report draws: a file beside this one, or a name");
    f("from", &MeasurementFile::from, dimension::time, "on the tables' clock: 0 of the run; default: the first row");
    f("to", &MeasurementFile::to, dimension::time, "on the tables' clock: end of the run; default: the last row");
    f("readings_from", &MeasurementFile::readings_from, dimension::time,
      "on the tables' clock: earlier readings are not looked at, though the run starts before");
    f.temperature("initial_temperature", &MeasurementFile::initial_temperature,
                  "of the whole machine at the start; default: that of the air around each part");
    f("table", &MeasurementFile::tables, "tables of numbers");
    f("constant", &MeasurementFile::constants, "inputs that stayed as they were");
  }
};

/// Reads the file and its tables: times from the start of the run, readings of several tables on one time axis.
/// InputError with file, line, column and value: a column that is not there, time that runs backwards, a unit that
/// contradicts, a channel given twice, a window without rows.
[[nodiscard]] MeasuredData read_measurement_file(std::filesystem::path const& path);

}  // namespace thermotwin::twin
