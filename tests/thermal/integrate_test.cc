#include "thermal/integrate.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <span>
#include <string>

#include "tests/thermal/random_network.h"
#include "tests/thermal/verification.h"
#include "thermal/bar.h"
#include "thermal/block.h"
#include "thermal/error.h"
#include "thermal/laws.h"

namespace thermotwin::thermal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double capacity = 1000.0, conductance = 2.0, heat = 100.0, tau = capacity / conductance;

/// One node, heated while "on".
Network heated_lump() {
  NetworkBuilder builder;
  Port const body = builder.add_body("lump", {capacity});
  builder.connect(builder.part("film"), body, builder.add_boundary({"room", T0, {}}), conductance);
  builder.add<SwitchedHeat>(builder.part("heater"), {body}, {heat}, {builder.channel("on")});
  return builder.build();
}

FunctionCourse on_until(double end) {
  return {{"on"}, [end](double t, std::span<double> u) { u[0] = t < end ? 1.0 : 0.0; }, {end}};
}

TEST(Integrate, AJumpOfTheInputIsMetExactly) {
  double const end = 333.3;
  std::vector<double> const start{T0}, times{0.0, 333.3, 1000.0};
  auto const summary = integrate(heated_lump(), on_until(end), start, times, tight(1e-10), [&](Sample const& s) {
    double const at_end = heat / conductance * (1 - std::exp(-end / tau));
    double const exact =
        s.time <= end ? heat / conductance * (1 - std::exp(-s.time / tau)) : at_end * std::exp(-(s.time - end) / tau);
    EXPECT_NEAR(s.temperatures[0] - T0, exact, 1e-7);
    EXPECT_NEAR(s.energy.supplied, heat * std::min(s.time, end), 1e-6);
  });
  EXPECT_EQ(summary.restarts, 1);
}

/// Global error against tolerance: a line of slope 1 (physics.md §9; integrator's own promise).
/// A lump of 1 ks in air that is 5 K warmer for ten minutes, on straight lines, after it has stood for a day: a ramp r
/// from t₀ on raises it by r (s − τ(1 − e^{−s/τ})), s = t − t₀.
TEST(Integrate, SeesWhatComesAndGoesWithinAStepWhereTheInputBends) {
  NetworkBuilder builder;
  int const part = builder.part("p");
  Port const lump = builder.add_body("lump", {1000.0});
  Port const air = builder.add_boundary({"air", 293.15, {{builder.channel("warmer"), 1.0}}});
  builder.connect(part, lump, air, 1.0);
  Network const network = builder.build();
  std::vector<double> const bends = {86400.0, 86460.0, 87000.0, 87060.0};
  auto const ramps = [&](double t, auto const& of_ramp) {
    double sum = 0.0;
    for (std::size_t b = 0; b < bends.size(); ++b)
      if (t > bends[b]) sum += (b == 0 || b == 3 ? 5.0 : -5.0) / 60.0 * of_ramp(t - bends[b]);
    return sum;
  };
  FunctionCourse const course(
      {"warmer"}, [&](double t, std::span<double> values) { values[0] = ramps(t, [](double s) { return s; }); }, {},
      bends);
  std::vector<double> const times = {0.0, 86460.0, 87000.0, 87060.0, 90000.0};
  IntegrationOptions options;
  integrate(network, course, std::vector{293.15}, times, options, [&](Sample const& sample) {
    double const due = ramps(sample.time, [](double s) { return s - 1000.0 * (1.0 - std::exp(-s / 1000.0)); });
    EXPECT_NEAR(sample.temperatures[0] - 293.15, due, 100.0 * options.tolerance()) << sample.time;
  });
}

TEST(Integrate, ErrorFollowsTheTolerance) {
  NetworkBuilder builder;
  int const part = builder.part("bar");
  Body const bar = make_body("bar", Bar{verification_steel(), {0, 0, 0}, {1, 0, 0}, 0.2, 0.02, 0.0, {}, 10});
  Port const first = add_to(builder, part, bar);
  builder.connect(part, first, builder.add_boundary({"room", T0, {{builder.channel("swing"), 1.0}}}), 0.5);
  builder.add<SwitchedHeat>(part, {{Port::Kind::node, 9}}, {5.0}, {builder.channel("speed")});
  Network const network = builder.build();
  std::vector<double> const start(10, T0);
  std::vector<double> times;
  for (int i = 0; i <= 40; ++i) times.push_back(i * 75.0);
  auto const solve = [&](double tolerance) {
    std::vector<double> all;
    integrate(network, random_course(), start, times, tight(tolerance),
              [&](Sample const& s) { all.insert(all.end(), s.temperatures.begin(), s.temperatures.begin() + 10); });
    return all;
  };
  auto const reference = solve(1e-13);
  std::vector<double> x, y;
  for (double decade = -4.0; decade >= -9.0; decade -= 1.0) {
    auto const found = solve(std::pow(10.0, decade));
    double sum = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) sum += std::pow(found[i] - reference[i], 2);
    double const error = std::sqrt(sum / double(found.size()));
    EXPECT_LT(error, 100.0 * 10.0 * std::pow(10.0, decade)) << "at 1e" << decade;
    x.push_back(decade);
    y.push_back(std::log10(error));
  }
  double sxy = 0.0, sxx = 0.0;
  double const mean_x = -6.5;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxy += (x[i] - mean_x) * y[i];
    sxx += (x[i] - mean_x) * (x[i] - mean_x);
  }
  EXPECT_NEAR(sxy / sxx, 1.0, 0.2);
}

TEST(Integrate, WhereItIsObservedDoesNotChangeTheRun) {
  auto const end = [](std::vector<double> const& times) {
    double last = 0.0;
    std::vector<double> const start{T0};
    integrate(heated_lump(), on_until(500.0), start, times, {}, [&](Sample const& s) { last = s.temperatures[0]; });
    return last;
  };
  std::vector<double> dense;
  for (int i = 0; i <= 1000; ++i) dense.push_back(i);
  EXPECT_EQ(end({0.0, 1000.0}), end(dense));
}

TEST(Integrate, EnergyIsCountedInAllDirections) {
  NetworkBuilder builder;
  Port const body = builder.add_body("tank", {capacity});
  Port const warm = builder.add_boundary({"warm", T0 + 10.0, {}}), cold = builder.add_boundary({"cold", T0, {}});
  builder.connect(builder.part("warm film"), body, warm, 3.0);
  builder.connect(builder.part("cold film"), body, cold, 1.0);
  builder.add<SwitchedHeat>(builder.part("chiller"), {body}, {-20.0}, {builder.channel("on")});
  Network const network = builder.build();
  // Steady at 3 (10 − θ) − θ − 20 = 0: θ = 2.5; from the warm 22.5 W, into the cold 2.5 W, withdrawn 20 W.
  std::vector<double> const start{T0 + 2.5}, times{0.0, 1000.0};
  auto const summary = integrate(network, on_until(1e9), start, times, {}, [](auto&) {});
  EXPECT_NEAR(summary.energy.withdrawn, 20e3, 1e-5);
  EXPECT_NEAR(summary.energy.supplied, 0.0, 0.0);
  EXPECT_NEAR(summary.energy.lost, 2.5e3 - 22.5e3, 1e-5);
  EXPECT_NEAR(summary.energy.exchanged, 25e3, 1e-5);
  EXPECT_LT(summary.energy_imbalance(), 1e-12);
}

TEST(Integrate, HeatOfPartsNamesWhoGivesAndWhoTakes) {
  Network const network = heated_lump();
  Evaluation evaluation(network);
  std::vector<double> state{T0 + 10.0}, input{1.0}, watts(2);
  evaluation.heat_of_parts(state.data(), input.data(), watts);
  EXPECT_EQ(network.parts(), (std::vector<std::string>{"film", "heater"}));
  EXPECT_NEAR(watts[0], -20.0, 1e-10);
  EXPECT_NEAR(watts[1], 100.0, 1e-12);
}

TEST(Integrate, AMissingChannelIsNamedWithTheNearestOne) {
  FunctionCourse const course({"onn"}, [](double, std::span<double> u) { u[0] = 1.0; });
  std::vector<double> const start{T0}, times{0.0, 1.0};
  try {
    integrate(heated_lump(), course, start, times, {}, [](auto&) {});
    FAIL();
  } catch (InputError const& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("'on'"), HasSubstr("'onn'")));
  }
}

TEST(Integrate, RefusesStartsOfTheWrongLengthAndNoTimes) {
  std::vector<double> const two{T0, T0}, one{T0}, times{0.0, 1.0}, none;
  EXPECT_THROW(integrate(heated_lump(), on_until(1.0), two, times, {}, [](auto&) {}), InputError);
  EXPECT_THROW(integrate(heated_lump(), on_until(1.0), one, none, {}, [](auto&) {}), InputError);
}

TEST(Integrate, WhatTheObserverOrTheCourseThrowsComesOut) {
  struct Mine {};
  std::vector<double> const start{T0}, times{0.0, 1.0};
  EXPECT_THROW(integrate(heated_lump(), on_until(2.0), start, times, {}, [](auto&) { throw Mine{}; }), Mine);
  FunctionCourse const broken({"on"}, [](double t, std::span<double> u) {
    if (t > 0.5) throw Mine{};
    u[0] = 1.0;
  });
  EXPECT_THROW(integrate(heated_lump(), broken, start, times, {}, [](auto&) {}), Mine);
}

/// Heat that grows without bound: ends in an error that says where.
struct Runaway {
  static constexpr std::string_view name = "runaway";
  static constexpr int ports = 1, coefficients = 1, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    S const theta = T[0] - 293.15;
    q[0] = u[0] * (c[0] + theta * theta);
  }
};

TEST(Integrate, GivingUpNamesTheWorstNodeItsTemperatureAndTheInputs) {
  NetworkBuilder builder;
  Port const good = builder.add_body("bed", {1000.0}), bad = builder.add_body("front bearing", {100.0});
  Port const room = builder.add_boundary({"room", T0, {}});
  builder.connect(builder.part("film"), good, room, 1.0);
  builder.connect(builder.part("film"), bad, room, 1.0);
  builder.add<Runaway>(builder.part("friction"), {bad}, {100.0}, {builder.channel("spindle.speed")});
  FunctionCourse const course({"spindle.speed"}, [](double, std::span<double> u) { u[0] = 1.0; });
  std::vector<double> const start{T0, T0}, times{0.0, 1000.0};
  try {
    integrate(builder.build(), course, start, times, {}, [](auto&) {});
    FAIL();
  } catch (IntegrationError const& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("Worst nodes: front bearing at"), HasSubstr("°C"), HasSubstr("spindle.speed = 1")));
  }
}

/// Constant heat whose slope is not a number.
struct WithoutSlope {
  static constexpr std::string_view name = "without a slope";
  static constexpr int ports = 1, coefficients = 1, inputs = 0;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    using std::sqrt;
    q[0] = c[0] + sqrt(S(0.0 * T[0]));
  }
};

/// Steps whose first guess is good enough need no solver; others must not take its failure for a solution.
TEST(Integrate, WhatTheLinearSolverCannotSolveIsNoSolution) {
  double const exact = heat / conductance * (1.0 - std::exp(-1000.0 / tau));
  for (auto const solver : {LinearSolver::dense, LinearSolver::sparse_direct, LinearSolver::preconditioned_krylov,
                            LinearSolver::multigrid}) {
    NetworkBuilder builder;
    Port const body = builder.add_body("head", {capacity});
    builder.connect(builder.part("film"), body, builder.add_boundary({"room", T0, {}}), conductance);
    builder.add<WithoutSlope>(builder.part("heater"), {body}, {heat}, {});
    std::vector<double> const start{T0}, times{0.0, 1000.0};
    IntegrationOptions options;
    options.solver = solver;
    double rise = 0.0;
    try {
      integrate(builder.build(), FunctionCourse(), start, times, options,
                [&](Sample const& s) { rise = s.temperatures[0] - T0; });
      EXPECT_NEAR(rise, exact, 1e-2) << name_of(solver);
    } catch (IntegrationError const& error) {
      EXPECT_THAT(error.what(), HasSubstr("convergence test failed")) << name_of(solver);
    }
  }
}

TEST(Integrate, ARelayWithoutReasonStaysOffAndAnEnabledOneStartsOn) {
  NetworkBuilder builder;
  Port const body = builder.add_body("tank", {capacity});
  Port const set = builder.add_boundary({"set", T0, {}});
  builder.connect(builder.part("film"), body, set, 1e-6);
  int const enable = builder.channel("enable");
  int const state = builder.add_relay("chiller", body, set, 0.5, -0.5, 0.0, enable);
  builder.add<SwitchedHeat>(builder.part("chiller"), {body}, {-100.0}, {state});
  Network const network = builder.build();
  FunctionCourse const course({"enable"}, [](double t, std::span<double> u) { u[0] = t < 50.0 ? 0.0 : 1.0; }, {50.0});
  std::vector<double> const start{T0 + 5.0}, times{0.0, 49.0, 60.0, 200.0};
  std::vector<double> theta;
  integrate(network, course, start, times, {}, [&](Sample const& s) { theta.push_back(s.temperatures[0] - T0); });
  EXPECT_NEAR(theta[1], 5.0, 1e-3) << "not enabled";
  EXPECT_NEAR(theta[2], 4.0, 1e-3) << "10 s at 100 W";
  EXPECT_NEAR(theta[3], -0.5, 1e-3) << "stopped at the lower limit";
}

TEST(ChooseSolver, TakesDirectFactorsForRodsAndIterationsForBlocks) {
  auto const choice = [](Body const& body) {
    NetworkBuilder builder;
    int const part = builder.part("body");
    add_to(builder, part, body);
    builder.connect(part, {Port::Kind::node, 0}, builder.add_boundary({"room", T0, {}}), 1.0);
    return choose_solver(builder.build());
  };
  auto const rod = [](int cells) {
    return make_body("rod", Bar{verification_steel(), {0, 0, 0}, {1, 0, 0}, 1.0, 0.05, 0.0, {}, cells});
  };
  auto const block = [](int side) {
    return make_body("block", Block{verification_steel(), {0, 0, 0}, {1, 1, 1}, {side, side, side}});
  };
  EXPECT_EQ(choice(rod(8)), LinearSolver::dense);
  EXPECT_EQ(choice(rod(100)), LinearSolver::sparse_direct);
  EXPECT_EQ(choice(rod(10000)), LinearSolver::sparse_direct);
  EXPECT_EQ(choice(block(4)), LinearSolver::sparse_direct);
  EXPECT_EQ(choice(block(10)), LinearSolver::preconditioned_krylov);
}

TEST(Integrate, AHeatSourceOverAWholeBlockKeepsTheSystemSparse) {
  NetworkBuilder builder;
  int const part = builder.part("block");
  Body const body = make_body("block", Block{verification_steel(), {0, 0, 0}, {1, 1, 1}, {16, 16, 16}});
  add_to(builder, part, body);
  add_film(builder, part, face(body, "z_min"), builder.add_boundary({"room", T0, {}}), 10.0);
  Port const all = port_of(builder, whole(body));
  builder.add<RandomFriction>(part, {all, all}, {500.0, 0.01, 0.5}, {builder.channel("speed")});
  Network const network = builder.build();
  EXPECT_LT(network.port_pattern().nonZeros(), 10 * network.nodes());
  std::vector<double> const start(std::size_t(network.nodes()), T0), times{0.0, 3600.0};
  auto const summary = integrate(network, random_course(), start, times, {}, [](auto&) {});
  EXPECT_LT(summary.energy_imbalance(), 1e-9);
  EXPECT_GT(summary.energy.supplied, 1e5);
}

}  // namespace
}  // namespace thermotwin::thermal
