#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <span>

#include "tests/thermal/verification.h"
#include "thermal/bar.h"
#include "thermal/laws.h"
#include "thermal/stroke.h"

namespace thermotwin::thermal {
namespace {

// physics.md §9, V7: a source of 60 W on a rod that loses heat along its length.
constexpr double k = 42.0, rho = 7850.0, c = 470.0, area = 1.046e-3, perimeter = 0.12566, h = 26.0, power = 60.0;

struct Rod {
  Network network;
  Body body;
};

/// The rod under a window of length `window` whose centre is the channel "position".
Rod rod(double length, int cells, double window, double conductivity = k) {
  Material material{"steel", conductivity, 0.0, rho, c, 0.0, 12e-6, 210e9, 0.3, 0.3};
  Body body =
      make_body("rod", Bar{material, {0, 0, 0}, {1, 0, 0}, length, perimeter / std::numbers::pi, 0.0, area, cells});
  NetworkBuilder builder;
  int const part = builder.part("rod");
  add_to(builder, part, body);
  add_film(builder, part, face(body, "surface"), builder.add_boundary({"air", T0, {}}), h);
  int const position = builder.channel("position");
  Port const under = add_moving_average(builder, face(body, "surface"), position, position, window);
  builder.add<SwitchedHeat>(builder.part("source"), {under}, {power}, {builder.channel("on")});
  return {builder.build(), std::move(body)};
}

TEST(VerificationV7, SteadyProfileAheadOfAndBehindAMovingSource) {
  double const U = 2e-3, start = 0.2, duration = 450.0, here = start + U * duration;
  double const a = k / (rho * c), m2 = h * perimeter / (k * area);
  double const s = std::sqrt(U * U / (a * a) + 4 * m2), peak = power / (k * area * s);
  auto const exact = [&](double xi) {
    return xi > 0 ? peak * std::exp(-0.5 * (U / a + s) * xi) : peak * std::exp(0.5 * (s - U / a) * xi);
  };
  EXPECT_NEAR(peak, 7.736, 5e-4);
  EXPECT_NEAR(exact(-0.1), 7.4165, 5e-5);
  EXPECT_NEAR(exact(-0.3), 6.8158, 1e-4);
  FunctionCourse const course({"position", "on"}, [&](double t, std::span<double> u) {
    u[0] = start + U * t;
    u[1] = 1.0;
  });
  double const step = 2e-3;
  Rod const moving = rod(1.4, 700, step);
  IntegrationOptions options = tight(1e-6);
  auto const state = run(moving.network, course, T0, {0.0, duration}, options).back();
  for (double xi : {-0.3, -0.2, -0.1, -0.05, -0.02, 0.011, 0.015}) {
    double const theta = reading(point(moving.body, {here + xi, 0, 0}), state) - T0;
    EXPECT_NEAR(theta, exact(xi), 2e-3 * peak) << xi;
  }
}

TEST(VerificationV7b, ReciprocatingWithoutConductionHeatsTheStrokeEvenly) {
  double const stroke = 0.6, period = 24.0, mean = power / (h * perimeter * stroke);
  EXPECT_NEAR(mean, 30.6, 0.05);
  std::vector<double> turns;
  for (int i = 1; i < 2000; ++i) turns.push_back(0.5 * period * i);
  double const window = 0.05, from = 0.1 + 0.5 * window, to = 0.1 + stroke - 0.5 * window;
  FunctionCourse const course(
      {"position", "on"},
      [&](double t, std::span<double> u) {
        double const phase = std::fmod(t, period) / period;
        u[0] = from + (to - from) * (phase < 0.5 ? 2 * phase : 2 - 2 * phase);
        u[1] = 1.0;
      },
      turns);
  Rod const moving = rod(0.8, 80, window, 1e-6);
  auto const state = run(moving.network, course, T0, {0.0, 8000.0}, tight(1e-4)).back();
  // After 8000 s of τ = ρcA/(hP) = 1181 s, all of the stroke's heat stands in the stroke.
  double const settled = 1.0 - std::exp(-8000.0 * h * perimeter / (rho * c * area));
  double sum = 0.0;
  for (double T : state) sum += (T - T0) * 0.01;
  EXPECT_NEAR(sum / stroke, mean * settled, 1e-3 * mean);
  EXPECT_NEAR(state[5] - T0, 0.0, 1e-3) << "outside the stroke";
  for (std::size_t i = 20; i < 60; ++i)
    EXPECT_NEAR(state[i] - T0, mean * settled * stroke / (to - from), 0.02 * mean) << "full dwell";
}

}  // namespace
}  // namespace thermotwin::thermal
