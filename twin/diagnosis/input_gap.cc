#include "twin/diagnosis/input_gap.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <numbers>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "thermal/units.h"
#include "twin/instruments/first_order_lag.h"

namespace thermotwin::twin {
namespace {

using scenarios::DrivenChannel;
using scenarios::Experiment;

constexpr double usual_intervals = 10.0;
constexpr std::size_t least_left = 10;
constexpr double in_a_gap = 0.7;               // deviation of the share of the other extreme
constexpr double late_record = 30.0;           // shorter than what comes and goes in a room [s]
constexpr double late_deviation = 4.0;         // 2 min
constexpr double lag_of_walls = 6.0 * 3600.0;  // of a hall, behind its air [s]
constexpr double share_of_walls = 0.3;         // deviation of what surfaces exchange with them and not with the air
constexpr double least_swing = 0.2;            // of a temperature of which that could be seen [K]
constexpr double daily = 0.15;                 // between the machine's air and that of its record [K]
constexpr double turn_of_a_day = 2.0 * std::numbers::pi / 86400.0;  // [rad/s]
constexpr double settling = 900.0;  // in which a shaft and its bearings forget their speed [s]

/// What is held between rows and whose zero is rest; a stroke's is a place. A share or a switch that never changes is a
/// setting.
bool is_switched(DrivenChannel const& driven) {
  auto const dimension = thermal::dimension_of(driven.channel.unit);
  bool const speed = dimension == thermal::dimension::angular_speed || dimension == thermal::dimension::speed;
  bool const share = dimension == thermal::dimension::dimensionless && !driven.signal.jumps().empty();
  return driven.signal.interpolation() == scenarios::Interpolation::step && (speed || share) &&
         driven.signal.largest_magnitude() > 0.0;
}

std::string owner_of(DrivenChannel const& driven) {
  return driven.channel.name.substr(0, driven.channel.name.find('.'));
}

bool has(std::vector<RecordGap> const& gaps, RecordGap const& gap) {
  return std::find(gaps.begin(), gaps.end(), gap) != gaps.end();
}

std::vector<RecordGap> distinct(std::vector<std::vector<RecordGap>> const& gaps) {
  std::vector<RecordGap> all;
  for (auto const& of_input : gaps)
    for (auto const& gap : of_input)
      if (!has(all, gap)) all.push_back(gap);
  return all;
}

/// In a part of a gap the channels of one owner that have it are at their other extreme.
Experiment otherwise(Experiment experiment, std::vector<std::size_t> const& channels, RecordGap const& part) {
  bool const slow = std::all_of(channels.begin(), channels.end(), [&](std::size_t k) {
    auto const& signal = experiment.driven[k].signal;
    return std::abs(signal.at(part.from)) < 0.5 * signal.largest_magnitude();
  });
  for (std::size_t const k : channels) {
    auto& signal = experiment.driven[k].signal;
    signal = signal.with_piece(part.from, part.to, slow ? signal.largest_magnitude() : 0.0);
  }
  return experiment;
}

void leave_out_rows(MeasuredRun& run, double from, double to) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index row = 0; row < run.time.size(); ++row)
    if (run.time[row] <= from || run.time[row] >= to) kept.push_back(row);
  if (kept.size() < least_left)
    throw thermal::InputError(
        fmt::format("{}: the inputs are missing from {:.2f} h on, and {} rows of readings are left "
                    "beside that; nothing can be said",
                    run.name, from / 3600.0, kept.size()));
  run.time = run.time(kept).eval();
  for (auto& channel : run.channels) channel.values = channel.values(kept).eval();
}

std::string words_of(RecordGap const& gap) {
  return fmt::format("from {:.2f} h to {:.2f} h", gap.from / 3600.0, gap.to / 3600.0);
}

}  // namespace

std::vector<RecordGap> gaps_of(scenarios::SampledInput const& input, double longest, double end) {
  auto times = scenarios::recorded_times(input);
  double const least = std::max(longest, usual_intervals * usual_interval(times));
  times.push_back(end);
  std::vector<RecordGap> gaps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    RecordGap const gap{std::max(0.0, times[i - 1]), std::min(end, times[i])};
    if (gap.to - gap.from > least) gaps.push_back(gap);
  }
  return gaps;
}

void add_alternatives(MeasuredRun& run, std::vector<std::vector<RecordGap>> const& gaps, Experiment const& experiment,
                      scenarios::MachineLimits const& limits) {
  auto const& driven = experiment.driven;
  std::vector<bool> done(driven.size(), false);
  for (std::size_t first = 0; first < driven.size(); ++first) {
    if (done[first] || !is_switched(driven[first])) continue;
    std::vector<std::size_t> together;
    std::vector<std::vector<RecordGap>> theirs;
    for (std::size_t k = first; k < driven.size(); ++k)
      if (owner_of(driven[k]) == owner_of(driven[first]) && is_switched(driven[k])) {
        together.push_back(k);
        theirs.push_back(gaps[k]);
        done[k] = true;
      }
    for (auto const& gap : distinct(theirs)) {
      std::vector<std::size_t> missing;
      std::copy_if(together.begin(), together.end(), std::back_inserter(missing),
                   [&](std::size_t k) { return has(gaps[k], gap); });
      double const middle = 0.5 * (gap.from + gap.to);
      for (auto const& [half, from, to] : {std::tuple{"first", gap.from, middle}, {"second", middle, gap.to}})
        run.alternatives.push_back(
            {fmt::format("{} {}, {} half", driven[missing.front()].channel.name, words_of(gap), half),
             std::make_shared<scenarios::ExperimentCourse const>(otherwise(experiment, missing, {from, to}), limits),
             in_a_gap});
      leave_out_rows(run, gap.from, gap.to + settling);
    }
  }
}

void add_other_air(MeasuredRun& run, Experiment const& experiment, scenarios::MachineLimits const& limits) {
  for (std::size_t k = 0; k < experiment.driven.size(); ++k) {
    auto const& channel = experiment.driven[k].channel;
    auto const& signal = experiment.driven[k].signal;
    auto const& values = signal.values();
    auto const [low, high] = std::minmax_element(values.begin(), values.end());
    bool const of_air = channel.unit == "K" && channel.name.starts_with("ambient.");
    bool const held = signal.interpolation() == scenarios::Interpolation::step;
    if (!of_air || held || *high - *low < least_swing) continue;
    auto const add = [&](std::string const& words, std::vector<double> times, std::vector<double> others,
                         double deviation, bool for_drawn) {
      Experiment other = experiment;
      other.driven[k].signal = scenarios::Signal(std::move(times), std::move(others), scenarios::Interpolation::linear);
      run.alternatives.push_back({channel.name + words,
                                  std::make_shared<scenarios::ExperimentCourse const>(other, limits), deviation,
                                  for_drawn});
    };
    auto earlier = signal.times(), slow = values;
    for (double& t : earlier) t -= late_record;
    add(fmt::format(" {:.0f} s before its record", late_record), std::move(earlier), values, late_deviation, false);
    auto const count = Eigen::Index(values.size());
    FirstOrderLag const walls(Eigen::VectorXd::Map(signal.times().data(), count),
                              Eigen::VectorXd::Map(values.data(), count), lag_of_walls);
    std::transform(signal.times().begin(), signal.times().end(), slow.begin(), [&](double t) { return walls.at(t); });
    add(" as walls follow it", signal.times(), std::move(slow), share_of_walls, false);
    // Beside steps of weights that may be anything it explains the cold of a chiller.
    for (auto const& [words, phase] :
         {std::pair{" and a cosine of the day", 0.5 * std::numbers::pi}, {" and a sine of the day", 0.0}}) {
      auto others = values;
      for (std::size_t i = 0; i < others.size(); ++i) others[i] += std::sin(turn_of_a_day * signal.times()[i] + phase);
      add(words, signal.times(), std::move(others), daily, true);
    }
  }
}

void remark_gaps(std::vector<std::vector<RecordGap>> const& gaps, Experiment const& experiment,
                 std::vector<std::string>& remarks) {
  for (auto const& gap : distinct(gaps)) {
    std::vector<std::string> estimated, others;
    for (std::size_t k = 0; k < gaps.size(); ++k)
      if (has(gaps[k], gap))
        (is_switched(experiment.driven[k]) ? estimated : others).push_back(experiment.driven[k].channel.name);
    std::string remark = fmt::format("not recorded {}: ", words_of(gap));
    if (!estimated.empty())
      remark += fmt::format(
          "{}, which a fit to this run estimates; without a fit the last value is held, and readings after the gap "
          "depend on it (until {:.0f} min after it they are left out)",
          fmt::join(estimated, ", "), settling / 60.0);
    if (!estimated.empty() && !others.empty()) remark += "; ";
    if (!others.empty()) remark += fmt::format("{}, taken from the rows beside the gap", fmt::join(others, ", "));
    remarks.push_back(remark);
  }
}

}  // namespace thermotwin::twin
