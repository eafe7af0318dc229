// What a placement is worth (docs/placement.md): shares of the optimum, bounds, other methods, dead sensors, and
// whether predicted errors come true.
//
//   thermotwin_bench --benchmark_filter=Placement
//
// Counters are the results; times are those of the search alone.
#include "models/placement.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <numeric>
#include <vector>

#include "models/placement_bound.h"
#include "tests/twin/placement/drawn_machines.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Sites = std::vector<Index>;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Optimum over found, of the variance; 200 machines, 1 to 6 of 24 sensors.
void PlacementAgainstExhaustive(benchmark::State& state) {
  std::vector<double> shares;
  for (auto _ : state)
    for (int seed = 0; seed < 200; ++seed) {
      state.PauseTiming();
      auto const problem = drawn_at_random(RandomMachine(std::uint64_t(seed)), 6, 0).problem();
      state.ResumeTiming();
      auto const found = shares_of_optimum(problem);
      shares.insert(shares.end(), found.begin(), found.end());
    }
  state.counters["least"] = *std::min_element(shares.begin(), shares.end());
  state.counters["exact"] = 1.0 - share_below(shares, 1.0 - 1e-9);
}
BENCHMARK(PlacementAgainstExhaustive)->Unit(benchmark::kMillisecond)->Iterations(1);

/// 8 of 200 sites: the bound as a share of the error and of its square.
void PlacementBound(benchmark::State& state, std::string const& name, Teacher teacher) {
  auto const problem = drawn_as_shipped(name, 24, 0).problem(teacher);
  double found = 0.0, bound = 0.0;
  for (auto _ : state) {
    found = models::place(problem, 8).variance;
    bound = models::placement_bound(problem, 8);
  }
  state.counters["sites"] = double(problem.sites());
  state.counters["error_above_bound"] = std::sqrt(found / bound) - 1.0;
  state.counters["variance_above_bound"] = found / bound - 1.0;
}
BENCHMARK_CAPTURE(PlacementBound, v450_fine, "v450_fine", Teacher::family)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(PlacementBound, v450_fine_trained, "v450_fine", Teacher::machine)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(PlacementBound, g200_fine, "g200_fine", Teacher::family)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(PlacementBound, g200_fine_trained, "g200_fine", Teacher::machine)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

/// The same of 12 random machines of 200 lumps.
void PlacementBoundOfRandomMachines(benchmark::State& state) {
  std::vector<double> above;
  for (auto _ : state)
    for (int const in_loop : {10, 20, 60})
      for (int seed = 0; seed < 4; ++seed) {
        RandomMachine const machine(std::uint64_t(seed), in_loop, 200 - in_loop);
        auto const problem = drawn_at_random(machine, 24, 0).problem();
        above.push_back(std::sqrt(models::place(problem, 8).variance / models::placement_bound(problem, 8)) - 1.0);
      }
  state.counters["error_above_bound_least"] = *std::min_element(above.begin(), above.end());
  state.counters["error_above_bound_largest"] = *std::max_element(above.begin(), above.end());
}
BENCHMARK(PlacementBoundOfRandomMachines)->Unit(benchmark::kMillisecond)->Iterations(1);

void count(benchmark::State& state, ErrorRatios const& ratios, std::string const& what = "") {
  state.counters[what + "of_qr_median"] = median(ratios.to_pivots);
  state.counters[what + "of_qr_below_0.8"] = share_below(ratios.to_pivots, 0.8);
  state.counters[what + "of_groups_median"] = median(ratios.to_groups);
  state.counters[what + "of_groups_below_0.6"] = share_below(ratios.to_groups, 0.6);
}

/// Error of 6 sensors on unseen members and spectra over that of the QR pivots' and of correlation groups'; and the
/// same of what sensors can remove: √(V − V of a sensor at every site).
void PlacementAgainstOthers(benchmark::State& state) {
  ErrorRatios whole, removable;
  for (auto _ : state)
    for (int seed = 0; seed < 100; ++seed) {
      auto const machines = drawn_at_random(RandomMachine(std::uint64_t(seed)), 24, 12);
      auto const problem = machines.problem();
      Sites every(machines.sites.size());
      std::iota(every.begin(), every.end(), Index(0));
      double const floor = models::remaining_variance(problem, every);
      auto const left = [&](Sites const& set) { return std::sqrt(models::remaining_variance(problem, set) - floor); };
      auto const ours = models::place(problem, 6).sensors;
      auto const pivots = chosen_by("qr_pivot", machines, 6), groups = chosen_by("correlation_grouping", machines, 6);
      whole.to_pivots.push_back(machines.unseen_error(ours) / machines.unseen_error(pivots));
      whole.to_groups.push_back(machines.unseen_error(ours) / machines.unseen_error(groups));
      removable.to_pivots.push_back(left(ours) / left(pivots));
      removable.to_groups.push_back(left(ours) / left(groups));
    }
  count(state, whole);
  count(state, removable, "removable_");
}
BENCHMARK(PlacementAgainstOthers)->Unit(benchmark::kMillisecond)->Iterations(1);

/// The same where each machine is taught by itself, one of its spectra, and judged by the other: the same estimator for
/// all sets. Once as the other methods see the whole ensemble, once with each machine's own mean taken off.
void PlacementTrainedAgainstOthers(benchmark::State& state) {
  ErrorRatios plain, centred;
  for (auto _ : state)
    for (int seed = 0; seed < 100; ++seed) {
      auto const machines = drawn_at_random(RandomMachine(std::uint64_t(seed)), 24, 12);
      plain.add_trained(machines);
      centred.add_trained(machines, true);
    }
  count(state, plain);
  count(state, centred, "centred_");
}
BENCHMARK(PlacementTrainedAgainstOthers)->Unit(benchmark::kMillisecond)->Iterations(1);

/// The same per unseen member of a shipped machine.
void PlacementAgainstOthersOn(benchmark::State& state, std::string const& name, Teacher teacher) {
  ErrorRatios ratios;
  for (auto _ : state) {
    auto const machines = drawn_as_shipped(name, 100, 100);
    auto const errors = [&](Sites const& set) {
      return machines.moments(teacher).unseen(machines.unseen, set).of_members;
    };
    auto const ours = errors(models::place(machines.problem(teacher), 6).sensors);
    auto const pivots = errors(chosen_by("qr_pivot", machines, 6)),
               groups = errors(chosen_by("correlation_grouping", machines, 6));
    for (Index m = 0; m < ours.size(); ++m) {
      ratios.to_pivots.push_back(std::sqrt(ours[m] / pivots[m]));
      ratios.to_groups.push_back(std::sqrt(ours[m] / groups[m]));
    }
  }
  count(state, ratios);
}
BENCHMARK_CAPTURE(PlacementAgainstOthersOn, v450, "v450", Teacher::family)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(PlacementAgainstOthersOn, v450_trained, "v450", Teacher::machine)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(PlacementAgainstOthersOn, vmc850, "vmc850", Teacher::family)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(PlacementAgainstOthersOn, vmc850_trained, "vmc850", Teacher::machine)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(PlacementAgainstOthersOn, g200, "g200", Teacher::family)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(PlacementAgainstOthersOn, g200_trained, "g200", Teacher::machine)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

/// Eight sensors of which the worst two are dead: model error over that of all eight, robust choice; three sensors
/// find room at each site.
void PlacementWithDeadSensors(benchmark::State& state) {
  std::vector<double> ratios, costs;
  for (auto _ : state)
    for (int seed = 0; seed < 100; ++seed) {
      auto const problem = drawn_at_random(RandomMachine(std::uint64_t(seed)), 12, 0, 2).problem();
      auto const robust = models::place(problem, 8, 2), plain = models::place(problem, 8);
      ratios.push_back(worst_over_intact(problem, robust));
      costs.push_back(std::sqrt(robust.variance / plain.variance));
    }
  state.counters["worst_over_intact_median"] = median(ratios);
  state.counters["worst_over_intact_largest"] = *std::max_element(ratios.begin(), ratios.end());
  state.counters["below_1.3"] = share_below(ratios, 1.3);
  state.counters["intact_over_optimum_median"] = median(costs);
}
BENCHMARK(PlacementWithDeadSensors)->Unit(benchmark::kMillisecond)->Iterations(1);

void PlacementWithDeadSensorsOn(benchmark::State& state, std::string const& name) {
  models::Placement robust;
  auto const problem = drawn_as_shipped(name, 100, 0, 2).problem();
  for (auto _ : state) robust = models::place(problem, 8, 2);
  state.counters["worst_over_intact"] = worst_over_intact(problem, robust);
  state.counters["intact_over_optimum"] = std::sqrt(robust.variance / models::place(problem, 8).variance);
}
BENCHMARK_CAPTURE(PlacementWithDeadSensorsOn, v450, "v450")->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(PlacementWithDeadSensorsOn, vmc850, "vmc850")->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(PlacementWithDeadSensorsOn, g200, "g200")->Unit(benchmark::kMillisecond)->Iterations(1);

/// Predicted over realised variance of the recommended six.
void PlacementPrediction(benchmark::State& state, std::string const& name, Teacher teacher) {
  double ratio = 0.0;
  for (auto _ : state) ratio = predicted_over_realised(drawn_as_shipped(name, 300, 300), teacher);
  state.counters["predicted_over_realised"] = ratio;
}
BENCHMARK_CAPTURE(PlacementPrediction, v450, "v450", Teacher::family)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(PlacementPrediction, v450_trained, "v450", Teacher::machine)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(PlacementPrediction, vmc850, "vmc850", Teacher::family)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(PlacementPrediction, vmc850_trained, "vmc850", Teacher::machine)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(PlacementPrediction, g200, "g200", Teacher::family)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(PlacementPrediction, g200_trained, "g200", Teacher::machine)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
}  // namespace thermotwin::twin
