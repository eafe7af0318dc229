#include "twin/diagnosis/measurement_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <set>

#include "scenarios/logged_table.h"
#include "scenarios/recorded.h"
#include "thermal/error.h"
#include "thermal/unit.h"
#include "thermal/units.h"
#include "twin/file/document.h"
#include "twin/file/tables.h"
#include "twin/file/temperature_limits.h"
#include "twin/file_kind.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

/// One CSV file as numbers: its times on the tables' clock, its columns as they are.
struct LoadedTable {
  std::vector<double> times;
  std::vector<std::vector<double>> inputs, readings;
};

/// One column that shows what two sensors saw.
void remark_twins(MeasuredTable const& table, std::vector<std::string>& remarks) {
  auto const& readings = table.readings;
  for (auto second = readings.begin(); second != readings.end(); ++second) {
    auto const first =
        std::find_if(readings.begin(), second, [&](auto const& r) { return r.column == second->column; });
    if (first != second)
      remarks.push_back(fmt::format("{}: column '{}' is given to two channels, {} and {}", table.file, second->column,
                                    first->sensor, second->sensor));
  }
}

LoadedTable load(MeasuredTable const& table, std::filesystem::path const& directory, scenarios::TableReader& reader,
                 std::vector<std::string>& remarks) {
  if (table.inputs.empty() && table.readings.empty())
    throw InputError(fmt::format("'{}' has neither an input nor a reading; name its columns", table.file));
  std::vector<std::string> columns, units;
  for (auto const& input : table.inputs) {
    columns.push_back(input.column);
    units.push_back(scenarios::unit_of_numbers(input.factor, input.unit));
  }
  for (auto const& reading : table.readings) {
    columns.push_back(reading.column);
    units.push_back(scenarios::unit_of_numbers(reading.factor, reading.unit));
  }
  auto logged = reader.read(table, scenarios::resolved_path(table.file, directory), columns);
  scenarios::check_units(logged, table, columns, units);
  for (auto const& remark : {logged.remark, logged.clock_remark, logged.repeats_remark})
    if (!remark.empty()) remarks.push_back(remark);
  remark_twins(table, remarks);
  auto const first_reading = logged.columns.begin() + std::ptrdiff_t(table.inputs.size());
  return {std::move(logged.times), {logged.columns.begin(), first_reading}, {first_reading, logged.columns.end()}};
}

/// On the tables' clock [s].
struct Window {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();

  [[nodiscard]] bool holds(double t) const { return t >= from && t <= to; }
};

Window window_of(MeasurementFile const& file, std::vector<LoadedTable> const& tables) {
  Window recorded;
  for (auto const& table : tables) {
    recorded.from = std::min(recorded.from, table.times.front());
    recorded.to = std::max(recorded.to, table.times.back());
  }
  Window const window{file.from.value_or(recorded.from), file.to.value_or(recorded.to)};
  if (window.from < window.to && window.from < recorded.to && window.to > recorded.from) return window;
  throw InputError(fmt::format("from {:g} h to {:g} h holds nothing of the tables, which go from {:g} h to {:g} h",
                               window.from / 3600.0, window.to / 3600.0, recorded.from / 3600.0, recorded.to / 3600.0));
}

/// Times at which anything was read, and the start of the run.
std::vector<double> row_times(MeasurementFile const& file, std::vector<LoadedTable> const& tables,
                              Window const& window) {
  std::set<double> times = {window.from};
  for (std::size_t t = 0; t < tables.size(); ++t) {
    if (file.tables[t].readings.empty()) continue;
    for (double const time : tables[t].times)
      if (window.holds(time)) times.insert(time);
  }
  return {times.begin(), times.end()};
}

/// "degC" and "°C": a scale with a 0 of its own.
bool is_scale(std::string const& unit) { return thermal::from_unit(0.0, unit) != 0.0; }

scenarios::SampledInput make_input(InputColumn const& column, LoadedTable const& table,
                                   std::vector<double> const& numbers, double start) {
  auto input = scenarios::sampled_input(column, table.times, numbers);
  for (double& t : input.times) t -= start;
  input.average = column.average;
  return input;
}

/// The offset in the column's unit; a temperature's is a difference.
double offset_of(ReadingColumn const& column) {
  if (column.offset.empty()) return 0.0;
  double const si = thermal::parse_value(column.offset, thermal::dimension_of(column.unit));
  return is_scale(column.unit) ? si : thermal::to_unit(si, column.unit);
}

output::Channel make_reading(ReadingColumn const& column, LoadedTable const& table, std::vector<double> const& numbers,
                             std::vector<double> const& rows, double first) {
  double const offset = offset_of(column);
  bool const scale = is_scale(column.unit), celsius = thermal::in_ascii(column.unit) == "degC";
  output::Channel channel{column.sensor, scale ? "degC" : column.unit, column.column,
                          Eigen::VectorXd::Constant(Eigen::Index(rows.size()), std::nan(""))};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    auto const row = std::lower_bound(rows.begin(), rows.end(), table.times[i]);
    if (row == rows.end() || *row != table.times[i] || *row < first) continue;
    double const shown = column.factor * numbers[i];
    bool const convert = scale && !celsius;
    channel.values[row - rows.begin()] =
        (convert ? thermal::to_unit(thermal::from_unit(shown, column.unit), "degC") : shown) + offset;
  }
  return channel;
}

scenarios::SampledInput make_constant(ConstantInput const& constant) {
  auto const quantity = thermal::parse_quantity(constant.value);
  scenarios::SampledInput input;
  input.name = constant.channel;
  input.unit = thermal::unit_of(quantity.dimension);
  input.absolute_temperature = quantity.absolute_temperature;
  input.times = {0.0};
  input.values = {quantity.value};
  if (scenarios::is_temperature(input)) thermal::require_machine_temperature(quantity.value, constant.value);
  return input;
}

/// `value = 0.88` is "0.88": what has no unit needs no quotes.
Value with_constants_as_text(Value document) {
  Value* constants = document.find("constant");
  if (!constants || !constants->is_list()) return document;
  for (auto& table : std::get<Value::List>(constants->content)) {
    Value* value = table.is_table() ? table.find("value") : nullptr;
    if (value &&
        (std::holds_alternative<double>(value->content) || std::holds_alternative<std::int64_t>(value->content)))
      value->content = value->text();
  }
  return document;
}

/// The tables [[table.input]] and the like.
Value::List const& tables_in(Value const& table, std::string const& kind) {
  static Value::List const none;
  Value const* list = table.find(kind);
  return list ? std::get<Value::List>(list->content) : none;
}

void add_constants(MeasurementFile const& file, Value const& document, MeasuredData& data) {
  for (std::size_t i = 0; i < file.constants.size(); ++i) {
    auto const& place = tables_in(document, "constant")[i];
    located(place, [&] { data.inputs.push_back(make_constant(file.constants[i])); });
    data.input_tables.emplace(file.constants[i].channel, place);
  }
}

/// A table's columns, each complaint at the place of its own.
void add_columns(MeasuredTable const& table, Value const& place, LoadedTable const& loaded, double start,
                 std::vector<double> const& rows, double first, MeasuredData& data) {
  for (std::size_t i = 0; i < table.inputs.size(); ++i) {
    auto const& own = tables_in(place, "input")[i];
    located(own, [&] {
      data.inputs.push_back(make_input(table.inputs[i], loaded, loaded.inputs[i], start));
      check_unit_of_channel(own, data.inputs.back());
      leave_out_impossible(data.inputs.back(), data.remarks);
    });
    data.input_tables.emplace(table.inputs[i].channel, own);
  }
  for (std::size_t i = 0; i < table.readings.size(); ++i) {
    auto const& own = tables_in(place, "reading")[i];
    located(own, [&] {
      auto channel = make_reading(table.readings[i], loaded, loaded.readings[i], rows, first);
      auto const unit = thermal::dimension_of(channel.unit);
      bool const temperature = unit == dimension::temperature_difference;
      if (!temperature && unit != dimension::length && unit != dimension::angle)
        throw InputError(fmt::format("'{}' is no unit of a temperature, a length or an angle; reading {} is due in one",
                                     channel.unit, channel.name));
      (temperature ? data.readings : data.displacements).push_back(std::move(channel));
    });
    data.reading_tables.emplace(table.readings[i].sensor, own);
  }
}

/// A logger of readings alone, or with temperatures, has a clock of its own beside one that records what is switched.
void add_clocks(MeasurementFile const& file, MeasuredData& data) {
  std::vector<bool> records_switches;
  for (auto const& table : file.tables)
    records_switches.push_back(std::any_of(table.inputs.begin(), table.inputs.end(), [](InputColumn const& column) {
      return thermal::dimension_of(column.unit) != dimension::temperature_difference;
    }));
  if (std::find(records_switches.begin(), records_switches.end(), true) == records_switches.end()) return;
  for (std::size_t t = 0; t < file.tables.size(); ++t)
    for (auto const& reading : file.tables[t].readings)
      if (!records_switches[t])
        data.clocks[reading.sensor] = std::filesystem::path(file.tables[t].file).filename().string();
}

bool may_be_machine(std::filesystem::path const& file) {
  try {
    return may_be(read_toml(file), FileKind::machine);
  } catch (InputError const&) {  // told where the machine is read
    return true;
  }
}

/// Where it is named; empty: it is a name alone. What bears that name and is of another kind hides no shipped machine.
std::filesystem::path file_of_machine(std::string const& named, std::filesystem::path const& directory) {
  if (named.empty()) return {};
  auto const file = directory / named, beside = directory / (named + ".toml");
  if (file.extension() == ".toml" && std::filesystem::is_regular_file(file)) return file;
  return std::filesystem::is_regular_file(beside) && may_be_machine(beside) ? beside : std::filesystem::path();
}

/// As it calls itself, where its file is named.
std::string name_of_machine(std::string const& named, std::filesystem::path const& file) {
  if (file.empty()) return named;
  try {
    if (auto const name = name_in(read_toml(file)); !name.empty()) return name;
  } catch (InputError const&) {  // told where the machine is read
  }
  return named;
}

void check_names(MeasuredData const& data) {
  std::set<std::string> names;
  auto const claim = [&](std::string const& name, std::string const& what) {
    if (!names.insert(what + name).second) throw InputError(fmt::format("{} '{}' is given twice", what, name));
  };
  for (auto const& input : data.inputs) claim(input.name, "input");
  for (auto const* group : {&data.readings, &data.displacements})
    for (auto const& channel : *group) claim(channel.name, "reading");
}

}  // namespace

MeasuredData read_measurement_file(std::filesystem::path const& path) {
  Value const document = with_constants_as_text(read_toml(path));
  MeasurementFile file;
  read_fields(document, file);
  check_temperatures(document, list_fields<MeasurementFile>());
  if (file.tables.empty()) throw FileError(document.where, "the file names no [[table]]");
  auto const directory = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  auto const& places = std::get<Value::List>(document.find("table")->content);
  MeasuredData data;
  scenarios::TableReader reader(scenarios::MissingValue::keep_as_nan);
  std::vector<LoadedTable> tables;
  for (std::size_t t = 0; t < file.tables.size(); ++t) try {
      tables.push_back(load(file.tables[t], directory, reader, data.remarks));
    } catch (InputError const& error) {  // of the words that it quotes, the others are names that the table has
      auto const words = quoted(error.what());
      throw FileError(words.empty() ? places[t].where : place_of(places[t], "'" + words.front() + "'"), error.what());
    }

  data.machine_file = file_of_machine(file.machine, directory);
  if (data.machine_file.empty() && file.machine.ends_with(".toml"))
    data.remarks.push_back(fmt::format("it is a run of '{}', but there is no such file beside it", file.machine));
  else
    data.machine = name_of_machine(file.machine, data.machine_file);
  data.initial_temperature = file.initial_temperature;
  located(document, [&] {
    Window const window = window_of(file, tables);
    auto const rows = row_times(file, tables, window);
    data.start_time_of_day = reader.time_of_day(window.from);
    data.time = Eigen::Map<Eigen::VectorXd const>(rows.data(), Eigen::Index(rows.size())).array() - window.from;
    double const first = file.readings_from.value_or(window.from);
    for (std::size_t t = 0; t < tables.size(); ++t)
      located(places[t], [&, &table = file.tables[t]] {
        data.max_gap = t == 0 ? table.max_gap : std::max(data.max_gap, table.max_gap);
        add_columns(table, places[t], tables[t], window.from, rows, first, data);
      });
    add_constants(file, document, data);
    add_clocks(file, data);
    check_names(data);
  });
  return data;
}

}  // namespace thermotwin::twin
