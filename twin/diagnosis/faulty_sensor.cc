#include "twin/diagnosis/faulty_sensor.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace thermotwin::twin {
namespace {

/// Changes from one sample to the next that no body makes: half a kelvin at least, ten times the channel's usual, and
/// alone, where a body's would go on.
int jumps(Eigen::VectorXd const& values) {
  std::vector<double> changes;
  for (Eigen::Index i = 1; i < values.size(); ++i)
    if (double const change = std::abs(values[i] - values[i - 1]); !std::isnan(change)) changes.push_back(change);
  if (changes.size() < 3) return 0;
  auto sorted = changes;
  auto const high = sorted.begin() + std::ptrdiff_t(9 * sorted.size() / 10);
  std::nth_element(sorted.begin(), high, sorted.end());
  double const unusual = std::max(0.5, 10.0 / 3.0 * *high);
  int count = 0;
  for (std::size_t i = 1; i + 1 < changes.size(); ++i)
    if (changes[i] > unusual && std::max(changes[i - 1], changes[i + 1]) < 0.4 * changes[i]) ++count;
  return count;
}

bool hangs_in_air(Machine const& machine, std::string const& name) {
  return std::any_of(machine.sensors.begin(), machine.sensors.end(),
                     [&](Sensor const& sensor) { return sensor.description.name == name && sensor.weights.empty(); });
}

}  // namespace

std::optional<FaultySensor> faulty_sensor(Machine const& machine, std::vector<BinnedRun> const& runs) {
  std::map<std::string, bool> found;
  for (auto const& run : runs)
    for (auto const& channel : run.run->channels) {
      if (channel.displacement) continue;
      bool const dead = channel.values.array().isNaN().all();
      if (dead || (!hangs_in_air(machine, channel.name) && jumps(channel.values) > 1)) found[channel.name] |= dead;
    }
  if (found.size() != 1) return std::nullopt;
  return FaultySensor{found.begin()->first, found.begin()->second};
}

}  // namespace thermotwin::twin
