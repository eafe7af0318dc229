#include "scenarios/recorded.h"

#include <cmath>
#include <cstdlib>

#include "scenarios/sampled.h"
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

/// `place`: "recorded[0].columns[1].".
void check(RecordedColumn const& column, std::string const& place) {
  if (column.column.empty()) throw InputError(place + "column: the name of a column is due");
  if (column.channel.empty()) throw InputError(place + "channel: the name of an input channel is due");
  if (column.interpolation != "automatic" && column.interpolation != "linear" && column.interpolation != "step") {
    throw InputError(place + "interpolation: '" + column.interpolation +
                     "' must be \"automatic\", \"linear\" or \"step\"");
  }
  at(place + "unit: column '" + column.column + "': ", [&] { (void)thermal::dimension_of(column.unit); });
  at(place + "offset: column '" + column.column + "': ", [&] { (void)offset_of(column); });
}

/// `place`: "recorded[0].".
void check(Recording const& recording, std::string const& place) {
  if (recording.file.empty()) throw InputError(place + "file: the name of a CSV file is due");
  if (recording.columns.empty())
    throw InputError(place + "columns: it is empty; name at least one column and its channel");
  if (!(recording.max_gap > 0.0)) {
    throw InputError(place + "max_gap: " + format_quantity(recording.max_gap, dimension::time) + " must be above 0 s");
  }
  at(place, [&] { check_time_unit(recording); });
  for (std::size_t c = 0; c < recording.columns.size(); ++c)
    check(recording.columns[c], place + "columns[" + std::to_string(c) + "].");
}

void check_gaps(Recording const& recording, LoggedTable const& table) {
  for (std::size_t row = 1; row < table.times.size(); ++row) {
    double const gap = table.times[row] - table.times[row - 1];
    if (gap > recording.max_gap) {
      std::string const place = table.file.string() + ":" + std::to_string(table.lines[row]) + ": ";
      if (table.clock_remark.starts_with(place)) throw InputError(table.clock_remark);
      throw InputError(place + "column '" + recording.time_column + "': " + format_number(std::round(1e3 * gap) / 1e3) +
                       " s after the row before is a gap longer than max_gap, " +
                       format_quantity(recording.max_gap, dimension::time));
    }
  }
}

void check_cover(Recording const& recording, LoggedTable const& table, double duration) {
  double const first = table.times.front(), last = table.times.back();
  if (first <= recording.max_gap && last >= duration - recording.max_gap) return;
  throw InputError(table.file.string() + ": covers " + format_number(first) + " s to " + format_number(last) +
                   " s of a run of " + format_number(duration) + " s; at its ends at most max_gap, " +
                   format_quantity(recording.max_gap, dimension::time) +
                   ", may be missing (see clock_offset and duration)");
}

/// Several columns may read the same one of the file.
std::vector<std::string> wanted_columns(Recording const& recording) {
  std::vector<std::string> names;
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

std::vector<LoggedTable> read_tables(std::vector<Recording> const& recordings, std::filesystem::path const& directory,
                                     double duration) {
  TableReader reader(MissingValue::refuse);
  std::vector<LoggedTable> tables;
  for (Recording const& recording : recordings) {
    check(recording, "recorded[" + std::to_string(tables.size()) + "].");
    auto const names = wanted_columns(recording);
    LoggedTable const& table =
        tables.emplace_back(reader.read(recording, resolved_path(recording.file, directory), names));
    std::vector<std::string> units;
    for (RecordedColumn const& column : recording.columns) units.push_back(unit_of_numbers(column.factor, column.unit));
    check_units(table, recording, names, units);
    check_gaps(recording, table);
    check_cover(recording, table, duration);
  }
  return tables;
}

std::vector<DrivenChannel> driven_channels(std::vector<Recording> const& recordings,
                                           std::vector<LoggedTable> const& tables) {
  std::vector<DrivenChannel> channels;
  for (std::size_t r = 0; r < recordings.size(); ++r)
    for (std::size_t c = 0; c < recordings[r].columns.size(); ++c) {
      RecordedColumn const& column = recordings[r].columns[c];
      DrivenChannel& driven =
          channels.emplace_back(driven_channel(sampled_input(column, tables[r].times, tables[r].columns[c])));
      driven.channel.description = "recorded: " + column.column;
    }
  return channels;
}

std::vector<DrivenChannel> read_recordings(std::vector<Recording> const& recordings,
                                           std::filesystem::path const& directory, double duration) {
  return driven_channels(recordings, read_tables(recordings, directory, duration));
}

}  // namespace thermotwin::scenarios
