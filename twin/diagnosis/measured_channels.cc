#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <optional>

#include "models/quantile.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"
#include "twin/diagnosis/measured_data.h"

namespace thermotwin::twin {
namespace {

namespace dimension = thermal::dimension;
using thermal::InputError;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr double coldest = 213.15, hottest = 523.15;  // K, that a sensor of a machine shows
constexpr double power_on = 358.15;                   // K, of a DS18B20
constexpr int fewest_rows_of_standstill = 20;
constexpr double least_share_of_standstill = 0.1;
constexpr double least_chance_of_standstill = 1e-5;

constexpr double least_spike_kelvin = 2.0, least_spike_length = 20e-6;  // [K, m]
constexpr double spike_over_usual = 20.0;                               // of the median change from row to row
constexpr double returns_within = 0.2;                                  // of a spike
constexpr double most_spikes = 0.05;                                    // of all rows
constexpr std::size_t fewest_changes = 10;

double median_of_finite(Eigen::VectorXd const& values) {
  std::vector<double> finite;
  for (double const value : values)
    if (std::isfinite(value)) finite.push_back(value);
  return finite.empty() ? missing : models::upper_median(std::move(finite));
}

/// Of what a channel of the machine is the reading.
struct Expected {
  std::string name;
  bool displacement = false;
  thermal::Dimension dimension;
};

std::vector<Expected> expected_channels(Machine const& machine) {
  std::vector<Expected> expected;
  for (auto const& sensor : machine.sensors)
    expected.push_back({sensor.description.name, false, dimension::temperature_difference});
  for (auto const& channel : machine.linear_channels)
    expected.push_back({channel.name, true, channel.rotation ? dimension::angle : dimension::length});
  return expected;
}

std::vector<Expected> all_channels(MeasuredData const& data) {
  std::vector<Expected> all;
  for (auto const& channel : data.readings) all.push_back({channel.name, false, dimension::temperature_difference});
  for (auto const& channel : data.displacements)
    all.push_back({channel.name, true, thermal::dimension_of(channel.unit)});
  return all;
}

bool is_impossible(double temperature) { return temperature < coldest || temperature > hottest; }

bool is_about_power_on(double temperature) { return std::abs(temperature - power_on) < 5.0; }

/// Rows of a channel that a sensor shows that does not measure: one value throughout, which none shows that works.
struct Failure {
  Eigen::Index first, count;

  [[nodiscard]] std::string rows_text(Eigen::VectorXd const& time) const {
    return fmt::format("in {} row{} from {:.2f} h on", count, count == 1 ? "" : "s", time[first] / 3600.0);
  }
};

/// Those whose value is so; nothing where there are none, or several values.
template <class Test>
std::optional<Failure> find_failure(Eigen::VectorXd const& values, Test is_so) {
  Failure found{-1, 0};
  for (Eigen::Index r = 0; r < values.size(); ++r) {
    if (!is_so(values[r])) continue;
    if (found.count++ == 0) found.first = r;
    if (values[r] != values[found.first]) return std::nullopt;
  }
  return found.count > 0 ? std::optional(found) : std::nullopt;
}

template <class Test>
void leave_out(Eigen::VectorXd& values, Test is_so) {
  for (double& value : values)
    if (is_so(value)) value = missing;
}

/// What a broken sensor shows, and a DS18B20 that was just switched on and has not converted yet: missing, and told.
void leave_out_failures(MeasuredChannel& channel, output::Channel const& shown, Eigen::VectorXd const& time,
                        std::vector<std::string>& remarks) {
  auto& values = channel.values;
  if (auto const broken = find_failure(values, is_impossible)) {
    remarks.push_back(fmt::format("'{}' reads {:.1f} {} {}, which no sensor of a machine shows: left out", channel.name,
                                  shown.values[broken->first], shown.unit, broken->rows_text(time)));
    leave_out(values, is_impossible);
  }
  auto const on = find_failure(values, is_about_power_on);
  if (!on || std::abs(values[on->first] - power_on) > 1e-6) return;
  remarks.push_back(fmt::format("'{}' reads 85 degC {}, as a DS18B20 does that was switched on: left out", channel.name,
                                on->rows_text(time)));
  leave_out(values, is_about_power_on);
}

/// Rows in which a channel was read; those of other tables are between them.
std::vector<Eigen::Index> rows_read(Eigen::VectorXd const& values) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index r = 0; r < values.size(); ++r)
    if (std::isfinite(values[r])) rows.push_back(r);
  return rows;
}

/// Rows that stand alone: far from the reading before and the one after, which are near each other. No body and no
/// tool goes there and back between samples.
std::vector<Eigen::Index> spikes_of(Eigen::VectorXd const& values, double least) {
  auto const rows = rows_read(values);
  std::vector<double> steps;
  for (std::size_t i = 1; i < rows.size(); ++i) steps.push_back(std::abs(values[rows[i]] - values[rows[i - 1]]));
  if (steps.size() < fewest_changes) return {};
  double const usual = models::upper_median(steps), far = std::max(least, spike_over_usual * usual);
  std::vector<Eigen::Index> spikes;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    double const before = values[rows[i - 1]], here = values[rows[i]], after = values[rows[i + 1]];
    bool const one_way = (here - before) * (here - after) > 0.0;
    double const off = std::min(std::abs(here - before), std::abs(here - after));
    if (one_way && off > far && std::abs(after - before) < returns_within * off) spikes.push_back(rows[i]);
  }
  return double(spikes.size()) < most_spikes * double(rows.size()) ? spikes : std::vector<Eigen::Index>{};
}

/// Missing, and told.
void leave_out_spikes(MeasuredChannel& channel, output::Channel const& shown, Eigen::VectorXd const& time,
                      std::vector<std::string>& remarks) {
  auto const spikes = spikes_of(channel.values, channel.displacement ? least_spike_length : least_spike_kelvin);
  if (spikes.empty()) return;
  auto const first = spikes.front();
  remarks.push_back(
      fmt::format("'{}' reads {:.4g} {} in one row at {:.2f} h{}, far from the rows before and after: "
                  "left out",
                  channel.name, shown.values[first], shown.unit, time[first] / 3600.0,
                  spikes.size() == 1 ? "" : fmt::format(", and so in {} more", spikes.size() - 1)));
  for (auto const row : spikes) channel.values[row] = missing;
}

MeasuredChannel in_si(output::Channel const& channel, Expected const& expected, MeasuredData const& data,
                      std::vector<std::string>& remarks) {
  if (thermal::dimension_of(channel.unit) != expected.dimension)
    throw InputError(fmt::format("channel '{}' is in {}, the machine's is a {}", channel.name, channel.unit,
                                 expected.displacement ? thermal::name_of(expected.dimension) : "temperature"));
  MeasuredChannel result{channel.name, expected.displacement, channel.values};
  if (auto const clock = data.clocks.find(channel.name); clock != data.clocks.end()) result.clock = clock->second;
  thermal::from_unit({result.values.data(), std::size_t(result.values.size())}, channel.unit);
  if (!expected.displacement) leave_out_failures(result, channel, data.time, remarks);
  leave_out_spikes(result, channel, data.time, remarks);
  if (expected.displacement) return result;
  if (is_impossible(median_of_finite(result.values)))
    throw InputError(fmt::format("sensor '{}' reads {:.1f} {} most of the time; is its unit right?", channel.name,
                                 median_of_finite(channel.values), channel.unit));
  leave_out(result.values, is_impossible);
  return result;
}

bool moves(Eigen::VectorXd const& values) {
  double first = missing;
  for (double const value : values) {
    if (!std::isfinite(value)) continue;
    if (std::isnan(first)) first = value;
    if (value != first) return true;
  }
  return false;
}

/// Row from which on a channel repeats one value, longer than chance has it repeat values before: coarse readings of a
/// body that is nearly steady do so as well. The number of rows if it never does.
Eigen::Index stops_moving(Eigen::VectorXd const& all) {
  auto const read = rows_read(all);
  Eigen::VectorXd const values = all(read);
  Eigen::Index const rows = values.size();
  Eigen::Index from = rows - 1;
  while (from > 0 && values[from - 1] == values[rows - 1]) --from;
  double const still = double(rows - from);
  if (still < fewest_rows_of_standstill || still < least_share_of_standstill * double(rows)) return all.size();
  Eigen::Index const before = std::min<Eigen::Index>(from, fewest_rows_of_standstill);
  double repeats = 0.0;
  for (Eigen::Index r = from - before + 1; r < from; ++r) repeats += values[r] == values[r - 1] ? 1.0 : 0.0;
  double const usual = (repeats + 1.0) / (double(before) + 1.0);
  return std::pow(usual, still) < least_chance_of_standstill ? read[std::size_t(from)] : all.size();
}

void bury_dead(std::vector<MeasuredChannel>& channels, Eigen::VectorXd const& time, std::vector<std::string>& remarks) {
  bool const any = std::any_of(channels.begin(), channels.end(), [](auto const& c) { return moves(c.values); });
  if (!any) throw InputError("none of the machine's channels moves in the data: every sensor is dead");
  for (auto& channel : channels) {
    if (!moves(channel.values)) {
      auto const read = rows_read(channel.values);
      if (read.size() > 1) channel.still = channel.values[read.front()];
      remarks.push_back(read.empty() ? fmt::format("'{}' is dead: no reading", channel.name)
                                     : remark_of_still(channel.name));
      channel.values.setConstant(missing);
    } else if (auto const from = stops_moving(channel.values); from < time.size()) {
      remarks.push_back(
          fmt::format("'{}' is dead from {:.2f} h on: it moves no more", channel.name, time[from] / 3600));
      channel.values.tail(time.size() - from).setConstant(missing);
      channel.dead_from = time[from];
    }
  }
}

/// The first row in which anything was read.
Eigen::Index first_row(std::vector<MeasuredChannel> const& channels, Eigen::Index rows) {
  for (Eigen::Index r = 0; r < rows; ++r)
    for (auto const& channel : channels)
      if (std::isfinite(channel.values[r])) return r;
  return 0;
}

/// In which a channel has no reading.
RecordGap longest_gap(MeasuredChannel const& channel, Eigen::VectorXd const& time, Eigen::Index first) {
  RecordGap longest;
  double last = time[first];
  for (Eigen::Index r = first; r < time.size(); ++r) {
    if (std::isnan(channel.values[r]) && r + 1 < time.size()) continue;
    if (time[r] - last > longest.to - longest.from) longest = {last, time[r]};
    last = time[r];
  }
  return longest;
}

/// One remark for all channels that lack the same rows.
void remark_gaps(std::vector<MeasuredChannel> const& channels, MeasuredData const& data, Eigen::Index first,
                 std::vector<std::string>& remarks) {
  std::vector<std::pair<RecordGap, std::vector<std::string>>> gaps;
  for (auto const& channel : channels) {
    auto const gap = longest_gap(channel, data.time, first);
    if (gap.to - gap.from <= data.max_gap || channel.values.array().isNaN().all()) continue;
    auto const same = std::find_if(gaps.begin(), gaps.end(), [&](auto const& known) { return known.first == gap; });
    (same == gaps.end() ? gaps.emplace_back(gap, std::vector<std::string>{}) : *same).second.push_back(channel.name);
  }
  for (auto const& [gap, names] : gaps) {
    auto const rows = (data.time.array() > gap.from && data.time.array() < gap.to).count();
    std::string const who =
        names.size() == 1 ? fmt::format("'{}' has", names[0]) : fmt::format("{} channels have", names.size());
    remarks.push_back(fmt::format(
        "{} no reading for {:.2f} h from {:.2f} h on, {}{}", who, (gap.to - gap.from) / 3600.0, gap.from / 3600.0,
        rows == 0 ? "where the data have no rows" : fmt::format("in {} row{}", rows, rows == 1 ? "" : "s"),
        names.size() == 1 ? "" : fmt::format(": {}", fmt::join(names, ", "))));
  }
}

void remark_strangers(MeasuredData const& data, std::vector<Expected> const& expected,
                      std::vector<std::string>& remarks) {
  std::vector<std::string> strangers, absent;
  auto const known = [&](std::string const& name) {
    return std::any_of(expected.begin(), expected.end(), [&](auto const& e) { return e.name == name; });
  };
  for (auto const& e : expected)
    if (!find_channel(e.displacement ? data.displacements : data.readings, e.name)) absent.push_back(e.name);
  for (auto const* group : {&data.readings, &data.displacements})
    for (auto const& channel : *group) {
      if (known(channel.name)) continue;
      auto const meant = thermal::meant_name(channel.name, absent);
      strangers.push_back(meant.empty() ? channel.name : fmt::format("{} (did you mean '{}'?)", channel.name, meant));
    }
  if (!strangers.empty()) remarks.push_back(fmt::format("in the data, but not used: {}", fmt::join(strangers, ", ")));
  if (!absent.empty())
    remarks.push_back(fmt::format("of the machine, but not in the data: {}", fmt::join(absent, ", ")));
}

[[noreturn]] void no_channel(MeasuredData const& data, std::vector<Expected> const& expected, Machine const& machine) {
  std::vector<std::string> names;
  for (auto const& e : expected) names.push_back(e.name);
  for (auto const* group : {&data.readings, &data.displacements})
    if (!group->empty())
      throw InputError(fmt::format("no channel of the data is one of the machine '{}': there is '{}'; {}", machine.name,
                                   group->front().name, thermal::did_you_mean(group->front().name, names)));
  throw InputError("the data have no readings at all");
}

std::vector<MeasuredChannel> living_channels(MeasuredData const& data, std::vector<MeasuredChannel> channels,
                                             std::vector<std::string>& remarks) {
  bury_dead(channels, data.time, remarks);
  remark_gaps(channels, data, first_row(channels, data.time.size()), remarks);
  return channels;
}

[[noreturn]] void contradicts(Expected const& expected, output::Channel const& channel) {
  auto const kind = [](bool displacement) { return displacement ? "displacement" : "temperature"; };
  throw InputError(fmt::format("'{}': channel {} of the data is a {}, the machine's is a {}", channel.unit,
                               expected.name, kind(!expected.displacement), kind(expected.displacement)));
}

}  // namespace

std::string remark_of_still(std::string const& channel) { return fmt::format("'{}' is dead: it never moves", channel); }

std::vector<MeasuredChannel> channels_of(MeasuredData const& data, Machine const& machine,
                                         std::vector<std::string>& remarks) {
  auto const expected = expected_channels(machine);
  std::vector<MeasuredChannel> channels;
  for (auto const& e : expected)
    located(data.reading_tables, e.name, [&] {
      if (auto const* channel = find_channel(e.displacement ? data.displacements : data.readings, e.name))
        channels.push_back(in_si(*channel, e, data, remarks));
      else if (auto const* other = find_channel(e.displacement ? data.readings : data.displacements, e.name))
        contradicts(e, *other);
    });
  if (channels.empty()) no_channel(data, expected, machine);
  channels = living_channels(data, std::move(channels), remarks);
  remark_strangers(data, expected, remarks);
  return channels;
}

std::vector<MeasuredChannel> channels_of(MeasuredData const& data, std::vector<std::string>& remarks) {
  std::vector<MeasuredChannel> channels;
  for (auto const& e : all_channels(data))
    located(data.reading_tables, e.name, [&] {
      channels.push_back(
          in_si(*find_channel(e.displacement ? data.displacements : data.readings, e.name), e, data, remarks));
    });
  return living_channels(data, std::move(channels), remarks);
}

}  // namespace thermotwin::twin
