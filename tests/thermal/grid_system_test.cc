#include "thermal/grid_system.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <omp.h>
#include <span>

#include "tests/thermal/function_course.h"
#include "tests/thermal/warm_film.h"
#include "thermal/block.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/integrate.h"
#include "thermal/laws.h"
#include "thermal/newton_system.h"
#include "thermal/site.h"

namespace thermotwin::thermal {
namespace {

/// Column on bed, a ring in the column, oil that carries heat between lumps: averages on both sides of the joints, one
/// of them strong, conductivities and heat capacities that depend on temperature, flat cells.
Network machine(std::array<int, 3> const& cells) {
  NetworkBuilder builder;
  int const part = builder.part("machine");
  Port const room = builder.add_boundary({"room", 293.15, {}});
  auto const add = [&](Body const& body) {
    add_to(builder, part, body);
    return body;
  };
  Body const bed = add(make_body("bed", Block{material("GJL-250"), {0, 0, 0}, {1.2, 0.8, 0.3}, cells}));
  Body const column = add(make_body("column", Block{material("GJL-250"), {0, 0, 0.3}, {0.4, 0.4, 1.0}, {8, 5, 30}}));
  Body const ring =
      add(make_body("ring", HollowCylinder{material("C45"), {0, 0, 1}, {0, 0, 1}, 0.1, 0.16, 0.1, 20, 4}));
  Port const oil = builder.add_body("oil", {800.0}), tank = builder.add_body("tank", {4000.0});
  for (auto const* body : {&bed, &column})
    for (auto const& name : {"x_min", "x_max", "y_min"})
      for (auto const& c : face(*body, name).contacts)
        builder.add<WarmFilm>(part, {port_of(builder, face(*body, name), c), room}, {6.0 * c.area});
  builder.connect(part, port_of(builder, face(bed, "z_max")), port_of(builder, face(column, "z_min")), 4000.0);
  builder.connect(part, port_of(builder, face(column, "x_max")), port_of(builder, face(ring, "outer")), 300.0);
  builder.add<SwitchedHeat>(part, {port_of(builder, face(ring, "inner"))}, {400.0}, {builder.channel("heat")});
  builder.connect(part, port_of(builder, face(ring, "inner")), oil, 50.0);
  builder.add<Advection>(part, {oil, tank}, {2000.0}, {builder.channel("flow")});
  builder.add<Advection>(part, {tank, oil}, {2000.0}, {builder.channel("flow")});
  builder.connect(part, tank, room, 20.0);
  return builder.build();
}

FunctionCourse course() {
  auto const values = [](double t, std::span<double> u) {
    u[0] = t < 2000.0 ? 1.0 : 0.3;
    u[1] = 0.05;
  };
  return {{"heat", "flow"}, values, {2000.0}};
}

std::vector<double> end_of_run(Network const& network, LinearSolver solver, double end_time,
                               double* imbalance = nullptr) {
  IntegrationOptions options;
  options.solver = solver;
  std::vector<double> const times{0.0, end_time}, start(std::size_t(network.nodes()), 293.15);
  std::vector<double> end;
  auto const summary = integrate(network, course(), start, times, options, [&](Sample const& sample) {
    end.assign(sample.temperatures.begin(), sample.temperatures.end());
  });
  if (imbalance) *imbalance = summary.energy_imbalance();
  return end;
}

TEST(GridSystem, AgreesWithADirectSolverOnAMachineOfJoinedBodies) {
  auto const network = machine({12, 8, 3});
  double imbalance = 1.0;
  auto const direct = end_of_run(network, LinearSolver::sparse_direct, 4000.0);
  auto const ours = end_of_run(network, LinearSolver::multigrid, 4000.0, &imbalance);
  for (std::size_t i = 0; i < direct.size(); ++i) ASSERT_NEAR(ours[i], direct[i], 5e-4) << i;
  EXPECT_LT(imbalance, 1e-11);
}

TEST(GridSystem, SolvesToAnyToleranceAlsoWithoutCapacity) {
  auto const network = machine({12, 8, 3});
  Evaluation evaluation(network);
  Eigen::VectorXd state = Eigen::VectorXd::Constant(network.nodes(), 300.0), b(network.nodes()), ours, exact;
  for (int i = 0; i < network.nodes(); ++i) {
    state[i] += 5.0 * std::sin(0.1 * i);
    b[i] = std::cos(1.7 * i);
  }
  std::vector<double> const input{1.0, 0.05};
  NewtonSystem system(network, LinearSolver::multigrid), direct(network, LinearSolver::sparse_direct);
  system.linearise(evaluation, state.data(), input.data());
  direct.linearise(evaluation, state.data(), input.data());
  for (double const gamma : {1.0, 100.0, 1e4}) {
    ASSERT_TRUE(system.factorise(gamma) && direct.factorise(gamma));
    ASSERT_TRUE(system.solve_nodes(b, 1e-11 * b.norm(), ours) && direct.solve_nodes(b, 0.0, exact));
    EXPECT_LT((ours - exact).norm(), 2e-5 * exact.norm()) << gamma;
  }
  ASSERT_TRUE(system.factorise_steady() && direct.factorise_steady());
  ASSERT_TRUE(system.solve_nodes(b, 1e-11 * b.norm(), ours) && direct.solve_nodes(b, 0.0, exact));
  EXPECT_LT((ours - exact).norm(), 1e-4 * exact.norm());
}

TEST(GridSystem, FindsTheSteadyState) {
  auto const network = machine({24, 16, 6});
  ASSERT_EQ(choose_solver(network), LinearSolver::multigrid);
  std::vector<double> const input{1.0, 0.05}, guess(std::size_t(network.nodes()), 293.15);
  auto const steady = steady_state(network, input, guess);
  Evaluation evaluation(network);
  std::vector<double> state, rate(steady.size());
  for (int i = 0; i < network.nodes(); ++i) state.push_back(network.state_of_temperature(i, steady[std::size_t(i)]));
  evaluation.rate(state.data(), input.data(), rate.data());
  for (std::size_t i = 0; i < rate.size(); ++i) ASSERT_NEAR(rate[i], 0.0, 1e-10);
}

TEST(GridSystem, SameBytesWhateverTheNumberOfThreads) {
  auto const network = machine({60, 50, 24});
  std::vector<std::vector<double>> ends;
  int const most = omp_get_max_threads();
  for (int const threads : {1, 3}) {
    omp_set_num_threads(threads);
    ends.push_back(end_of_run(network, LinearSolver::automatic, 10.0));
  }
  omp_set_num_threads(most);
  EXPECT_EQ(std::memcmp(ends[0].data(), ends[1].data(), ends[0].size() * sizeof(double)), 0);
}

}  // namespace
}  // namespace thermotwin::thermal
