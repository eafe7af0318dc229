#include <complex>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/refusal.h"
#include "tests/thermal/random_network.h"
#include "tests/thermal/verification.h"
#include "thermal/bar.h"
#include "thermal/lump.h"

namespace thermotwin::thermal {
namespace {

using thermotwin::tests::refusal;

// --- V13: V3 against its closed form
// ----------------------------------------------------------------------------------

Network cube(double h) {
  double const side = 0.02;
  NetworkBuilder builder;
  Body const body =
      make_body("cube", Lump{verification_steel(), {}, {}, 6 * side * side, {0, 0, 0}, {side, side, side}});
  add_to(builder, builder.part("cube"), body);
  add_film(builder, builder.part("film"), face(body, "surface"), builder.add_boundary({"air", T0, {}}), h);
  return builder.build();
}

TEST(VerificationV13, LumpToItsFilm) {
  double const h = 20.0, step = 1e-3, per_h = 6 * 4e-4 / (7850.0 * 470.0 * 8e-6);
  IntegrationOptions options = tight(1e-10);
  options.parameters = {difference(cube(h + step), cube(h - step), step)};
  options.parameters[0].scale = h;
  std::vector<double> const start{T0 + 10.0}, times{0.0, 100.0, 614.917, 1500.0, 3000.0};
  integrate(cube(h), FunctionCourse(), start, times, options, [&](Sample const& s) {
    double const theta = 10.0 * std::exp(-h * per_h * s.time);
    EXPECT_NEAR((*s.sensitivities)(0, 0), -theta * s.time * per_h, 1e-5 * 10.0 / h) << s.time;
  });
}

TEST(VerificationV13, LumpToItsStart) {
  IntegrationOptions options = tight(1e-10);
  options.parameters = {difference(cube(20.0), cube(20.0), 1.0)};
  options.parameters[0].initial_temperature = {1.0};
  std::vector<double> const start{T0 + 10.0}, times{0.0, 300.0, 1500.0};
  double const rate = 20.0 * 6 * 4e-4 / (7850.0 * 470.0 * 8e-6);
  integrate(cube(20.0), FunctionCourse(), start, times, options,
            [&](Sample const& s) { EXPECT_NEAR((*s.sensitivities)(0, 0), std::exp(-rate * s.time), 1e-6) << s.time; });
}

// --- V13: the fin of V2 against a complex step
// ------------------------------------------------------------------------

constexpr int fin_cells = 40;

Network fin(double h) {
  NetworkBuilder builder;
  int const part = builder.part("fin");
  Body const body = make_body(
      "fin", Bar{verification_steel(), {0, 0, 0}, {1, 0, 0}, 0.2, 0.04 / 3.14159265358979, 0.0, 1e-4, fin_cells});
  add_to(builder, part, body);
  Port const air = builder.add_boundary({"air", T0, {}});
  hold(builder, part, face(body, "start"), builder.add_boundary({"base", T0 + 20.0, {}}));
  add_film(builder, part, face(body, "surface"), air, h);
  return builder.build();
}

/// Discrete fin at rest, by elimination of its tridiagonal system in any field of numbers: θ of the last cell.
template <class Number>
Number discrete_tip(Number h) {
  double const step = 0.2 / fin_cells, G = 50.0 * 1e-4 / step;
  Number const film = h * 0.04 * step;
  Number upper[fin_cells], right[fin_cells];
  Number diagonal = 3.0 * G + film;  // half a cell to the base
  upper[0] = -G / diagonal;
  right[0] = 2.0 * G * 20.0 / diagonal;
  for (int i = 1; i < fin_cells; ++i) {
    diagonal = (i + 1 < fin_cells ? 2.0 * G : G) + film + G * upper[i - 1];
    upper[i] = -G / diagonal;
    right[i] = (G * right[i - 1]) / diagonal;
  }
  return right[fin_cells - 1];
}

TEST(VerificationV13, FinToItsFilmByAComplexStep) {
  double const h = 25.0, tiny = 1e-30, step = 1e-3;
  double const exact = discrete_tip(std::complex<double>(h, tiny)).imag() / tiny;
  IntegrationOptions options = tight(1e-9);
  options.parameters = {difference(fin(h + step), fin(h - step), step)};
  options.parameters[0].scale = h;
  std::vector<double> const start(fin_cells, T0), times{0.0, 30000.0};
  integrate(fin(h), FunctionCourse(), start, times, options, [&](Sample const& s) {
    if (s.time == 0.0) return;
    EXPECT_NEAR(s.temperatures[fin_cells - 1] - T0, discrete_tip(h), 1e-6);
    EXPECT_NEAR((*s.sensitivities)(fin_cells - 1, 0), exact, 1e-5 * std::abs(exact));
  });
  double const m = std::sqrt(200.0), slope = -20.0 * std::tanh(m * 0.2) / std::cosh(m * 0.2) * 0.2 * m / (2 * h);
  EXPECT_NEAR(exact, slope, 2e-3 * std::abs(slope)) << "the continuous fin";
}

// --- nonlinear networks against central differences
// -------------------------------------------------------------------

/// Nonlinear, with averages, temperature-dependent capacities and a changed start; θ scales conductances, capacities,
/// their slopes, one average's weights, a boundary and the start.
struct Nonlinear {
  Network network;
  std::vector<double> start;
};

Nonlinear nonlinear(double theta) {
  NetworkBuilder builder;
  int const part = builder.part("network");
  Port const bar = builder.add_body("bar", {300.0 * theta, 200.0, 500.0, 400.0}, 1e-3 * theta);
  Port const ring = builder.add_body("ring", {150.0}, 5e-4);
  auto const node = [&](int i) { return Port{Port::Kind::node, bar.index + i}; };
  Port const room = builder.add_boundary({"room", T0 - 5.0 + 2.0 * theta, {{builder.channel("swing"), 0.5 * theta}}});
  for (int i = 1; i < 4; ++i)
    builder.add<TemperatureDependentConductance>(part, {node(i - 1), node(i)}, {2.0 * theta, -2e-3 * theta});
  builder.add<RandomFilm>(part, {node(0), room}, {0.4 * theta});
  builder.add<RandomRadiation>(part, {node(3), room}, {1e-8});
  double const w = 0.3 * theta;
  Average fixed, moving;
  fixed.name = "mean";
  fixed.nodes = {bar.index, bar.index + 1, bar.index + 2};
  fixed.weights = {w, 0.5, 0.5 - w};
  Port const mean = builder.add_average(fixed);
  moving.name = "moving";
  moving.nodes = {bar.index, bar.index + 1, bar.index + 2, bar.index + 3};
  moving.from_channel = moving.to_channel = builder.channel("position");
  moving.window = 0.3;
  moving.edges = {0.0, 0.25, 0.5, 0.75, 1.0};
  Port const under = builder.add_average(moving);
  builder.add<RandomFilm>(part, {mean, ring}, {1.5});
  builder.connect(part, under, ring, 0.7 * theta);
  builder.add<RandomFriction>(builder.part("friction"), {ring, mean}, {40.0 * theta, 0.01 * theta, 0.6},
                              {builder.channel("speed")});
  return {builder.build(), {T0 + 15.0 * theta, T0 + 10.0, T0 + 5.0, T0, T0 + 8.0}};
}

TEST(VerificationV13, NonlinearNetworkAgainstCentralDifferences) {
  double const step = 1e-4;
  auto const plus = nonlinear(1.0 + step), minus = nonlinear(1.0 - step), here = nonlinear(1.0);
  std::vector<double> const times{0.0, 50.0, 400.0, 900.0, 2000.0};
  auto const end_of = [&](Nonlinear const& n) {
    std::vector<std::vector<double>> history;
    integrate(n.network, random_course(), n.start, times, tight(1e-11), [&](Sample const& s) {
      history.emplace_back(s.temperatures.begin(), s.temperatures.begin() + n.network.nodes());
    });
    return history;
  };
  auto const high = end_of(plus), low = end_of(minus);
  for (auto solver : {LinearSolver::dense, LinearSolver::sparse_direct, LinearSolver::preconditioned_krylov}) {
    IntegrationOptions options = tight(1e-9);
    options.solver = solver;
    options.parameters = {difference(plus.network, minus.network, step)};
    for (std::size_t i = 0; i < here.start.size(); ++i)
      options.parameters[0].initial_temperature.push_back((plus.start[i] - minus.start[i]) / (2 * step));
    std::size_t k = 0;
    integrate(here.network, random_course(), here.start, times, options, [&](Sample const& s) {
      for (std::size_t i = 0; i < here.start.size(); ++i) {
        double const expected = (high[k][i] - low[k][i]) / (2 * step);
        EXPECT_NEAR((*s.sensitivities)(Eigen::Index(i), 0), expected, 1e-4 * std::max(1.0, std::abs(expected)))
            << name_of(solver) << " t " << s.time << " node " << i;
      }
      ++k;
    });
  }
}

/// At every output, however many lie within one step or one part of it. In a film without flow, while the temperatures
/// on its sides cross, S depends so steeply on them that their own errors count many times.
TEST(VerificationV13, RandomNetworksFollowTheTolerance) {
  double const step = 1e-4;
  int close = 0, steep = 0;
  std::vector<double> times;
  for (double t = 0.0; t <= 2000.0; t += 4.0) times.push_back(t);
  for (unsigned seed = 0; seed < 40; ++seed) {
    auto const plus = random_network(seed, {.scale = 1.0 + step}), minus = random_network(seed, {.scale = 1.0 - step});
    auto const here = random_network(seed);
    auto const at = [&](double tolerance) {
      Eigen::MatrixXd courses(here.network.nodes(), Eigen::Index(times.size()));
      Eigen::Index column = 0;
      IntegrationOptions options = tight(tolerance);
      options.parameters = {difference(plus.network, minus.network, step)};
      integrate(here.network, random_course(), here.start, times, options,
                [&](Sample const& s) { courses.col(column++) = s.sensitivities->col(0); });
      return courses;
    };
    auto const exact = at(1e-12);
    auto const error_at = [&](double tolerance) {
      return ((at(tolerance) - exact).array() / exact.array().abs().max(1.0)).abs().maxCoeff();
    };
    for (double const tolerance : {1e-7, 1e-9}) {
      double const errors = error_at(tolerance) / tight(tolerance).tolerance();
      EXPECT_LT(errors, 2000.0) << "seed " << seed;
      (errors < 100.0 ? close : steep) += 1;
    }
  }
  EXPECT_GT(close, 4 * steep);
}

TEST(VerificationV13, RandomNetworksAgainstCentralDifferences) {
  double const step = 1e-3;  // wide: a difference divides the error of the runs by it
  for (unsigned seed = 0; seed < 40; ++seed) {
    auto const plus = random_network(seed, {.scale = 1.0 + step}), minus = random_network(seed, {.scale = 1.0 - step});
    auto const here = random_network(seed);
    std::vector<double> const times{0.0, 800.0, 2000.0};
    auto const end_of = [&](RandomNetwork const& n) {
      std::vector<double> end;
      integrate(n.network, random_course(), n.start, times, tight(1e-12), [&](Sample const& s) {
        end.assign(s.temperatures.begin(), s.temperatures.begin() + n.network.nodes());
      });
      return end;
    };
    auto const high = end_of(plus), low = end_of(minus);
    IntegrationOptions options = tight(1e-8);
    options.parameters = {difference(plus.network, minus.network, step)};
    integrate(here.network, random_course(), here.start, times, options, [&](Sample const& s) {
      if (s.time < 2000.0) return;
      for (std::size_t i = 0; i < high.size(); ++i) {
        double const expected = (high[i] - low[i]) / (2 * step);
        ASSERT_NEAR((*s.sensitivities)(Eigen::Index(i), 0), expected, 1e-4 * std::max(1.0, std::abs(expected)))
            << "seed " << seed;
      }
    });
  }
}

TEST(Difference, RefusesWhatItCannotCarry) {
  auto const with = [](double window, double low, int links) {
    NetworkBuilder builder;
    Port const bar = builder.add_body("screw", {10.0, 10.0});
    Port const room = builder.add_boundary({"room", T0, {}});
    Average nut;
    nut.name = "nut";
    nut.nodes = {bar.index, bar.index + 1};
    nut.edges = {0.0, 0.5, 1.0};
    nut.window = window;
    nut.from_channel = nut.to_channel = builder.channel("position");
    for (int i = 0; i < links; ++i) builder.connect(builder.part("film"), builder.add_average(nut), room, 1.0);
    builder.add_relay("chiller", bar, room, 1.0, low);
    return builder.build();
  };
  EXPECT_NO_THROW((void)difference(with(0.2, -1.0, 1), with(0.2, -1.0, 1), 1e-3));
  auto const message = [&](Network const& other) {
    return refusal([&] { (void)difference(with(0.2, -1.0, 1), other, 1e-3); });
  };
  EXPECT_THAT(message(with(0.3, -1.0, 1)), testing::HasSubstr("where 'nut' is"));
  EXPECT_THAT(message(with(0.2, -1.1, 1)), testing::HasSubstr("when 'chiller' switches"));
  EXPECT_THAT(message(with(0.2, -1.0, 2)), testing::HasSubstr("structure"));
}

}  // namespace
}  // namespace thermotwin::thermal
