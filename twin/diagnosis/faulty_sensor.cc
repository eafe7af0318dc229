#include "twin/diagnosis/faulty_sensor.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace thermotwin::twin {
namespace {

constexpr double least_jump = 0.5;  // [K]
constexpr double driven = 120.0;    // after a change of the inputs a light body may warm as fast [s]
constexpr std::size_t level = 8;    // samples on each side whose mean is where a reading stands
constexpr double unbroken = 1.9;    // usual intervals between neighbouring samples, at most: none is missing

/// A change from one sample to the next.
struct Change {
  double from, time;  ///< of the samples [s]
  double before, by;
  double in_usual = 0.0;  ///< how much of it a body would have done in the usual interval, at the same rate
};

/// Those between neighbouring samples of a channel, whatever rows of others are between; across a gap anything may
/// happen.
std::vector<Change> changes_of(Eigen::VectorXd const& time, Eigen::VectorXd const& values) {
  std::vector<double> times, samples;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    times.push_back(time[i]);
    samples.push_back(values[i]);
  }
  double const usual = usual_interval(times);
  std::vector<Change> changes;
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (double const interval = times[i] - times[i - 1]; interval < unbroken * usual)
      changes.push_back({times[i - 1], times[i], samples[i - 1], samples[i] - samples[i - 1],
                         std::abs(samples[i] - samples[i - 1]) * usual / interval});
  return changes;
}

/// The mean of the readings from one change to another.
double mean(std::vector<Change> const& changes, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (std::size_t i = from; i < to; ++i) sum += changes[i].before;
  return sum / double(to - from);
}

/// The reading stays where it jumped to, and stood still before: its means over the samples after and before differ by
/// nearly as much, those of the halves of each side and neighbouring samples by less.
bool stays(std::vector<Change> const& changes, std::size_t jump) {
  if (jump < level || jump + level >= changes.size()) return false;
  std::size_t const before = jump + 1 - level, after = jump + 1, half = level / 2;
  double moved = 0.0;
  for (std::size_t i = 1; i <= level; ++i)
    moved += (std::abs(changes[jump - i].by) + std::abs(changes[jump + i].by)) / level;
  double const by = std::abs(changes[jump].by);
  auto const jumped = [&](std::size_t from, std::size_t to, std::size_t samples) {
    return mean(changes, to, to + samples) - mean(changes, from, from + samples);
  };
  return std::abs(jumped(before, after, level) - changes[jump].by) < 0.3 * by && moved < 0.4 * by &&
         std::abs(jumped(before, before + half, half)) < 0.25 * by &&
         std::abs(jumped(after, after + half, half)) < 0.25 * by;
}

/// Changes that no body makes: half a kelvin at least, and three times the channel's usual and alone, where a body's
/// would go on, or twice and the reading stays there.
std::vector<std::size_t> jumps(std::vector<Change> const& changes) {
  if (changes.size() < 3) return {};
  std::vector<double> sizes;  // none is larger for its samples being nearer
  for (auto const& change : changes) sizes.push_back(std::min(std::abs(change.by), change.in_usual));
  auto sorted = sizes;
  auto const high = sorted.begin() + std::ptrdiff_t(9 * sorted.size() / 10);
  std::nth_element(sorted.begin(), high, sorted.end());
  std::vector<std::size_t> found;
  for (std::size_t i = 1; i + 1 < sizes.size(); ++i) {
    bool const alone = std::max(changes[i - 1].in_usual, changes[i + 1].in_usual) < 0.4 * sizes[i];
    bool const evident = (sizes[i] > 10.0 / 3.0 * *high && alone) || (sizes[i] > 2.0 * *high && stays(changes, i));
    if (sizes[i] > least_jump && evident) found.push_back(i);
  }
  return found;
}

std::string jump_text(BinnedRun const& run, Eigen::VectorXd const& values) {
  auto const changes = changes_of(run.run->time, values);
  auto found = jumps(changes);
  std::erase_if(found, [&](std::size_t jump) {
    return run.run->course->next_jump(changes[jump].from - driven) <= changes[jump].time;
  });
  if (found.size() > 1) return "jumps about as no body's temperature does";
  if (found.empty() || !stays(changes, found[0])) return "";
  auto const& change = changes[found[0]];
  return fmt::format("jumps by {:.2g} K at {:.2f} h of {} and stays there, as no body's temperature does", change.by,
                     change.time / 3600.0, run.run->name);
}

bool hangs_in_air(Machine const& machine, std::string const& name) {
  return std::any_of(machine.sensors.begin(), machine.sensors.end(),
                     [&](Sensor const& sensor) { return sensor.description.name == name && sensor.weights.empty(); });
}

}  // namespace

std::optional<FaultySensor> faulty_sensor(Machine const& machine, std::vector<BinnedRun> const& runs) {
  std::map<std::string, std::string> found;
  for (auto const& run : runs)
    for (auto const& channel : run.run->channels) {
      if (channel.displacement) continue;
      if (channel.values.array().isNaN().all())
        found[channel.name] = "shows nothing in a run";
      else if (channel.dead_from)
        found[channel.name] =
            fmt::format("moves no more from {:.2f} h of {} on", *channel.dead_from / 3600.0, run.run->name);
      else if (auto const text = jump_text(run, channel.values); !text.empty() && !hangs_in_air(machine, channel.name))
        found.try_emplace(channel.name, text);
    }
  if (found.size() != 1) return std::nullopt;
  return FaultySensor{found.begin()->first, found.begin()->second};
}

}  // namespace thermotwin::twin
