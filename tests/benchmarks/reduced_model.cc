// Workloads W4 and W7 of docs/performance.md: a campaign on a fine machine through its reduced model, and one step of
// the live twin.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>

#include "scenarios/course.h"
#include "twin/live_twin.h"
#include "twin/reduced_twin.h"
#include "twin/run.h"
#include "twin/study/parallel.h"

namespace thermotwin::twin {
namespace {

Machine const& fine_machine() {
  static Machine const machine = Machine::read(machine_file("v450_fine"));
  return machine;
}

/// 8 h: a random spectrum in a room that is another for every seed.
scenarios::Experiment experiment(int seed) {
  scenarios::Experiment experiment;
  experiment.title = "campaign";
  experiment.machine = fine_machine().name;
  experiment.duration = 8 * 3600.0;
  experiment.seed = seed;
  experiment.ambient.mean = 288.15 + (seed * 7) % 16;
  experiment.ambient.stratification = 0.1 * (seed % 6);
  experiment.ambient.daily_cycle = scenarios::DailyCycle{0.5 * (seed % 5), 15 * 3600.0};
  auto& program = experiment.spindle.emplace();
  program.random = scenarios::RandomSpectrum{7 * 3600.0, 300.0, 1800.0, 0.0, 1.0, 1000 + seed};
  return experiment;
}

/// Largest difference of any channel, and by how much at most it leaves its bound.
struct Comparison {
  double reading = 0.0, displacement = 0.0, beyond = -1e9;

  void see(std::vector<output::Channel> const& full, std::vector<output::Channel> const& reduced,
           Eigen::VectorXd const& bound, double& largest) {
    for (std::size_t c = 0; c < full.size(); ++c) {
      double const gap = (full[c].values - reduced[c].values).cwiseAbs().maxCoeff();
      largest = std::max(largest, gap);
      beyond = std::max(beyond, gap - bound[Eigen::Index(c)]);
    }
  }
};

/// W4: construction and 1,000 runs on all threads; then as many of them in full as the argument says.
void campaign(benchmark::State& state) {
  int const runs = 1000, in_full = int(state.range(0));
  for (auto _ : state) {
    ReducedTwin const twin(fine_machine());
    std::vector<ReducedResult> results(runs);
    in_parallel(runs, {}, nullptr, [&](std::size_t i) { results[i] = twin.run(experiment(int(i))); });
    state.PauseTiming();
    Comparison gap;
    for (int k = 0; k < in_full; ++k) {
      int const seed = k * runs / in_full;
      auto const& reduced = results[std::size_t(seed)];
      auto const full = run(fine_machine(), experiment(seed), {});
      Eigen::Map<Eigen::VectorXd const> const bound(reduced.bound.readings.data(),
                                                    Eigen::Index(reduced.bound.readings.size()));
      gap.see(full.dataset.truth_readings, reduced.dataset.truth_readings, bound, gap.reading);
      gap.see(full.dataset.truth_displacements, reduced.dataset.truth_displacements, reduced.bound.displacements,
              gap.displacement);
    }
    double reading = 0.0, displacement = 0.0;
    for (auto const& result : results) {
      reading = std::max(reading, result.bound.largest_reading());
      displacement = std::max(displacement, result.bound.largest_displacement());
    }
    state.counters["shapes"] = twin.network().size();
    state.counters["worst_bound_K"] = reading;
    state.counters["worst_bound_um"] = displacement;
    state.counters["error_K"] = gap.reading;
    state.counters["error_um"] = gap.displacement;
    state.counters["beyond_bound"] = gap.beyond;
    state.ResumeTiming();
  }
}
BENCHMARK(campaign)->Name("w4/reduced_campaign")->Arg(20)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

void construction(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(ReducedTwin(fine_machine()).network().size());
}
BENCHMARK(construction)->Name("w4/construction")->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

void full_run(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(run(fine_machine(), experiment(1), {}).summary.steps);
}
BENCHMARK(full_run)->Name("w4/one_run_in_full")->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

ReducedTwin const& reduced_twin() {
  static ReducedTwin const twin(fine_machine());
  return twin;
}

void reduced_run(benchmark::State& state) {
  int seed = 0;
  auto const& twin = reduced_twin();
  for (auto _ : state) benchmark::DoNotOptimize(twin.run(experiment(seed++ % 20)).steps);
}
BENCHMARK(reduced_run)->Name("w4/one_run_reduced")->Unit(benchmark::kMillisecond);

void live_step(benchmark::State& state) {
  auto const& twin = reduced_twin();
  LiveTwin live(twin, 293.15);
  std::vector<double> input;
  for (auto const& limits : twin.limits()) input.push_back(0.5 * (limits.low + limits.high));
  Eigen::VectorXd const readings = live.readings().array() + 0.1;
  for (auto _ : state) {
    live.advance(input);
    live.correct(readings);
    benchmark::DoNotOptimize(live.displacements().sum());
  }
}
BENCHMARK(live_step)->Name("w7/live_step")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace thermotwin::twin
