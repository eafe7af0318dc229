#include "twin/challenge/challenge_runs.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/physical_constant.h"
#include "twin/instruments/random_stream.h"

namespace thermotwin::twin {
namespace {

constexpr double minute = 60.0, hour = 3600.0;

struct Load {
  double duration;  ///< [s]
  double level;     ///< share of the maximum
};
using Loads = std::vector<Load>;

double length_of(Loads const& loads) {
  double sum = 0.0;
  for (auto const& load : loads) sum += load.duration;
  return sum;
}

Loads on_off_and_steps(RandomStream& stream) {
  Loads loads;
  for (int i = 0; i < 5; ++i) loads.insert(loads.end(), {{hour, 1.0}, {hour, 0.0}});
  Loads steps;
  for (double const level : {0.35, 0.65, 1.0}) steps.push_back({2 * hour, level - stream.uniform(0.0, 0.1)});
  std::rotate(steps.begin(), steps.begin() + int(3 * stream.uniform()), steps.end());
  loads.insert(loads.end(), steps.begin(), steps.end());
  return loads;
}

Loads random_blocks(RandomStream& stream, double run, double shortest, double longest) {
  Loads loads;
  while (length_of(loads) < run) {
    double const duration = minute * std::round(stream.uniform(shortest, longest) / minute);
    bool const stands = stream.uniform() < 0.2;
    loads.push_back({duration, stands ? 0.0 : stream.uniform(0.15, 1.0)});
  }
  return loads;
}

Loads loads_of(int run, RandomStream& stream) {
  if (run == 0) return on_off_and_steps(stream);
  if (run == 2) return random_blocks(stream, 8 * hour, 20 * minute, 90 * minute);
  auto loads = random_blocks(stream, 8 * hour, 20 * minute, 20 * minute);
  loads.insert(loads.end(), {{2 * hour, 0.0}, {2 * hour, stream.uniform(0.5, 1.0)}});
  return loads;
}

scenarios::Ambient ambient_of(RandomStream& stream, double duration) {
  scenarios::Ambient ambient;
  ambient.mean = thermal::zero_celsius + stream.uniform(18.0, 25.0);
  ambient.drift = stream.uniform(-1.0, 1.0) / (24 * hour);
  ambient.stratification = stream.uniform(0.0, 0.5);
  ambient.daily_cycle = scenarios::DailyCycle{stream.uniform(0.5, 2.5), hour * stream.uniform(13.0, 17.0)};
  if (stream.uniform() < 0.5)
    ambient.air_conditioning =
        scenarios::AirConditioning{stream.uniform(0.1, 0.5), minute * std::round(stream.uniform(10.0, 40.0))};
  int const doors = 2 + int(3 * stream.uniform());
  for (int i = 0; i < doors; ++i)
    ambient.door_openings.push_back({minute * std::round((i + stream.uniform(0.1, 0.5)) * duration / doors / minute),
                                     minute * std::round(stream.uniform(20.0, 60.0)), stream.uniform(-3.0, -1.0),
                                     minute * std::round(stream.uniform(5.0, 20.0))});
  return ambient;
}

scenarios::Experiment run_of(scenarios::MachineLimits const& limits, std::uint64_t seed, int run) {
  RandomStream stream(seed, fmt::format("run {}", run + 1));
  constexpr double soak = hour;
  double const cool_down = (run == 0 ? 4.0 : 3.0) * hour;
  auto loads = loads_of(run, stream);
  double const loaded = length_of(loads);
  loads.insert(loads.begin(), {soak, 0.0});

  scenarios::Experiment experiment;
  experiment.title = fmt::format("measured run {}", run + 1);
  experiment.duration = soak + loaded + cool_down;
  experiment.seed = int(1 + 3 * (seed % 100'000'000) + std::uint64_t(run));
  experiment.start_time_of_day = minute * std::round(stream.uniform(5.0, 11.0) * 60.0);
  experiment.ambient = ambient_of(stream, experiment.duration);
  experiment.servo.blocks = {{soak / 2, false}, {soak / 2 + loaded + hour, true}};
  experiment.servo.on = false;
  experiment.power.blocks = {{soak + loaded + 2 * hour, true}};
  experiment.power.on = false;
  double const wet = minute * std::round(stream.uniform(1.5, 4.0) * 60.0);
  double const dry = minute * std::round((soak + stream.uniform(0.0, 1.0) * (loaded - wet)) / minute);
  experiment.coolant.blocks = {{dry, false}, {wet, true}};
  experiment.coolant.temperature = experiment.ambient.mean + stream.uniform(-2.0, 1.0);

  if (limits.max_spindle_speed > 0.0) {
    experiment.spindle.emplace();
    for (auto const& load : loads) {
      scenarios::SpeedBlock block;
      block.duration = load.duration;
      if (load.level > 0.0) block.of_maximum = load.level;
      experiment.spindle->blocks.push_back(block);
    }
    return experiment;
  }
  for (auto const& axis : limits.axes) {
    auto& program = experiment.axes.emplace_back();
    program.axis = axis.name;
    for (auto const& load : loads) {
      scenarios::FeedBlock block;
      block.duration = load.duration;
      if (load.level > 0.0) block.of_rapid = 0.7 * load.level;
      program.blocks.push_back(block);
    }
  }
  return experiment;
}

}  // namespace

std::vector<scenarios::Experiment> challenge_runs(scenarios::MachineLimits const& limits, std::uint64_t seed) {
  return {run_of(limits, seed, 0), run_of(limits, seed, 1), run_of(limits, seed, 2)};
}

}  // namespace thermotwin::twin
