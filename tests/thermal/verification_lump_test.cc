#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <span>

#include "tests/thermal/verification.h"
#include "thermal/laws.h"
#include "thermal/lump.h"

namespace thermotwin::thermal {
namespace {

using std::numbers::pi;

// --- V3: cube of 20 mm in air
// -----------------------------------------------------------------------------------------

TEST(VerificationV3, LumpedExponential) {
  double const side = 0.02, h = 20.0;
  NetworkBuilder builder;
  int const part = builder.part("cube");
  Body const cube =
      make_body("cube", Lump{verification_steel(), {}, {}, 6 * side * side, {0, 0, 0}, {side, side, side}});
  add_to(builder, part, cube);
  add_film(builder, part, face(cube, "surface"), builder.add_boundary({"air", T0, {}}), h);
  double const tau = 7850.0 * 470.0 * side / (6 * h);
  EXPECT_NEAR(tau, 614.917, 5e-4);
  auto const history = run(builder.build(), FunctionCourse(), T0 + 10.0, {0.0, 300.0, 1500.0, 6000.0}, tight());
  EXPECT_NEAR(history[1][0] - T0, 10.0 * std::exp(-300.0 / tau), 1e-6);
  EXPECT_NEAR(history[2][0] - T0, 0.87217, 5e-6);
  EXPECT_NEAR(history[3][0] - T0, 10.0 * std::exp(-6000.0 / tau), 1e-6);
}

// --- V3b: the room's daily cycle
// --------------------------------------------------------------------------------------

TEST(VerificationV3b, DailyCycleIsDampedAndDelayed) {
  double const omega = 2 * pi / 86400.0, amplitude = 2.0;
  struct Case {
    double hours, gain, lag;
  };
  for (auto const& [hours, gain, lag] : {Case{0.5, 0.99, 0.5}, {2, 0.89, 1.8}, {6, 0.54, 3.8}, {12, 0.30, 4.8}}) {
    double const tau = hours * 3600.0, phase = std::atan(omega * tau), damped = std::cos(phase);
    EXPECT_NEAR(damped, gain, 0.01);
    EXPECT_NEAR(phase / omega / 3600.0, lag, 0.05);
    NetworkBuilder builder;
    Port const body = builder.add_body("bed", {1e5});
    builder.connect(builder.part("film"), body, builder.add_boundary({"room", T0, {{builder.channel("room"), 1.0}}}),
                    1e5 / tau);
    FunctionCourse const course({"room"},
                                [&](double t, std::span<double> u) { u[0] = amplitude * std::cos(omega * t); });
    std::vector<double> times;
    for (int i = 0; i <= 48; ++i) times.push_back(i * 1800.0);
    auto const history = run(builder.build(), course, T0 + amplitude * damped * damped, times, tight(1e-8));
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_NEAR(history[i][0] - T0, amplitude * damped * std::cos(omega * times[i] - phase), 1e-5);
  }
}

// --- V9: two nodes, constant heat
// -------------------------------------------------------------------------------------

TEST(VerificationV9, TwoNodesFollowTheirEigenvaluesAndKeepTheirEnergy) {
  double const C1 = 5000.0, C2 = 20000.0, G12 = 15.0, G1 = 1.0, G2 = 6.0, q = 120.0;
  NetworkBuilder builder;
  int const part = builder.part("network");
  Port const a = builder.add_body("a", {C1}), b = builder.add_body("b", {C2});
  Port const room = builder.add_boundary({"room", T0, {}});
  builder.connect(part, a, b, G12);
  builder.connect(part, a, room, G1);
  builder.connect(part, b, room, G2);
  builder.add<SwitchedHeat>(part, {a}, {q}, {builder.channel("on")});
  Network const network = builder.build();
  // dθ/dt = M θ + s: θ = θ∞ + Σ cᵢ vᵢ e^{λᵢ t}.
  Eigen::Matrix2d M;
  M << -(G12 + G1) / C1, G12 / C1, G12 / C2, -(G12 + G2) / C2;
  double const trace = M.trace(), root = std::sqrt(0.25 * trace * trace - M.determinant());
  double const slow = 0.5 * trace + root, fast = 0.5 * trace - root;
  Eigen::Vector2d const end = -M.inverse() * Eigen::Vector2d(q / C1, 0.0);
  auto const exact = [&](double t) -> Eigen::Vector2d {
    // e^{Mt} = (e^{λ₁t}(M − λ₂I) − e^{λ₂t}(M − λ₁I))/(λ₁ − λ₂)
    Eigen::Matrix2d const I = Eigen::Matrix2d::Identity();
    Eigen::Matrix2d const power =
        (std::exp(slow * t) * (M - fast * I) - std::exp(fast * t) * (M - slow * I)) / (slow - fast);
    return end - power * end;
  };
  FunctionCourse const course({"on"}, [](double, std::span<double> u) { u[0] = 1.0; });
  std::vector<double> const start(2, T0), times{0.0, 50.0, 500.0, 5000.0, 50000.0};
  auto const summary = integrate(network, course, start, times, tight(1e-10), [&](Sample const& s) {
    EXPECT_NEAR(s.temperatures[0] - T0, exact(s.time)[0], 2e-7);
    EXPECT_NEAR(s.temperatures[1] - T0, exact(s.time)[1], 2e-7);
    EXPECT_NEAR(s.energy.supplied, q * s.time, 1e-8 * q * s.time);
    double const stored = C1 * (s.temperatures[0] - T0) + C2 * (s.temperatures[1] - T0);
    EXPECT_NEAR(s.energy.supplied, stored + s.energy.lost, 1e-8 * q * (s.time + 1.0));
  });
  EXPECT_LT(summary.energy_imbalance(), 1e-12);
}

// --- V10: bearing whose friction falls with its temperature
// -----------------------------------------------------------

/// Q = ω · 4500.9 f₀ (ν ω)^{2/3} d³ with ν = A exp(B/(T + 95 °C)): physics.md 1.2 and 1.6. c = {f₀, d, A, B}, u = {ω}.
struct Palmgren {
  static constexpr std::string_view name = "Palmgren";
  static constexpr int ports = 1, coefficients = 4, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    using std::exp;
    using std::pow;
    S const viscosity = c[2] * exp(c[3] / (T[0] - 178.15));
    q[0] = u[0] * 4500.9 * c[0] * pow(S(viscosity * u[0]), 2.0 / 3.0) * c[1] * c[1] * c[1];
  }
};

TEST(VerificationV10, BearingFeedbackEndsWhereNewtonSaysItDoes) {
  double const omega = 6000.0 * 2 * pi / 60, f0 = 0.8, d = 0.09, A = 0.0870e-6, B = 748.0, G = 5.0;
  auto const heat = [&](double T) {
    double const viscosity = A * std::exp(B / (T - 178.15));
    return omega * 4500.9 * f0 * std::pow(viscosity * omega, 2.0 / 3.0) * d * d * d;
  };
  double low = T0, high = T0 + 200.0;
  for (int i = 0; i < 100; ++i)
    (heat(0.5 * (low + high)) > G * (0.5 * (low + high) - T0) ? low : high) = 0.5 * (low + high);
  NetworkBuilder builder;
  int const part = builder.part("bearing");
  Port const ring = builder.add_body("ring", {2000.0});
  builder.connect(part, ring, builder.add_boundary({"housing", T0, {}}), G);
  builder.add<Palmgren>(part, {ring}, {f0, d, A, B}, {builder.channel("omega")});
  Network const network = builder.build();
  EXPECT_NEAR(steady_state(network, std::vector{omega}, std::vector{T0})[0], low, 1e-8);
  FunctionCourse const course({"omega"}, [&](double, std::span<double> u) { u[0] = omega; });
  EXPECT_NEAR(run(network, course, T0, {0.0, 20000.0}, tight(1e-8)).back()[0], low, 1e-6);
  EXPECT_LT(heat(low), 0.6 * heat(T0)) << "the feedback is worth looking at";
}

// --- V11: relay chiller
// -----------------------------------------------------------------------------------------------

TEST(VerificationV11, RelayChillerCyclesWithItsPeriod) {
  double const C = 40000.0, band = 1.0, load = 300.0, full = 1000.0;
  NetworkBuilder builder;
  int const part = builder.part("tank"), chiller = builder.part("chiller");
  Port const tank = builder.add_body("tank", {C});
  Port const set = builder.add_boundary({"set point", T0, {}});
  builder.connect(part, tank, set, 1e-9);
  int const state = builder.add_relay("chiller", tank, set, 0.5 * band, -0.5 * band);
  builder.add<SwitchedHeat>(part, {tank}, {load}, {builder.channel("load")});
  builder.add<SwitchedHeat>(chiller, {tank}, {-full}, {state});
  Network const network = builder.build();
  FunctionCourse const course({"load"}, [](double, std::span<double> u) { u[0] = 1.0; });
  double const period = C * band * (1 / load + 1 / (full - load));
  std::vector<double> times, start{T0}, switched_on;
  for (int i = 0; i <= 40000; ++i) times.push_back(i * 0.1);
  bool before = false;
  double lowest = T0, highest = T0;
  auto const summary = integrate(network, course, start, times, {}, [&](Sample const& s) {
    bool const on = s.input[1] > 0.5;
    if (on && !before) switched_on.push_back(s.time);
    before = on;
    lowest = std::min(lowest, s.temperatures[0]);
    highest = std::max(highest, s.temperatures[0]);
  });
  ASSERT_GT(switched_on.size(), 10u);
  double const measured = (switched_on.back() - switched_on.front()) / double(switched_on.size() - 1);
  EXPECT_NEAR(measured, period, 1e-3 * period);
  EXPECT_NEAR(switched_on.front(), C * 0.5 * band / load, 0.1);
  EXPECT_NEAR(highest - T0, 0.5 * band, 1e-4);
  EXPECT_NEAR(lowest - T0, -0.5 * band, 1e-2);
  EXPECT_LT(summary.energy_imbalance(), 1e-9);
}

TEST(VerificationV11, AMinimumOffTimeLetsTheTankOvershoot) {
  double const C = 40000.0, load = 300.0, full = 1000.0, off_time = 180.0;
  NetworkBuilder builder;
  int const part = builder.part("tank");
  Port const tank = builder.add_body("tank", {C});
  Port const set = builder.add_boundary({"set point", T0, {}});
  builder.connect(part, tank, set, 1e-9);
  int const state = builder.add_relay("chiller", tank, set, 0.5, -0.5, off_time);
  builder.add<SwitchedHeat>(part, {tank}, {load}, {builder.channel("load")});
  builder.add<SwitchedHeat>(part, {tank}, {-full}, {state});
  FunctionCourse const course({"load"}, [](double, std::span<double> u) { u[0] = 1.0; });
  std::vector<double> times, start{T0};
  for (int i = 0; i <= 4000; ++i) times.push_back(i);
  double highest_later = T0;
  integrate(builder.build(), course, start, times, {}, [&](Sample const& s) {
    if (s.time > 300.0) highest_later = std::max(highest_later, s.temperatures[0]);
  });
  EXPECT_NEAR(highest_later - T0, -0.5 + off_time * load / C, 0.01) << "180 s at 300 W from the lower limit";
}

}  // namespace
}  // namespace thermotwin::thermal
