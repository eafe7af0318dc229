#include "twin/diagnosis/expected_noise.h"

#include <algorithm>
#include <cmath>

namespace thermotwin::twin {
namespace {

constexpr double per_base = 2.0;  // a tilt is that of two probes 0.7 m apart: √2/0.7 [1/m]

}  // namespace

ChannelNoise expected_noise(Machine const& machine, std::string const& channel, std::vector<BinnedRun> const& runs) {
  bool displacement = false;
  for (auto const& run : runs)
    for (auto const& own : run.run->channels)
      if (own.name == channel) displacement = own.displacement;
  ChannelNoise noise;
  noise.slow_share = displacement ? 0.015 : 0.01;
  if (displacement) {
    bool const rotation = std::any_of(machine.displacements.begin(), machine.displacements.end(),
                                      [&](auto const& d) { return d.name == channel && d.rotation; });
    double const scale = rotation ? per_base : 1.0;
    noise.white = 0.2e-6 * scale;
    noise.rounding = 0.05e-6 * scale;
    noise.fast = 0.3e-6 * scale;
    return noise;
  }
  noise.white = 0.03;
  noise.fast = 0.1;
  for (auto const& sensor : machine.sensors) {
    if (sensor.description.name != channel) continue;
    auto const& kind = sensor.description.kind;
    double const step =
        sensor.description.resolution.value_or(kind == "ds18b20" ? std::pow(2.0, 8 - sensor.description.bits) : 0.01);
    noise.rounding = step / std::sqrt(12.0);
    noise.white = sensor.description.noise.value_or(noise.white);
  }
  return noise;
}

Estimation expected_estimation(Value const& document, std::vector<BinnedRun> const& runs) {
  Machine const machine = Machine::build(document);
  auto const channels = channels_of(runs);
  std::vector<ChannelNoise> noise;
  for (auto const& channel : channels) noise.push_back(expected_noise(machine, channel, runs));
  return {document, runs, channels, noise};
}

}  // namespace thermotwin::twin
