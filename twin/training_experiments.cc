#include "twin/training_experiments.h"

#include <fmt/format.h>

#include "twin/instruments/random_stream.h"

namespace thermotwin::twin {
namespace {

constexpr double hour = 3600.0;

/// Feeds for 10 to 40 min each, every third a rest.
scenarios::FeedProgram random_feeds(std::string const& axis, double duration, int seed) {
  RandomStream stream(std::uint64_t(seed), "feeds of " + axis);
  scenarios::FeedProgram program;
  program.axis = axis;
  double total = 0.0;
  for (int k = 0; total < duration; ++k) {
    scenarios::FeedBlock block;
    block.duration = stream.uniform(600.0, 2400.0);
    if (k % 3 != 2) block.of_rapid = k == 0 ? 1.0 : stream.uniform();
    total += block.duration;
    program.blocks.push_back(block);
  }
  return program;
}

scenarios::Experiment blank(Machine const& machine, int seed, double duration) {
  scenarios::Experiment experiment;
  experiment.title = fmt::format("training {}", seed);
  experiment.machine = machine.name;
  experiment.duration = duration;
  experiment.seed = seed;
  for (auto const& axis : machine.limits.axes) experiment.axes.push_back(random_feeds(axis.name, duration, seed));
  for (int k = 0; k < int(duration / hour); ++k) experiment.coolant.blocks.push_back({hour, (k + seed) % 2 == 0});
  return experiment;
}

void spin(Machine const& machine, scenarios::Experiment& experiment, scenarios::RandomSpectrum const& spectrum,
          double full_speed) {
  if (machine.limits.max_spindle_speed <= 0.0) return;
  auto& program = experiment.spindle.emplace();
  if (full_speed > 0.0) program.blocks.push_back({full_speed, std::nullopt, 1.0});
  auto const drawn = scenarios::random_blocks(spectrum);
  program.blocks.insert(program.blocks.end(), drawn.begin(), drawn.end());
}

}  // namespace

std::vector<scenarios::Experiment> training_experiments(Machine const& machine, ReducedRange const& range) {
  std::vector<scenarios::Experiment> runs;
  double const middle = 0.5 * (range.coldest_air + range.warmest_air);

  auto& cold = runs.emplace_back(blank(machine, 1, 8 * hour));
  cold.ambient.mean = range.coldest_air;
  cold.ambient.air_conditioning = scenarios::AirConditioning{0.5, 1200.0};
  spin(machine, cold, {8 * hour, 300.0, 1800.0, 0.0, 1.0, 1}, 0.0);

  auto& warm = runs.emplace_back(blank(machine, 2, 8 * hour));
  warm.ambient.mean = range.warmest_air;
  warm.ambient.stratification = range.stratification;
  warm.ambient.door_openings = {{2 * hour, 900.0, -5.0, 600.0}, {5 * hour, 900.0, -5.0, 600.0}};
  spin(machine, warm, {5 * hour, 600.0, 3600.0, 0.2, 1.0, 2}, 2 * hour);

  auto& day = runs.emplace_back(blank(machine, 3, 24 * hour));
  day.ambient.mean = middle;
  day.ambient.stratification = 0.5 * range.stratification;
  day.ambient.daily_cycle = scenarios::DailyCycle{std::min(4.0, middle - range.coldest_air), 15 * hour};
  day.initial_temperature = middle - 3.0;
  spin(machine, day, {8 * hour, 1200.0, 7200.0, 0.0, 1.0, 3}, 8 * hour);

  auto& drift = runs.emplace_back(blank(machine, 4, 8 * hour));
  drift.ambient.mean = middle;
  drift.ambient.drift = std::min(1.0, 0.5 * (range.warmest_air - middle)) / hour;
  drift.initial_temperature = middle + 3.0;
  spin(machine, drift, {8 * hour, 300.0, 2400.0, 0.0, 0.6, 4}, 0.0);
  return runs;
}

}  // namespace thermotwin::twin
