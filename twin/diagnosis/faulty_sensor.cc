#include "twin/diagnosis/faulty_sensor.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace thermotwin::twin {
namespace {

constexpr double least_jump = 0.5;  // [K]
constexpr double driven = 180.0;    // after a change of the inputs a light body may warm as fast [s]
constexpr int level = 8;            // samples on each side whose mean is where a reading stands

/// A change from one sample to the next.
struct Change {
  double time, before, by;
};

/// Those between neighbouring samples; across a gap anything may happen.
std::vector<Change> changes_of(Eigen::VectorXd const& time, Eigen::VectorXd const& values) {
  double const usual = usual_interval({time.data(), std::size_t(time.size())});
  std::vector<Change> changes;
  for (Eigen::Index i = 1; i < values.size(); ++i)
    if (double const by = values[i] - values[i - 1]; !std::isnan(by) && time[i] - time[i - 1] < 2.0 * usual)
      changes.push_back({time[i], values[i - 1], by});
  return changes;
}

/// Changes that no body makes: half a kelvin at least, ten times the channel's usual, and alone, where a body's would
/// go on.
std::vector<std::size_t> jumps(std::vector<Change> const& changes) {
  if (changes.size() < 3) return {};
  std::vector<double> sizes;
  for (auto const& change : changes) sizes.push_back(std::abs(change.by));
  auto sorted = sizes;
  auto const high = sorted.begin() + std::ptrdiff_t(9 * sorted.size() / 10);
  std::nth_element(sorted.begin(), high, sorted.end());
  double const unusual = std::max(least_jump, 10.0 / 3.0 * *high);
  std::vector<std::size_t> found;
  for (std::size_t i = 1; i + 1 < sizes.size(); ++i)
    if (sizes[i] > unusual && std::max(sizes[i - 1], sizes[i + 1]) < 0.4 * sizes[i]) found.push_back(i);
  return found;
}

/// The reading stays where it jumped to: its mean over the samples after and before differs by nearly as much, and the
/// samples on either side differ by less.
bool stays(std::vector<Change> const& changes, std::size_t jump) {
  if (jump < level || jump + level >= changes.size()) return false;
  double before = 0.0, after = 0.0, drift = 0.0;
  for (std::size_t i = 1; i <= level; ++i) {
    before += changes[jump - i + 1].before / level;
    after += changes[jump + i].before / level;
    drift += std::abs(changes[jump - i].by) / level + std::abs(changes[jump + i].by) / level;
  }
  double const by = changes[jump].by;
  return std::abs(after - before - by) < 0.3 * std::abs(by) && drift < 0.4 * std::abs(by);
}

std::string jump_text(BinnedRun const& run, Eigen::VectorXd const& values) {
  auto const changes = changes_of(run.run->time, values);
  auto found = jumps(changes);
  std::erase_if(found, [&](std::size_t jump) {
    return run.run->course->next_jump(changes[jump].time - driven) <= changes[jump].time;
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
      else if (auto const text = jump_text(run, channel.values); !text.empty() && !hangs_in_air(machine, channel.name))
        found.try_emplace(channel.name, text);
    }
  if (found.size() != 1) return std::nullopt;
  return FaultySensor{found.begin()->first, found.begin()->second};
}

}  // namespace thermotwin::twin
