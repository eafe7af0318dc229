// Which linear solver for which network: the figures behind choose_solver (thermal/newton_system.cc).
//
//   thermotwin_bench --benchmark_filter=linear_solver
//
// Four hours with a jump of the heat every half hour, rtol 1e-6, films that depend on temperature.
#include <benchmark/benchmark.h>
#include <cmath>
#include <string>

#include "tests/thermal/warm_film.h"
#include "thermal/bar.h"
#include "thermal/block.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/integrate.h"
#include "thermal/laws.h"
#include "thermal/site.h"

namespace thermotwin::thermal {
namespace {

/// "run" jumps between 1 and 0.4 every half hour.
class HalfHours final : public Course {
 public:
  std::vector<InputChannel> const& channels() const override { return channels_; }
  void evaluate(double t, std::span<double> values) const override { values[0] = int(t / 1800.0) % 2 == 0 ? 1.0 : 0.4; }
  double next_jump(double t) const override { return (std::floor(t / 1800.0) + 1.0) * 1800.0; }

 private:
  std::vector<InputChannel> channels_{{"run", "1", "heat on"}};
};

Network network_of(Body const& body, std::vector<std::string> const& cooled, Site const& heated, double watts) {
  NetworkBuilder builder;
  int const part = builder.part("body");
  add_to(builder, part, body);
  Port const room = builder.add_boundary({"room", 293.15, {}});
  for (auto const& name : cooled)
    for (auto const& c : face(body, name).contacts)
      builder.add<WarmFilm>(part, {{Port::Kind::node, c.node}, room}, {6.0 * c.area});
  for (auto const& c : heated.contacts)
    builder.add<SwitchedHeat>(part, {{Port::Kind::node, c.node}}, {watts * c.share}, {builder.channel("run")});
  return builder.build();
}

Network rod(int cells) {
  Body const body = make_body("rod", Bar{material("C45"), {0, 0, 0}, {1, 0, 0}, 0.8, 0.04, 0.0, {}, cells});
  return network_of(body, {"surface"}, face(body, "start"), 40.0);
}

Network cylinder(int cells) {
  int const radial = std::max(2, int(std::sqrt(cells / 4.0)));
  Body const body = make_body(
      "cylinder", HollowCylinder{material("C45"), {0, 0, 0}, {0, 0, 1}, 0.4, 0.16, 0.06, cells / radial, radial});
  return network_of(body, {"outer", "start", "end"}, face(body, "inner", 0.0, 0.1), 100.0);
}

Network block(int cells) {
  int const side = int(std::lround(std::cbrt(cells)));
  Body const body = make_body("block", Block{material("GJL-250"), {0, 0, 0}, {0.6, 0.6, 0.6}, {side, side, side}});
  Eigen::AlignedBox3d const patch(Eigen::Vector3d(0.1, 0.1, 0.0), Eigen::Vector3d(0.25, 0.25, 1.0));
  return network_of(body, {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"}, face(body, "z_max", patch), 300.0);
}

void linear_solver(benchmark::State& state, Network (*make)(int)) {
  Network const network = make(int(state.range(0)));
  IntegrationOptions options;
  options.solver = LinearSolver(state.range(1));
  std::vector<double> const start(std::size_t(network.nodes()), 293.15);
  std::vector<double> times;
  for (int i = 0; i <= 240; ++i) times.push_back(60.0 * i);
  IntegrationSummary summary;
  for (auto _ : state) summary = integrate(network, HalfHours(), start, times, options, [](Sample const&) {});
  state.SetLabel(std::string(name_of(summary.solver)));
  state.counters["nodes"] = network.nodes();
  state.counters["steps"] = double(summary.steps);
  state.counters["imbalance"] = summary.energy_imbalance();
}

void sizes(benchmark::internal::Benchmark* benchmark, std::vector<int> const& cells, int dense_up_to,
           int direct_up_to) {
  benchmark->Unit(benchmark::kMillisecond);
  for (int n : cells) {
    if (n <= dense_up_to) benchmark->Args({n, int(LinearSolver::dense)});
    if (n <= direct_up_to) benchmark->Args({n, int(LinearSolver::sparse_direct)});
    benchmark->Args({n, int(LinearSolver::preconditioned_krylov)});
    benchmark->Args({n, int(LinearSolver::automatic)});
  }
}

BENCHMARK_CAPTURE(linear_solver, rod, rod)->Apply([](auto* b) { sizes(b, {10, 30, 100, 1000, 10000}, 100, 10000); });
BENCHMARK_CAPTURE(linear_solver, cylinder, cylinder)->Apply([](auto* b) {
  sizes(b, {30, 100, 400, 1600, 6400}, 100, 6400);
});
BENCHMARK_CAPTURE(linear_solver, block, block)->Apply([](auto* b) {
  sizes(b, {8, 64, 216, 1000, 2744, 9261}, 216, 2744);
});

}  // namespace
}  // namespace thermotwin::thermal
