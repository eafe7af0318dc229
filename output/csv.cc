#include "output/csv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <iterator>
#include <sstream>
#include <string_view>

#include "output/atomic_file.h"
#include "scenarios/csv.h"
#include "thermal/error.h"
#include "thermal/units.h"

namespace thermotwin::output {
namespace {

using thermal::InputError;

struct Group {
  std::string_view prefix;  ///< before a column's name
  std::vector<Channel> Dataset::*channels;
};

constexpr std::array groups = {
    Group{"inputs.", &Dataset::inputs},
    Group{"readings.", &Dataset::readings},
    Group{"displacements.", &Dataset::displacements},
    Group{"truth.readings.", &Dataset::truth_readings},
    Group{"truth.displacements.", &Dataset::truth_displacements},
    Group{"heat.", &Dataset::heat},
};
constexpr std::string_view truth_prefix = "truth.";

bool is_angle(std::string_view unit) { return unit.ends_with("rad") || unit == "deg" || unit == "arcsec"; }

/// What the name and the unit say when no group does.
std::vector<Channel> Dataset::*usual_group(Channel const& channel) {
  auto const dimension = thermal::dimension_of(channel.unit);
  if (channel.name.find('.') != std::string::npos) return &Dataset::inputs;
  if (dimension == thermal::dimension::temperature_difference) return &Dataset::readings;
  if (dimension == thermal::dimension::length || is_angle(channel.unit)) return &Dataset::displacements;
  return &Dataset::inputs;
}

std::vector<Channel> Dataset::*truth_of(std::vector<Channel> Dataset::*group) {
  return group == &Dataset::displacements ? &Dataset::truth_displacements : &Dataset::truth_readings;
}

/// Takes the group's name off the channel's.
std::vector<Channel> Dataset::*group_of(Channel& channel) {
  for (auto const& group : groups)
    if (channel.name.starts_with(group.prefix)) {
      channel.name.erase(0, group.prefix.size());
      return group.channels;
    }
  if (!channel.name.starts_with(truth_prefix)) return usual_group(channel);
  channel.name.erase(0, truth_prefix.size());
  return truth_of(usual_group(channel));
}

/// The shortest name that `group_of` leads back to this group.
std::string column_name(Channel const& channel, Group const& group) {
  for (std::string_view const prefix : {std::string_view(), truth_prefix, group.prefix}) {
    Channel read_back{std::string(prefix) + channel.name, channel.unit, {}, {}};
    std::string const column = fmt::format("{}_{}", read_back.name, channel.unit.empty() ? "1" : channel.unit);
    if (group_of(read_back) == group.channels && read_back.name == channel.name) return column;
  }
  throw InputError(fmt::format("'{}' cannot be the name of a column", channel.name));
}

bool is_wanted(Group const& group, CsvGroups const& wanted) {
  if (group.channels == &Dataset::inputs) return wanted.inputs;
  if (group.channels == &Dataset::readings) return wanted.readings;
  if (group.channels == &Dataset::displacements) return wanted.displacements;
  if (group.channels == &Dataset::heat) return wanted.heat;
  return wanted.truth;
}

std::string header_line(Dataset const& dataset, CsvGroups const& wanted) {
  std::string line = "time_s";
  for (auto const& group : groups)
    if (is_wanted(group, wanted))
      for (auto const& channel : dataset.*group.channels) line += "," + csv_field(column_name(channel, group));
  return line;
}

Channel make_channel(std::string const& column, std::filesystem::path const& path) try {
  auto const cut = column.rfind('_');
  if (cut == std::string::npos || cut == 0 || cut + 1 == column.size())
    throw InputError("has no unit; write for example 'T1_degC'");
  std::string const unit = column.substr(cut + 1);
  Channel channel{column.substr(0, cut), unit == "C" ? "degC" : unit, column.substr(0, cut), {}};
  static_cast<void>(thermal::dimension_of(channel.unit));
  return channel;
} catch (InputError const& error) {
  throw InputError(fmt::format("{}:1: column '{}': {}", path.string(), column, error.what()));
}

Eigen::VectorXd as_vector(std::vector<double> const& values) {
  return Eigen::Map<Eigen::VectorXd const>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// A table without the time of a run is somebody else's.
scenarios::CsvTable read_run(std::filesystem::path const& path, std::vector<std::string> const& columns,
                             bool has_time) {
  try {
    return scenarios::read_csv(path, columns, scenarios::MissingValue::keep_as_nan);
  } catch (InputError const& error) {
    if (has_time) throw;
    throw InputError(std::string(error.what()) +
                     "; of a table that `thermotwin export` did not write, a measurement file (.toml) says what the "
                     "columns are: `thermotwin describe measurement`");
  }
}

void check_time(scenarios::CsvTable const& table) {
  auto const& time = table.columns.front();
  for (std::size_t i = 0; i < time.size(); ++i) {
    std::string const where = fmt::format("{}:{}: column 'time_s': ", table.file.string(), table.lines[i]);
    if (std::isnan(time[i])) throw InputError(where + "is missing; a number is due");
    if (i > 0 && time[i] <= time[i - 1])
      throw InputError(fmt::format("{}{} s follows {} s; time must increase strictly", where, time[i], time[i - 1]));
  }
}

}  // namespace

std::string csv_field(std::string const& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (char const c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + '"';
}

void export_csv(Dataset const& dataset, std::ostream& stream, CsvGroups const& wanted) {
  check(dataset);
  std::vector<Channel const*> columns;
  for (auto const& group : groups)
    if (is_wanted(group, wanted))
      for (auto const& channel : dataset.*group.channels) columns.push_back(&channel);
  stream << header_line(dataset, wanted) << '\n';
  for (Eigen::Index row = 0; row < dataset.time_s.size(); ++row) {
    stream << thermal::format_number(dataset.time_s[row]);
    for (auto const* column : columns) {
      double const value = column->values[row];
      stream << ',' << (std::isnan(value) ? std::string() : thermal::format_number(value));
    }
    stream << '\n';
  }
}

void export_csv(Dataset const& dataset, std::filesystem::path const& path, CsvGroups const& wanted) {
  std::ostringstream text;
  export_csv(dataset, text, wanted);
  write_atomically(path, text.view());
}

bool is_header_of(Dataset const& dataset, std::string const& line) {
  return (line + ",").starts_with(header_line(dataset, {}) + ",");
}

std::vector<std::string> left_out_of_csv(Dataset const& dataset) {
  std::vector<std::string> left;
  for (auto const& laser : dataset.positioning) left.push_back("the laser's passes along " + laser.axis);
  if (dataset.node_temperatures) left.emplace_back("the temperatures of the nodes");
  return left;
}

Dataset import_csv(std::filesystem::path const& path) {
  auto const header = scenarios::csv_header(path);
  std::vector<std::string> columns = {"time_s"};
  std::copy_if(header.begin(), header.end(), std::back_inserter(columns),
               [](auto const& column) { return column != "time_s"; });
  auto const table = read_run(path, columns, std::find(header.begin(), header.end(), "time_s") != header.end());
  check_time(table);

  Dataset dataset;
  dataset.title = path.filename().string();
  dataset.time_s = as_vector(table.columns.front());
  for (std::size_t i = 1; i < columns.size(); ++i) {
    Channel channel = make_channel(columns[i], path);
    channel.values = as_vector(table.columns[i]);
    auto const group = group_of(channel);
    (dataset.*group).push_back(std::move(channel));
  }
  try {
    check(dataset);
  } catch (InputError const& error) {
    throw InputError(fmt::format("{}:1: {}", path.string(), error.what()));
  }
  return dataset;
}

}  // namespace thermotwin::output
