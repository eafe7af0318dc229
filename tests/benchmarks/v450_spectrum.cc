#include <benchmark/benchmark.h>
#include <filesystem>
#include <utility>
#include <vector>

#include "scenarios/course.h"
#include "thermal/integrate.h"
#include "twin/machine.h"

/// v450 through 8 h of spectrum at a relative tolerance of 1e-6: the integration alone. v450_spectrum.py is its peer.
namespace thermotwin::twin {
namespace {

void V450Spectrum(benchmark::State& state) {
  auto const machine = Machine::read(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "twin/machines/v450.toml");
  scenarios::Experiment experiment;
  experiment.ambient.mean = 295.15;
  experiment.spindle.emplace();
  experiment.duration = 0.0;
  std::vector<std::pair<double, double>> const spectrum = {{0.25, 3600.0}, {0.5, 3600.0}, {0.75, 3600.0},
                                                           {1.0, 3600.0},  {0.0, 1800.0}, {0.75, 5400.0},
                                                           {0.5, 3600.0},  {1.0, 3600.0}, {0.0, 3600.0}};
  for (auto const& [share, duration] : spectrum) {
    experiment.spindle->blocks.push_back({duration, {}, share});
    experiment.duration += duration;
  }
  scenarios::ExperimentCourse const course(experiment, machine.limits);
  auto const times = scenarios::sample_times(experiment);
  std::vector<double> const start(std::size_t(machine.network().nodes()), 295.15);
  for (auto _ : state) {
    auto const summary = thermal::integrate(machine.network(), course, start, times, {}, [](thermal::Sample const&) {});
    state.counters["steps"] = double(summary.steps);
    state.counters["energy_imbalance"] = summary.energy_imbalance();
  }
}
BENCHMARK(V450Spectrum)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace thermotwin::twin
