// Workloads W4 and W7 of docs/performance.md: a campaign on a fine machine through its reduced model, and one step of
// the live twin.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <set>

#include "twin/instruments/random_stream.h"
#include "twin/live_twin.h"
#include "twin/parallel.h"
#include "twin/reduced_twin.h"
#include "twin/run.h"

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

/// Largest difference of any channel, and the largest share of its bound; 1e-6 K or um is agreement.
struct Comparison {
  double reading = 0.0, displacement = 0.0, share = 0.0;

  void see(output::Dataset const& full, ReducedResult const& reduced) {
    auto const& d = reduced.bound.displacements;
    see(full.truth_readings, reduced.dataset.truth_readings, reduced.bound.readings, reading);
    see(full.truth_displacements, reduced.dataset.truth_displacements, {d.begin(), d.end()}, displacement);
  }
  void see(std::vector<output::Channel> const& full, std::vector<output::Channel> const& reduced,
           std::vector<double> const& bound, double& largest) {
    for (std::size_t c = 0; c < full.size(); ++c) {
      double const gap = (full[c].values - reduced[c].values).cwiseAbs().maxCoeff();
      largest = std::max(largest, gap);
      share = std::max(share, gap / (bound[c] + 1e-6));
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
      gap.see(run(fine_machine(), experiment(seed), {}).dataset, reduced);
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
    state.counters["share_of_bound"] = gap.share;
    state.ResumeTiming();
  }
}
BENCHMARK(campaign)->Name("w4/reduced_campaign")->Arg(20)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

scenarios::FeedProgram feeds(std::string const& axis, RandomStream& stream) {
  scenarios::FeedProgram program;
  program.axis = axis;
  for (double total = 0.0; total < 7 * 3600.0; total += program.blocks.back().duration) {
    scenarios::FeedBlock block;
    block.duration = stream.uniform(300.0, 3000.0);
    if (stream.uniform() > 0.4) block.of_rapid = stream.uniform();
    program.blocks.push_back(block);
  }
  return program;
}

/// 8 h of what the reduced model has not seen: spindle, feeds, coolant, room.
scenarios::Experiment fresh(Machine const& machine, int seed) {
  RandomStream stream(std::uint64_t(seed), "fresh");
  scenarios::Experiment experiment;
  experiment.title = "fresh";
  experiment.machine = machine.name;
  experiment.duration = 8 * 3600.0;
  experiment.seed = seed;
  experiment.ambient.stratification = stream.uniform();
  experiment.ambient.mean = stream.uniform(285.15, 304.15);
  if (seed % 2 == 1) experiment.ambient.daily_cycle = scenarios::DailyCycle{stream.uniform(0.0, 1.5), 15 * 3600.0};
  double const shortest = stream.uniform(60.0, 900.0), longest = shortest + stream.uniform(300.0, 5000.0);
  experiment.spindle.emplace().random =
      scenarios::RandomSpectrum{7 * 3600.0, shortest, longest, 0.0, stream.uniform(0.4, 1.0), 5000 + seed};
  for (auto const& axis : machine.limits.axes) experiment.axes.push_back(feeds(axis.name, stream));
  for (int k = 0; k < 8; ++k) experiment.coolant.blocks.push_back({3600.0, stream.uniform() > 0.5});
  return experiment;
}

/// How often the bound holds in all channels of a run; the full runs are made to 1e-7.
void bound(benchmark::State& state, std::string const& name) {
  auto const machine = Machine::read(machine_file(name));
  auto const runs = std::size_t(state.range(0));
  RunOptions tight;
  tight.integration.relative_tolerance = tight.integration.absolute_tolerance = 1e-7;
  for (auto _ : state) {
    ReducedTwin const twin(machine);
    std::vector<Comparison> gaps(runs);
    in_parallel(runs, {}, nullptr, [&](std::size_t i) {
      auto const experiment = fresh(machine, int(i) + 1);
      gaps[i].see(run(machine, experiment, tight).dataset, twin.run(experiment));
    });
    double held = 0.0;
    Comparison worst;
    for (auto const& gap : gaps) {
      held += gap.share <= 1.0 ? 1.0 : 0.0;
      worst.reading = std::max(worst.reading, gap.reading);
      worst.displacement = std::max(worst.displacement, gap.displacement);
      worst.share = std::max(worst.share, gap.share);
    }
    state.counters["held"] = held;
    state.counters["error_K"] = worst.reading;
    state.counters["error_um"] = worst.displacement;
    state.counters["share_of_bound"] = worst.share;
  }
}
BENCHMARK_CAPTURE(bound, v450, "v450")->Arg(200)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(bound, g200, "g200")->Arg(200)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(bound, spindle_5probe, "spindle_5probe")->Arg(200)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(bound, v450_fine, "v450_fine")->Arg(20)->Iterations(1)->Unit(benchmark::kSecond);

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

/// What an evaluation reads at least: the shapes at the laws' ports, for temperatures and again for heat.
double bytes_of_evaluation(thermal::ReducedNetwork const& network) {
  std::set<int> ports;
  for (auto const& group : network.groups())
    for (int const port : group.ports)
      if (!network.shape_of_port(port).isZero(0.0)) ports.insert(port);
  return 2.0 * sizeof(double) * double(ports.size()) * network.size();
}

void reduced_run(benchmark::State& state) {
  int seed = 0;
  auto const& twin = reduced_twin();
  double evaluations = 0.0;
  for (auto _ : state) evaluations += double(twin.run(experiment(seed++ % 20)).rate_evaluations);
  state.counters["shapes"] = twin.network().size();
  state.counters["least_bytes"] =
      benchmark::Counter(evaluations * bytes_of_evaluation(twin.coarse_network()), benchmark::Counter::kAvgIterations);
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
  state.counters["least_bytes"] =
      2.0 * bytes_of_evaluation(twin.network()) + double(live.gain().size() * sizeof(double));
}
BENCHMARK(live_step)->Name("w7/live_step")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace thermotwin::twin
