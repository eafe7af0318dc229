#include "twin/diagnosis/plausibility.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "models/quantile.h"
#include "thermal/physical_constant.h"
#include "thermal/units.h"
#include "twin/diagnosis/gap.h"
#include "twin/diagnosis/lateness.h"
#include "twin/diagnosis/linearised_run.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using models::upper_median;
using thermal::zero_celsius;

constexpr char const* room = "ambient.temperature";
constexpr double minute = 60.0, hour = 3600.0, day = 86400.0;

constexpr double alike = 0.8;            // correlation
constexpr std::size_t several = 3;       // channels that one mistake shows in
constexpr double least_movement = 1e-6;  // RMS, of a prediction that says anything of sign and unit [m, rad]
constexpr double mirror_gain = 0.4;      // misfit of the mirror image over that of the prediction
constexpr double off_prefix = 3.0;       // factor from a power of a thousand
constexpr double most_movement = 5e-3;   // RMS, of a machine that warms [m, rad]
constexpr double swap_gain = 0.25;       // misfit to the other's prediction over that to its own
constexpr double swap_misfit = 0.5;      // at least, to its own [K RMS]
constexpr double start_error = 3.0;      // K
constexpr double fahrenheit_error = 5.0, fahrenheit_excess = 20.0;  // K
constexpr double coldest_alone = -20.0, hottest_alone = 40.0;       // K, from the room and all others
constexpr double least_shift = 5.0 * minute, same_shift = 3.0 * minute;
constexpr double shift_gain = 0.5;       // of what is not explained
constexpr double least_warming = 1.0;    // K RMS
constexpr double far_more = 3.0;         // times what the machine would go through
constexpr double other_offset = 0.5;     // at the start of a run than of the first one [K]
constexpr double crawling = 0.1;         // of the machine's largest speed
constexpr double hottest_room = 323.15;  // K
constexpr double speed_step = 0.1;       // of the run's largest speed
constexpr double room_response = hour, soonest = 15.0 * minute;
constexpr double room_step = 0.7;    // K, on average over changes of speed
constexpr double steady_room = 0.5;  // K RMS of a sensor in it
constexpr double fewest_steps = 4.0, standard_errors = 4.0;
constexpr double shortest_run = 5.0 * minute, short_run = 2.0 * hour, longest_run = 60.0 * day;
constexpr double longest_interval = 30.0 * minute;

double duration(MeasuredRun const& run) { return run.time[run.time.size() - 1] - run.time[0]; }

/// Whether a factor is near a power of a thousand, as there is one between um, mm and m.
bool is_wrong_prefix(double factor) {
  double const thousands = std::abs(std::log10(factor)) / 3.0;
  return thousands > 0.5 && std::abs(thousands - std::round(thousands)) < std::log10(off_prefix) / 3.0;
}

/// One run beside what the machine would have shown.
class Examination {
 public:
  Examination(Machine const& machine, BinnedRun const& data);
  std::vector<Doubt> operator()();

 private:
  void doubt(std::string const& channel, std::string text) {
    doubts_.push_back({data_.run->name, channel, std::move(text)});
  }
  [[nodiscard]] std::string const& name(Index c) const { return data_.run->channels[std::size_t(c)].name; }
  [[nodiscard]] bool is_displacement(Index c) const { return data_.run->channels[std::size_t(c)].displacement; }
  /// RMS about the mean: of a channel, of its prediction, and of a channel less the prediction of one.
  [[nodiscard]] double movement(Index c) const { return spread(seen_.col(c)); }
  [[nodiscard]] double expected(Index c) const { return spread(due_.col(c) + 0.0 * seen_.col(c)); }
  [[nodiscard]] double misfit(Index seen, Index due) const { return spread(seen_.col(seen) - due_.col(due)); }
  [[nodiscard]] bool reads_fahrenheit(Index c, double shown, double begin);
  [[nodiscard]] bool begins_alone(Index c, double shown);
  void examine_displacement(Index c);
  void examine_swaps();
  void examine_start();
  void examine_clock();
  void examine_motion();
  void examine_room();
  void examine_steady_room();
  void examine_room_with_speed(VectorXd const& air, VectorXd const& speed);
  void examine_time_unit();

  Machine const& machine_;
  BinnedRun const& data_;
  Eigen::MatrixXd const& seen_;
  Eigen::MatrixXd due_;                                   ///< row × channel
  std::vector<std::pair<Index, Sensor const*>> sensors_;  ///< those on bodies
  std::vector<Doubt> doubts_;
};

Examination::Examination(Machine const& machine, BinnedRun const& data)
    : machine_(machine), data_(data), seen_(data.values), due_(LinearisedRun(machine, data).prediction()) {
  for (Index c = 0; c < seen_.cols(); ++c)
    for (auto const& sensor : machine.sensors)
      if (sensor.description.name == name(c) && !sensor.weights.empty()) sensors_.emplace_back(c, &sensor);
}

std::vector<Doubt> Examination::operator()() {
  examine_time_unit();
  examine_start();
  examine_clock();
  examine_motion();
  examine_room();
  for (Index c = 0; c < seen_.cols(); ++c)
    if (is_displacement(c)) examine_displacement(c);
  examine_swaps();
  return std::move(doubts_);
}

/// Its unit and its sign.
void Examination::examine_displacement(Index c) {
  std::string const unit = unit_of(data_.run->channels[std::size_t(c)], machine_);
  double const likeness = correlation(seen_.col(c), due_.col(c)), factor = movement(c) / expected(c);
  bool const tells = expected(c) > least_movement && std::abs(likeness) >= alike;
  if (movement(c) > most_movement || (tells && is_wrong_prefix(factor)))
    return doubt(name(c), fmt::format("{} moves by {:.2f} {} RMS, and as the machine would by {:.2f} {}; is its unit "
                                      "right?",
                                      name(c), 1e6 * movement(c), unit, 1e6 * expected(c), unit));
  if (!tells) return;
  double const mirrored = spread(seen_.col(c) + due_.col(c));
  if (likeness < 0.0 && mirrored < mirror_gain * misfit(c, c))
    doubt(name(c), fmt::format("{} moves against the machine (correlation {:.2f}), and its mirror image misses it by "
                               "{:.1f} {} RMS instead of {:.1f} {}; is its sign right?",
                               name(c), likeness, 1e6 * mirrored, unit, 1e6 * misfit(c, c), unit));
}

void Examination::examine_swaps() {
  for (std::size_t i = 0; i < sensors_.size(); ++i)
    for (std::size_t j = i + 1; j < sensors_.size(); ++j) {
      Index const a = sensors_[i].first, b = sensors_[j].first;
      auto const follows = [&](Index one, Index other) {
        return misfit(one, one) > swap_misfit && misfit(one, other) < swap_gain * misfit(one, one);
      };
      if (!follows(a, b) || !follows(b, a)) continue;
      doubt(name(a), fmt::format("{0} follows what {1} should show to {2:.2f} K RMS and {1} what {0} should to {3:.2f} "
                                 "K, where each misses its own by {4:.2f} and {5:.2f} K; are they swapped?",
                                 name(a), name(b), misfit(a, b), misfit(b, a), misfit(a, a), misfit(b, b)));
    }
}

bool Examination::reads_fahrenheit(Index c, double shown, double begin) {
  double const fahrenheit = zero_celsius + 32.0 + 1.8 * (begin - zero_celsius);
  bool const is = std::abs(shown - fahrenheit) < fahrenheit_error && shown - begin > fahrenheit_excess;
  if (!is) return false;
  doubt(name(c),
        fmt::format("{} begins at {:.1f} degC where the machine is at {:.1f} degC, which is {:.1f} degF; is its "
                    "unit right?",
                    name(c), shown - zero_celsius, begin - zero_celsius, fahrenheit - zero_celsius));
  return true;
}

/// Degrees Celsius that were called Fahrenheit, or another slip: far from the room and from every other sensor.
bool Examination::begins_alone(Index c, double shown) {
  VectorXd const air = data_.run->input(room, data_.time);
  double nearest = air.size() > 0 ? shown - air[0] : std::numeric_limits<double>::quiet_NaN();
  for (auto const& [other, sensor] : sensors_) {
    double const off = shown - data_.run->first_reading(other);
    if (other != c && (std::isnan(nearest) || std::abs(off) < std::abs(nearest))) nearest = off;
  }
  if (!(nearest < coldest_alone || nearest > hottest_alone)) return false;
  doubt(name(c),
        fmt::format("{} begins at {:.1f} degC, {:.0f} K from the room and every other sensor; is its unit right?",
                    name(c), shown - zero_celsius, std::abs(nearest)));
  return true;
}

void Examination::examine_start() {
  auto const temperatures = start_of(machine_, *data_.run);
  std::vector<std::string> away;
  for (auto const& [c, sensor] : sensors_) {
    double const shown = data_.run->first_reading(c);
    double begin = 0.0;
    for (auto const& [node, weight] : sensor->weights) begin += weight * temperatures[std::size_t(node)];
    if (!reads_fahrenheit(c, shown, begin) && !begins_alone(c, shown) && std::abs(shown - begin) > start_error)
      away.push_back(fmt::format("{} {:+.1f} K", name(c), shown - begin));
  }
  if (away.size() >= several)
    doubt("",
          fmt::format("the run does not start at rest with the room: {} from where the machine begins; give `from` a "
                      "time when it was at rest, or `initial_temperature`",
                      fmt::join(away, ", ")));
}

/// Air moves with the room, not with the inputs.
void Examination::examine_clock() {
  std::vector<double> shifts, left;
  auto const examine = [&](Index c) {
    auto const lateness = lateness_of(data_.time, seen_.col(c), due_.col(c));
    if (lateness.agreement < alike) return;
    shifts.push_back(lateness.time);
    left.push_back(lateness.left());
  };
  for (auto const& [c, sensor] : sensors_) examine(c);
  for (Index c = 0; c < seen_.cols(); ++c)
    if (is_displacement(c)) examine(c);
  if (shifts.size() < several) return;
  double const shift = upper_median(shifts);
  auto const agree = std::size_t(
      std::count_if(shifts.begin(), shifts.end(), [&](double other) { return std::abs(other - shift) <= same_shift; }));
  if (agree < several || 3 * agree < 2 * shifts.size()) return;
  if (std::abs(shift) < least_shift || upper_median(left) > shift_gain) return;
  doubt("", fmt::format("{} of {} channels change about {:.0f} min {} what the inputs say; is a clock off?", agree,
                        shifts.size(), std::abs(shift) / minute, shift > 0.0 ? "after" : "before"));
}

/// The middle one of the sensors goes through far more than it should, and time or speed look small.
void Examination::examine_motion() {
  std::vector<double> seen, would;
  for (auto const& [c, sensor] : sensors_)
    if (std::isfinite(movement(c))) {
      seen.push_back(movement(c));
      would.push_back(expected(c));
    }
  if (seen.empty() || upper_median(seen) < std::max(least_warming, far_more * upper_median(would))) return;
  std::string const text = fmt::format("the sensors go through {:.1f} K RMS where the machine would through {:.1f} K",
                                       upper_median(seen), upper_median(would));
  VectorXd const speed = data_.run->input("spindle.speed", data_.time);
  double const fastest = speed.size() > 0 ? speed.cwiseAbs().maxCoeff() : 0.0;
  if (fastest > 0.0 && fastest < crawling * machine_.limits.max_spindle_speed)
    doubt("spindle.speed", fmt::format("{}, and the spindle reaches {:.0f} of {:.0f} rpm; is the unit of its speed "
                                       "right?",
                                       text, thermal::to_unit(fastest, "rpm"),
                                       thermal::to_unit(machine_.limits.max_spindle_speed, "rpm")));
  else if (double const lasts = duration(*data_.run); lasts > shortest_run && lasts < short_run)
    doubt("", fmt::format("{}, in {:.0f} min; is `time_unit` right?", text, lasts / minute));
}

void Examination::examine_room() {
  VectorXd const air = data_.run->input(room, data_.time), speed = data_.run->input("spindle.speed", data_.time);
  if (air.size() == 0) return;
  if (air.mean() > hottest_room)
    doubt(room, fmt::format("the room is at {:.1f} degC on average; is its unit right?", air.mean() - zero_celsius));
  if (speed.size() > 0) examine_room_with_speed(air, speed);
  if (spread(air) == 0.0) examine_steady_room();
}

/// Given as one value, where sensors in the air say that it was not one.
void Examination::examine_steady_room() {
  for (auto const& sensor : machine_.sensors) {
    if (!sensor.weights.empty()) continue;
    for (Index c = 0; c < seen_.cols(); ++c)
      if (name(c) == sensor.description.name && movement(c) > steady_room)
        doubt(room,
              fmt::format("the room is given as steady, and {}, which hangs in the air, goes through {:.1f} K RMS; "
                          "is there no record of the room?",
                          name(c), movement(c)));
  }
}

/// By how much the air rises in the hour after the spindle became faster, and falls after it became slower.
void Examination::examine_room_with_speed(VectorXd const& air, VectorXd const& speed) {
  std::vector<Index> steps;
  for (Index r = 1; r < speed.size(); ++r)
    if (std::abs(speed[r] - speed[r - 1]) > speed_step * speed.cwiseAbs().maxCoeff()) steps.push_back(r);
  steps.push_back(speed.size());
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (std::size_t s = 0; s + 1 < steps.size(); ++s) {
    Index const from = steps[s];
    Index to = from;
    while (to + 1 < steps[s + 1] && data_.time[to + 1] <= data_.time[from] + room_response) ++to;
    if (data_.time[to] < data_.time[from] + soonest) continue;
    bool const faster = std::abs(speed[from]) > std::abs(speed[from - 1]);
    double const change = (faster ? 1.0 : -1.0) * (air[to] - air[from - 1]);
    sum += change;
    squares += change * change;
    count += 1.0;
  }
  double const mean = sum / count, error = std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
  if (count >= fewest_steps && mean > std::max(room_step, standard_errors * error))
    doubt(room,
          fmt::format("the room warms when the spindle becomes faster and cools when it becomes slower, by {:.1f} "
                      "K within the hour after each of {:.0f} changes; does its sensor hang on the machine?",
                      mean, count));
}

void Examination::examine_time_unit() {
  double const lasts = duration(*data_.run), interval = lasts / double(data_.run->time.size() - 1);
  if (lasts < shortest_run)
    return doubt("", fmt::format("the run lasts {:.0f} s in all; is `time_unit` right?", lasts));
  if (lasts > longest_run)
    return doubt("", fmt::format("the run lasts {:.0f} days; is `time_unit` right?", lasts / day));
  if (interval > longest_interval)
    doubt("", fmt::format("the samples lie {:.0f} min apart; is `time_unit` right?", interval / minute));
}

bool is_same(VectorXd const& a, VectorXd const& b) {
  return a.size() == b.size() && (a.array() == b.array() || (a.array().isNaN() && b.array().isNaN())).all();
}

bool hold_the_same(MeasuredRun const& a, MeasuredRun const& b) {
  return is_same(a.time, b.time) &&
         std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(),
                    [](auto const& x, auto const& y) { return x.name == y.name && is_same(x.values, y.values); });
}

/// Sensors on bodies that stand otherwise against the rest than in the first run, where both begin at rest: their
/// offsets are taken to be the same in all runs.
void compare_offsets(Machine const& machine, BinnedRun const& first, BinnedRun const& run, std::vector<Doubt>& doubts) {
  if (first.run->warm_start || run.run->warm_start) return;
  auto const begins_at = [](MeasuredRun const& of, std::string const& sensor) {
    auto const& channels = of.channels;
    auto const channel =
        std::find_if(channels.begin(), channels.end(), [&](auto const& c) { return c.name == sensor; });
    bool const has_past = of.time[0] > 10.0 * minute;
    return channel == channels.end() || has_past ? std::nan("") : channel->values[0];
  };
  std::vector<std::pair<std::string, double>> risen;
  std::vector<double> rises;
  for (auto const& sensor : machine.sensors) {
    auto const& name = sensor.description.name;
    double const rise = begins_at(*run.run, name) - begins_at(*first.run, name);
    if (sensor.weights.empty() || !std::isfinite(rise)) continue;
    risen.emplace_back(name, rise);
    rises.push_back(rise);
  }
  if (rises.size() <= several) return;
  double const room_rise = upper_median(rises);
  for (auto const& [sensor, rise] : risen)
    if (std::abs(rise - room_rise) > other_offset)
      doubts.push_back({run.run->name, sensor,
                        fmt::format("{} stands {:+.1f} K otherwise against the other sensors than at the start of {}; "
                                    "was it exchanged, or calibrated anew?",
                                    sensor, rise - room_rise, first.run->name)});
}

}  // namespace

std::vector<Doubt> doubts(Machine const& machine, std::vector<BinnedRun> const& runs) {
  std::vector<Doubt> all;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    auto const& name = runs[r].run->name;
    for (auto& doubt : Examination(machine, runs[r])()) all.push_back(std::move(doubt));
    if (r > 0) compare_offsets(machine, runs[0], runs[r], all);
    for (std::size_t before = 0; before < r; ++before)
      if (hold_the_same(*runs[before].run, *runs[r].run))
        all.push_back({name, "",
                       fmt::format("{}, given as number {}, holds the same readings as {}, given as number {}: "
                                   "they count once more, and test nothing",
                                   name, r + 1, runs[before].run->name, before + 1)});
  }
  return all;
}

nlohmann::ordered_json doubts_json(std::vector<Doubt> const& doubts) {
  auto list = nlohmann::ordered_json::array();
  for (auto const& doubt : doubts)
    list.push_back({{"run", doubt.run}, {"channel", doubt.channel}, {"text", doubt.text}});
  return list;
}

std::string doubt_lines(std::vector<Doubt> const& doubts) {
  if (doubts.empty()) return "";
  std::string text = "\nLook at the data first; all that follows takes them as they are:\n";
  for (auto const& doubt : doubts) text += fmt::format("  {}: {}\n", doubt.run, doubt.text);
  return text;
}

}  // namespace thermotwin::twin
