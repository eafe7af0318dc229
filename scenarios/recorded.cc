#include "scenarios/recorded.h"

#include <cstdlib>
#include <utility>

#include "scenarios/csv.h"
#include "thermal/error.h"

namespace thermotwin::scenarios {
namespace {

using thermal::format_number;
using thermal::format_quantity;
using thermal::InputError;
namespace dimension = thermal::dimension;

/// Puts the place in front of what `action` complains of.
template <class Action>
void at(std::string const& place, Action action) {
  try {
    action();
  } catch (InputError const& error) {
    throw InputError(place + error.what());
  }
}

void check(Recording const& recording) {
  if (recording.file.empty()) throw InputError("recorded.file: the name of a CSV file is due");
  std::string const place = "recorded '" + recording.file + "': ";
  if (recording.columns.empty()) throw InputError(place + "columns is empty; name at least one column and its channel");
  if (!(recording.max_gap > 0.0)) {
    throw InputError(place + "max_gap: " + format_quantity(recording.max_gap, dimension::time) + " must be above 0 s");
  }
  at(place + "time_unit: ", [&] { thermal::require_unit(recording.time_unit, dimension::time); });
  for (RecordedColumn const& column : recording.columns) {
    if (column.column.empty() || column.channel.empty()) {
      throw InputError(place + "each of columns needs a column and a channel");
    }
    if (column.interpolation != "linear" && column.interpolation != "step") {
      throw InputError(place + "interpolation: '" + column.interpolation + "' must be \"linear\" or \"step\"");
    }
    at(place + "column '" + column.column + "': ", [&] { (void)thermal::dimension_of(column.unit); });
  }
}

std::string place_of_row(CsvTable const& table, std::size_t row) {
  return table.file.string() + ":" + std::to_string(table.lines[row]) + ": ";
}

void check_times(Recording const& recording, CsvTable const& table, std::vector<double> const& seconds) {
  std::vector<double> const& written = table.columns.front();
  for (std::size_t row = 1; row < seconds.size(); ++row) {
    std::string const values = "column '" + recording.time_column + "': " + format_number(written[row]) + " after " +
                               format_number(written[row - 1]) + " " + recording.time_unit;
    if (seconds[row] <= seconds[row - 1]) {
      throw InputError(place_of_row(table, row) + values + ": time must increase");
    }
    if (seconds[row] - seconds[row - 1] > recording.max_gap) {
      throw InputError(place_of_row(table, row) + values + " is a gap longer than max_gap, " +
                       format_quantity(recording.max_gap, dimension::time));
    }
  }
}

void check_cover(Recording const& recording, CsvTable const& table, std::vector<double> const& seconds,
                 double duration) {
  if (seconds.front() <= recording.max_gap && seconds.back() >= duration - recording.max_gap) return;
  throw InputError(table.file.string() + ": covers " + format_number(seconds.front()) + " s to " +
                   format_number(seconds.back()) + " s of a run of " + format_number(duration) +
                   " s; at its ends at most max_gap, " + format_quantity(recording.max_gap, dimension::time) +
                   ", may be missing (see clock_offset and duration)");
}

/// Several columns may read the same one of the file; the first entry is the time.
std::vector<std::string> wanted_columns(Recording const& recording) {
  std::vector<std::string> names = {recording.time_column};
  for (RecordedColumn const& column : recording.columns) names.push_back(column.column);
  return names;
}

std::string value_or_default(std::string_view reference, std::filesystem::path const& directory) {
  std::size_t const mark = reference.find(":-");
  std::string const name(reference.substr(0, mark));
  char const* value = std::getenv(name.c_str());
  if (value != nullptr && *value != '\0') return std::filesystem::absolute(value).string();
  if (mark != std::string_view::npos) return std::filesystem::absolute(directory / reference.substr(mark + 2)).string();
  throw InputError("the environment variable " + name + " is not set; it names the folder of a recorded file");
}

}  // namespace

std::filesystem::path resolved_path(std::string_view file, std::filesystem::path const& directory) {
  std::string text(file);
  for (auto start = text.find("${"); start != std::string::npos; start = text.find("${", start)) {
    std::size_t const end = text.find('}', start);
    if (end == std::string::npos) throw InputError("'" + std::string(file) + "': a '}' is missing");
    std::string const value = value_or_default(std::string_view(text).substr(start + 2, end - start - 2), directory);
    text.replace(start, end - start + 1, value);
    start += value.size();
  }
  return (directory / text).lexically_normal();
}

std::vector<DrivenChannel> read_recording(Recording const& recording, std::filesystem::path const& directory,
                                          double duration) {
  check(recording);
  CsvTable table = read_csv(resolved_path(recording.file, directory), wanted_columns(recording));
  std::vector<double> seconds = table.columns.front();
  thermal::from_unit(seconds, recording.time_unit);
  for (double& t : seconds) t += recording.clock_offset;
  check_times(recording, table, seconds);
  check_cover(recording, table, seconds, duration);

  std::vector<DrivenChannel> channels;
  for (std::size_t i = 0; i < recording.columns.size(); ++i) {
    RecordedColumn const& column = recording.columns[i];
    std::vector<double>& values = table.columns[i + 1];
    thermal::from_unit(values, column.unit);
    std::string const unit = thermal::unit_of(thermal::dimension_of(column.unit));
    Interpolation const between = column.interpolation == "step" ? Interpolation::step : Interpolation::linear;
    channels.push_back({{column.channel, unit, "recorded: " + column.column}, Signal(seconds, values, between)});
  }
  return channels;
}

}  // namespace thermotwin::scenarios
