#include "scenarios/logged_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>

#include "thermal/error.h"
#include "thermal/unit.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {
namespace {

using thermal::InputError;

std::string in_quotes(std::string_view text) { return "'" + std::string(text) + "'"; }

bool is_missing(std::string_view field, LoggedFile const& file) {
  return std::find(file.missing.begin(), file.missing.end(), field) != file.missing.end();
}

/// Units: text, no number, and no date that nobody can read.
bool holds_units(CsvFile const& csv, LoggedFile const& file, std::vector<std::size_t> const& places) {
  std::string_view const time = csv.field(places.front());
  if (!time.empty() && std::isdigit(static_cast<unsigned char>(time.front()))) return false;
  if (std::any_of(places.begin(), places.end(), [&](std::size_t place) { return csv.holds_number(place); }))
    return false;
  return std::any_of(places.begin(), places.end(), [&](std::size_t place) {
    return !csv.field(place).empty() && !is_missing(csv.field(place), file);
  });
}

/// Each unit once.
std::string remark_on_units(CsvFile const& csv, std::vector<std::size_t> const& places) {
  std::vector<std::string> units;
  for (std::size_t const place : places) {
    std::string const unit = in_quotes(csv.field(place));
    if (std::find(units.begin(), units.end(), unit) == units.end()) units.push_back(unit);
  }
  std::string text = csv.path().string() + ":" + std::to_string(csv.line()) + ": skipped as a row of units";
  for (std::size_t i = 0; i < units.size(); ++i) text += (i == 0 ? ": " : ", ") + units[i];
  return text;
}

/// Of a field in a row of units: some stand in brackets.
std::string unit_in(std::string_view field) {
  bool const bracketed = field.size() > 2 && (field.front() == '[' || field.front() == '(');
  return thermal::in_ascii(bracketed ? field.substr(1, field.size() - 2) : field);
}

/// Of two units; text that is none contradicts nothing.
bool contradict(std::string const& one, std::string const& other) {
  auto const differ = [](double a, double b) { return std::abs(a - b) > 1e-9 * std::max(std::abs(a), std::abs(b)); };
  try {
    return !(thermal::dimension_of(one) == thermal::dimension_of(other)) ||
           differ(thermal::from_unit(1.0, one), thermal::from_unit(1.0, other)) ||
           differ(thermal::from_unit(0.0, one), thermal::from_unit(0.0, other));
  } catch (InputError const&) {
    return false;
  }
}

std::string kind_of(std::optional<TimeStamp> const& stamp) {
  if (!stamp) return "numbers";
  return stamp->zone ? "time stamps with a time zone" : "time stamps without a time zone";
}

constexpr double most_repeats = 0.1;  // of all rows
std::string const must_increase = ": time must increase";

constexpr std::string_view what_to_write =
    "; write time stamps with their offset, as 2025-11-24T07:00:00+01:00, or seconds";

/// A column of times, row by row. The first says whether all are time stamps.
class TimeColumn {
 public:
  TimeColumn(CsvFile& csv, std::size_t place) : csv_(csv), place_(place), first_(parse_time_stamp(csv.field(place))) {}

  [[nodiscard]] bool stamped() const { return first_.has_value(); }

  /// The number of the present row, or its time from `start` [s].
  double read(std::optional<TimeStamp> const& start) {
    auto const stamp = stamped() ? std::optional(read_stamp()) : std::nullopt;
    double const time = stamp ? seconds_between(*start, *stamp) : number();
    std::string const order = " after " + in_quotes(last_);
    if (time < last_time_) fail(order + must_increase + why_back(stamp));
    if (time == last_time_ && repeats_++ == 0)
      first_repeat_ = csv_.said_of(place_, in_quotes(csv_.field(place_)) + order);
    if (stamp && last_stamp_ && may_be_put_forward(*last_stamp_, *stamp)) remark_ = put_forward();
    last_time_ = time;
    last_stamp_ = stamp;
    last_ = csv_.field(place_);
    return time;
  }

  /// Of the rows that were read.
  [[nodiscard]] std::string const& remark() const { return remark_; }
  /// Of those that have the time of the one before, or nothing; InputError where they are more than a tenth of all: the
  /// times are too coarse then.
  [[nodiscard]] std::string remark_on_repeats(std::size_t rows) const {
    if (repeats_ == 0) return "";
    if (double(repeats_) > most_repeats * double(rows)) throw InputError(first_repeat_ + must_increase);
    std::string const all = repeats_ == 1 ? "" : ", and " + std::to_string(repeats_) + " such rows in all";
    return first_repeat_ + all + ": of rows with one time the last counts";
  }

 private:
  [[nodiscard]] std::string why_back(std::optional<TimeStamp> const& stamp) const {
    if (!stamp || !last_stamp_ || !may_be_put_back(*last_stamp_, *stamp)) return "";
    return "; the clock was probably put back to winter time there" + std::string(what_to_write);
  }

  [[nodiscard]] std::string put_forward() const {
    return csv_.path().string() + ":" + std::to_string(csv_.line()) + ": " + in_quotes(csv_.field(place_)) + " after " +
           in_quotes(last_) +
           ": the clock was probably put forward to summer time there, and all that follows is an hour late" +
           std::string(what_to_write);
  }

  TimeStamp read_stamp() const {
    auto const stamp = parse_time_stamp(csv_.field(place_));
    if (!stamp) fail(" is no time stamp that is read; those are: " + std::string(time_stamp_forms));
    if (kind_of(stamp) != kind_of(first_)) fail(": some rows have a time zone, others none");
    return *stamp;
  }

  double number() {
    if (!csv_.field(place_).empty() && !csv_.holds_number(place_))
      fail(" is no number and no time stamp that is read; those are: " + std::string(time_stamp_forms));
    return csv_.number(place_, MissingValue::refuse);
  }

  [[noreturn]] void fail(std::string const& why) const { csv_.fail(place_, in_quotes(csv_.field(place_)) + why); }

  CsvFile& csv_;
  std::size_t place_;
  std::optional<TimeStamp> first_;
  double last_time_ = -std::numeric_limits<double>::infinity();
  std::optional<TimeStamp> last_stamp_;
  std::string last_;
  std::string remark_;
  std::size_t repeats_ = 0;
  std::string first_repeat_;
};

}  // namespace

void check_units(LoggedTable const& table, LoggedFile const& file, std::vector<std::string> const& columns,
                 std::vector<std::string> const& units) {
  if (table.units.empty()) return;
  auto const check = [&](std::string const& column, std::string const& said, std::string const& unit,
                         std::string const& key) {
    if (said.empty() || unit.empty() || !contradict(said, unit)) return;
    throw InputError(table.file.string() + ":" + std::to_string(table.units_line) + ": column " + in_quotes(column) +
                     ": this row says that its unit is " + in_quotes(said) + ", `" + key + "` says " + in_quotes(unit));
  };
  check(file.time_column, table.units[0], file.time_unit.empty() ? "s" : file.time_unit, "time_unit");
  for (std::size_t i = 0; i < columns.size(); ++i) check(columns[i], table.units[i + 1], units[i], "unit");
}

void check_time_unit(LoggedFile const& file) {
  if (file.time_unit.empty()) return;
  try {
    thermal::require_unit(file.time_unit, thermal::dimension::time);
  } catch (InputError const& error) {
    throw InputError(std::string("time_unit: ") + error.what());
  }
}

/// From the first row, where the file stands.
void TableReader::set_clock(LoggedFile const& file, CsvFile const& csv, std::size_t place) {
  auto const stamp = parse_time_stamp(csv.field(place));
  if (stamp && !file.time_unit.empty()) {
    csv.fail(place, in_quotes(csv.field(place)) + " is a time stamp, which has no unit; leave `time_unit`, " +
                        in_quotes(file.time_unit) + ", out");
  }
  if (clock_.empty()) clock_ = kind_of(stamp);
  if (clock_ != kind_of(stamp) && !file.clock_offset) {
    csv.fail(place, "its times are " + kind_of(stamp) + ", those of the first table " + clock_ +
                        "; `clock_offset` must say how the two clocks lie (\"0 s\": alike)");
  }
  if (!stamp || start_) return;
  start_ = stamp;
  time_at_start_ = file.clock_offset.value_or(0.0);
}

double TableReader::value(LoggedFile const& file, CsvFile& csv, std::size_t place) const {
  std::string_view const field = csv.field(place);
  if (is_missing(field, file)) return std::numeric_limits<double>::quiet_NaN();
  if (missing_ == MissingValue::keep_as_nan && !field.empty() && !csv.holds_number(place))
    csv.fail(place, in_quotes(field) + " is not a number and no word of `missing`");
  return csv.number(place, missing_);
}

LoggedTable TableReader::read(LoggedFile const& file, std::filesystem::path const& path,
                              std::vector<std::string> const& columns) {
  check_time_unit(file);
  CsvFile csv(path, std::size_t(file.header_line));
  std::vector<std::size_t> places = {csv.place_of(file.time_column)};
  for (auto const& column : columns) places.push_back(csv.place_of(column));
  LoggedTable table;
  table.file = path;
  table.columns.resize(columns.size());
  bool row = csv.next();
  if (row && holds_units(csv, file, places)) {
    table.remark = remark_on_units(csv, places);
    table.units_line = csv.line();
    for (std::size_t const place : places) table.units.push_back(unit_in(csv.field(place)));
    row = csv.next();
  }
  if (!row) throw InputError(path.string() + ": has no rows under its header");
  set_clock(file, csv, places.front());
  TimeColumn time(csv, places.front());
  for (; row; row = csv.next()) {
    double const t = time.read(start_);
    if (table.times.empty() || t != table.times.back()) {
      table.times.push_back(t);
      table.lines.push_back(0);
      for (auto& column : table.columns) column.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    table.lines.back() = csv.line();
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (double const read = value(file, csv, places[i + 1]); !std::isnan(read)) table.columns[i].back() = read;
  }
  table.clock_remark = time.remark();
  table.repeats_remark = time.remark_on_repeats(table.times.size());
  if (time.stamped() && !table.units.empty()) table.units[0].clear();
  if (!time.stamped()) thermal::from_unit(table.times, file.time_unit.empty() ? "s" : file.time_unit);
  for (double& t : table.times) t += file.clock_offset.value_or(0.0);
  return table;
}

std::optional<double> TableReader::time_of_day(double t) const {
  if (!start_) return std::nullopt;
  return scenarios::time_of_day(*start_, t - time_at_start_);
}

}  // namespace thermotwin::scenarios
