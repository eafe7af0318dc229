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
#include "models/selection.h"
#include "tests/twin/random_machine.h"
#include "twin/machine.h"
#include "twin/placement/ensemble.h"
#include "twin/placement/snapshot_moments.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Sites = std::vector<Index>;

constexpr double noise = 0.1;  // [K]

/// A machine with its sites and two ensembles that share no member and no spectrum.
struct World {
  Value document;
  std::vector<CandidateSite> sites;
  Ensemble design, unseen;

  World(Value given, CandidateRules const& rules, int members, int others, int spares = 0)
      : document(std::move(given)), sites(with_spares(candidate_sites(document, rules), spares)) {
    EnsembleOptions options;
    options.members = members;
    design = draw_ensemble(document, sites, options);
    if (others == 0) return;
    options.members = others;
    options.first_member = 1'000'000;
    unseen = draw_ensemble(document, sites, options);
  }
  [[nodiscard]] SnapshotMoments moments(Teacher teacher = Teacher::family) const { return {design, noise, teacher}; }
  [[nodiscard]] models::PlacementProblem problem(Teacher teacher = Teacher::family) const {
    return moments(teacher).problem(Index(sites.size()));
  }
};

World random_world(std::uint64_t seed, int members, int others, int spares = 0) {
  RandomMachine const machine(seed);
  CandidateRules rules;
  for (auto const& body : machine.bodies()) rules.sites.push_back({body, {body}});
  return {parse_toml(machine.text(), "random"), rules, members, others, spares};
}

World shipped_world(std::string const& name, int members, int others, int spares = 0) {
  CandidateRules rules;
  if (name.starts_with("v450")) rules.forbidden = {"rotor"};
  return {read_toml(machine_file(name)), rules, members, others, spares};
}

/// What another method chooses, of the displacement with the largest variance; `centred`: given every machine's
/// departures from its own mean, so that what machines differ by does not mislead it.
Sites chosen_by(std::string const& method, World const& world, int count, bool centred = false) {
  Eigen::MatrixXd rise = world.design.rise, displacement = world.design.displacement;
  auto const groups = world.moments(centred ? Teacher::machine : Teacher::family).groups();
  for (auto const& [first, rows] : groups) {
    rise.middleRows(first, rows).rowwise() -= rise.middleRows(first, rows).colwise().mean().eval();
    displacement.middleRows(first, rows).rowwise() -= displacement.middleRows(first, rows).colwise().mean().eval();
  }
  models::Batch batch;
  batch.name = "ensemble";
  batch.time = Eigen::VectorXd::LinSpaced(rise.rows(), 0.0, double(rise.rows() - 1));
  Index largest = 0;
  displacement.colwise().squaredNorm().maxCoeff(&largest);
  batch.temperature_rise = std::move(rise);
  batch.error = displacement.col(largest);
  for (auto const& site : world.sites) {
    batch.sensors.push_back(site.name);
    batch.components.emplace_back("machine");
  }
  models::SelectionOptions options;
  options.count = count;
  return models::selection_method(method).select({&batch, 1}, options).sensors;
}

double unseen_error(World const& world, Sites const& set, Teacher teacher = Teacher::family) {
  return std::sqrt(world.moments(teacher).unseen(world.unseen, set).mean_square.sum());
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double share_below(std::vector<double> const& values, double limit) {
  return double(std::count_if(values.begin(), values.end(), [&](double x) { return x <= limit; })) /
         double(values.size());
}

/// Optimum over found, of the variance; 200 machines, 1 to 6 of 24 sensors.
void PlacementAgainstExhaustive(benchmark::State& state) {
  std::vector<double> shares;
  for (auto _ : state)
    for (int seed = 0; seed < 200; ++seed) {
      state.PauseTiming();
      auto const problem = random_world(std::uint64_t(seed), 6, 0).problem();
      state.ResumeTiming();
      for (Index count = 1; count <= 6; ++count)
        shares.push_back(models::exhaustive_placement(problem, count).variance /
                         models::place(problem, count).variance);
    }
  state.counters["least"] = *std::min_element(shares.begin(), shares.end());
  state.counters["exact"] = 1.0 - share_below(shares, 1.0 - 1e-9);
}
BENCHMARK(PlacementAgainstExhaustive)->Unit(benchmark::kMillisecond)->Iterations(1);

/// 8 of 200 sites: the bound as a share of the error and of its square.
void PlacementBound(benchmark::State& state, std::string const& name, Teacher teacher) {
  auto const problem = shipped_world(name, 24, 0).problem(teacher);
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

struct Ratios {
  std::vector<double> to_pivots, to_groups;
  void count(benchmark::State& state, std::string const& what) const {
    state.counters[what + "of_qr_median"] = median(to_pivots);
    state.counters[what + "of_qr_below_0.8"] = share_below(to_pivots, 0.8);
    state.counters[what + "of_groups_median"] = median(to_groups);
    state.counters[what + "of_groups_below_0.6"] = share_below(to_groups, 0.6);
  }
};

/// Error of 6 sensors on unseen members and spectra over that of the QR pivots' and of correlation groups'; and the
/// same of what sensors can remove: √(V − V of a sensor at every site).
void PlacementAgainstOthers(benchmark::State& state) {
  Ratios whole, removable;
  for (auto _ : state)
    for (int seed = 0; seed < 100; ++seed) {
      auto const world = random_world(std::uint64_t(seed), 24, 12);
      auto const problem = world.problem();
      Sites every(world.sites.size());
      std::iota(every.begin(), every.end(), Index(0));
      double const floor = models::remaining_variance(problem, every);
      auto const left = [&](Sites const& set) { return std::sqrt(models::remaining_variance(problem, set) - floor); };
      auto const ours = models::place(problem, 6).sensors;
      auto const pivots = chosen_by("qr_pivot", world, 6), groups = chosen_by("correlation_grouping", world, 6);
      whole.to_pivots.push_back(unseen_error(world, ours) / unseen_error(world, pivots));
      whole.to_groups.push_back(unseen_error(world, ours) / unseen_error(world, groups));
      removable.to_pivots.push_back(left(ours) / left(pivots));
      removable.to_groups.push_back(left(ours) / left(groups));
    }
  whole.count(state, "");
  removable.count(state, "removable_");
}
BENCHMARK(PlacementAgainstOthers)->Unit(benchmark::kMillisecond)->Iterations(1);

/// The same where each machine is taught by itself, one of its spectra, and judged by the other: the same estimator for
/// all sets. Once as the other methods see the whole ensemble, once with each machine's own mean taken off.
void PlacementTrainedAgainstOthers(benchmark::State& state) {
  Ratios plain, centred;
  for (auto _ : state)
    for (int seed = 0; seed < 100; ++seed) {
      auto const world = random_world(std::uint64_t(seed), 24, 12);
      auto const error = [&](Sites const& set) { return unseen_error(world, set, Teacher::machine); };
      double const ours = error(models::place(world.problem(Teacher::machine), 6).sensors);
      plain.to_pivots.push_back(ours / error(chosen_by("qr_pivot", world, 6)));
      plain.to_groups.push_back(ours / error(chosen_by("correlation_grouping", world, 6)));
      centred.to_pivots.push_back(ours / error(chosen_by("qr_pivot", world, 6, true)));
      centred.to_groups.push_back(ours / error(chosen_by("correlation_grouping", world, 6, true)));
    }
  plain.count(state, "");
  centred.count(state, "centred_");
}
BENCHMARK(PlacementTrainedAgainstOthers)->Unit(benchmark::kMillisecond)->Iterations(1);

/// The same per unseen member of a shipped machine.
void PlacementAgainstOthersOn(benchmark::State& state, std::string const& name, Teacher teacher) {
  Ratios ratios;
  for (auto _ : state) {
    auto const world = shipped_world(name, 100, 100);
    auto const errors = [&](Sites const& set) { return world.moments(teacher).unseen(world.unseen, set).of_members; };
    auto const ours = errors(models::place(world.problem(teacher), 6).sensors);
    auto const pivots = errors(chosen_by("qr_pivot", world, 6)),
               groups = errors(chosen_by("correlation_grouping", world, 6));
    for (Index m = 0; m < ours.size(); ++m) {
      ratios.to_pivots.push_back(std::sqrt(ours[m] / pivots[m]));
      ratios.to_groups.push_back(std::sqrt(ours[m] / groups[m]));
    }
  }
  ratios.count(state, "");
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

double worst_over_intact(models::PlacementProblem const& problem, models::Placement const& placement) {
  return std::sqrt(models::worst_variance(problem, placement.sensors, 2) / placement.variance);
}

/// Eight sensors of which the worst two are dead: model error over that of all eight, robust choice; three sensors
/// find room at each site.
void PlacementWithDeadSensors(benchmark::State& state) {
  std::vector<double> ratios, costs;
  for (auto _ : state)
    for (int seed = 0; seed < 100; ++seed) {
      auto const problem = random_world(std::uint64_t(seed), 12, 0, 2).problem();
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
  auto const problem = shipped_world(name, 100, 0, 2).problem();
  for (auto _ : state) robust = models::place(problem, 8, 2);
  state.counters["worst_over_intact"] = worst_over_intact(problem, robust);
  state.counters["intact_over_optimum"] = std::sqrt(robust.variance / models::place(problem, 8).variance);
}
BENCHMARK_CAPTURE(PlacementWithDeadSensorsOn, v450, "v450")->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(PlacementWithDeadSensorsOn, vmc850, "vmc850")->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(PlacementWithDeadSensorsOn, g200, "g200")->Unit(benchmark::kMillisecond)->Iterations(1);

/// Predicted over realised variance of the recommended six.
void PlacementPrediction(benchmark::State& state, std::string const& name, Teacher teacher) {
  double predicted = 0.0, realised = 0.0;
  for (auto _ : state) {
    auto const world = shipped_world(name, 300, 300);
    auto const set = models::place(world.problem(teacher), 6).sensors;
    predicted = world.moments(teacher).cross_validated(set).mean_square.sum();
    realised = world.moments(teacher).unseen(world.unseen, set).mean_square.sum();
  }
  state.counters["predicted_over_realised"] = predicted / realised;
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
