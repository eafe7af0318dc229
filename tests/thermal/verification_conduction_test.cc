#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <span>

#include "tests/thermal/verification.h"
#include "thermal/bar.h"
#include "thermal/block.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/laws.h"

namespace thermotwin::thermal {
namespace {

using std::numbers::pi;

// --- V1: rod whose start is suddenly held at Θ, end insulated
// ---------------------------------------------------------

constexpr double rod_length = 0.2, step_height = 10.0;

double series(double x, double t) {
  double const a = 50.0 / (7850.0 * 470.0);
  double sum = 0.0;
  for (int m = 0; m < 200; ++m) {
    double const lambda = (2 * m + 1) * pi / (2 * rod_length);
    sum += 4.0 / ((2 * m + 1) * pi) * std::sin(lambda * x) * std::exp(-a * lambda * lambda * t);
  }
  return step_height * (1.0 - sum);
}

std::vector<double> rod_middle(int cells, std::vector<double> const& times) {
  NetworkBuilder builder;
  int const part = builder.part("rod");
  Body const rod = make_body("rod", Bar{verification_steel(), {0, 0, 0}, {1, 0, 0}, rod_length, 0.02, 0.0, {}, cells});
  add_to(builder, part, rod);
  hold(builder, part, face(rod, "start"), builder.add_boundary({"hot", T0 + step_height, {}}));
  std::vector<double> middle;
  for (auto const& state : run(builder.build(), FunctionCourse(), T0, times, tight()))
    middle.push_back(reading(point(rod, {0.5 * rod_length, 0, 0}), state) - T0);
  return middle;
}

TEST(VerificationV1, StepAtTheEndOfARod) {
  EXPECT_NEAR(series(0.1, 300.0), 2.68317, 5e-6);
  EXPECT_NEAR(series(0.1, 600.0), 4.51502, 5e-6);
  auto const middle = rod_middle(80, {0.0, 300.0, 600.0});
  EXPECT_NEAR(middle[1], 2.68317, 5e-4);
  EXPECT_NEAR(middle[2], 4.51502, 5e-4);
}

TEST(VerificationV1, IsOfSecondOrder) {
  for (std::size_t k : {1u, 2u}) {
    std::vector<double> const times{0.0, 300.0, 600.0};
    auto const error = [&](int cells) { return rod_middle(cells, times)[k] - series(0.1, times[k]); };
    double const coarse = error(40), fine = error(80), finest = error(160);
    EXPECT_NEAR(order(coarse, fine), 2.0, 0.05);
    EXPECT_NEAR(order(fine, finest), 2.0, 0.05);
  }
}

// --- V1b: semi-infinite solid, three kinds of surface
// -----------------------------------------------------------------

class VerificationV1b : public testing::Test {
 protected:
  static constexpr double k = 50.0, a = 50.0 / (7850.0 * 470.0), t = 600.0, area = 1e-4;

  enum class Surface { held, heated, convecting };

  static double worst(Surface surface, double amount, auto exact) {
    NetworkBuilder builder;
    int const part = builder.part("solid");
    Body const solid = make_body("solid", Bar{verification_steel(), {0, 0, 0}, {1, 0, 0}, 0.8, 0.01, 0.0, area, 400});
    Port const first = add_to(builder, part, solid);
    Port const hot = builder.add_boundary({"hot", T0 + (surface == Surface::heated ? 0.0 : 10.0), {}});
    Site const start = face(solid, "start");
    if (surface == Surface::held) hold(builder, part, start, hot);
    if (surface == Surface::convecting) add_film(builder, part, start, hot, amount);
    if (surface == Surface::heated) {
      builder.add<SwitchedHeat>(part, {first}, {amount * area}, {builder.channel("on")});
      hold(builder, part, face(solid, "end"), hot);
    }
    std::vector<std::string> const names =
        surface == Surface::heated ? std::vector<std::string>{"on"} : std::vector<std::string>{};
    FunctionCourse const course(names, [](double, std::span<double> u) {
      for (double& value : u) value = 1.0;
    });
    auto const state = run(builder.build(), course, T0, {0.0, t}, tight(1e-8)).back();
    double error = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i)
      error = std::max(error, std::abs(state[i] - T0 - exact(solid.stations[0][i])));
    return error;
  }
};

TEST_F(VerificationV1b, SurfaceHeld) {
  EXPECT_LT(worst(Surface::held, 0.0, [](double x) { return 10.0 * std::erfc(x / (2 * std::sqrt(a * t))); }), 1e-3);
}

TEST_F(VerificationV1b, SurfaceHeated) {
  double const q = 5000.0;
  EXPECT_LT(worst(Surface::heated, q,
                  [&](double x) {
                    return 2 * q / k * std::sqrt(a * t / pi) * std::exp(-x * x / (4 * a * t)) -
                           q * x / k * std::erfc(x / (2 * std::sqrt(a * t)));
                  }),
            1e-3);
}

TEST_F(VerificationV1b, SurfaceConvecting) {
  double const h = 500.0;
  EXPECT_LT(worst(Surface::convecting, h,
                  [&](double x) {
                    double const xi = x / (2 * std::sqrt(a * t));
                    return 10.0 * (std::erfc(xi) - std::exp(h * x / k + h * h * a * t / (k * k)) *
                                                       std::erfc(xi + h * std::sqrt(a * t) / k));
                  }),
            1e-3);
}

// --- V4: slab with uniform source, both faces cooled
// ------------------------------------------------------------------

constexpr double source = 1e5, film = 500.0, slab_length = 0.2;

/// Temperatures of the nodes and their places.
struct Slab {
  std::vector<double> theta, x;
};

Slab slab(int cells) {
  NetworkBuilder builder;
  int const part = builder.part("slab");
  Body const body = make_body("slab", Block{verification_steel(), {0, 0, 0}, {slab_length, 0.1, 0.1}, {cells, 1, 1}});
  add_to(builder, part, body);
  Port const air = builder.add_boundary({"air", T0, {}});
  add_film(builder, part, face(body, "x_min"), air, film);
  add_film(builder, part, face(body, "x_max"), air, film);
  Site const all = whole(body);
  for (auto const& c : all.contacts)
    builder.add<SwitchedHeat>(part, {port_of(builder, all, c)}, {source * 0.01 * slab_length * c.share},
                              {builder.channel("on")});
  auto theta = steady_state(builder.build(), std::vector{1.0}, std::vector<double>(std::size_t(cells), T0));
  for (double& value : theta) value -= T0;
  return {theta, body.stations[0]};
}

double slab_error(int cells) {
  Slab const s = slab(cells);
  double worst = 0.0;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    double const exact = source * slab_length / (2 * film) + source / (2 * 50.0) * s.x[i] * (slab_length - s.x[i]);
    worst = std::max(worst, std::abs(s.theta[i] - exact));
  }
  return worst;
}

TEST(VerificationV4, SlabWithUniformSource) {
  EXPECT_NEAR(slab(101).theta[50], 30.0, 2e-3);
  EXPECT_LT(slab_error(100), 2e-3);
  EXPECT_NEAR(order(slab_error(10), slab_error(20)), 2.0, 0.05);
  EXPECT_NEAR(order(slab_error(20), slab_error(40)), 2.0, 0.05);
}

// --- V4b, V4c: cylinder with uniform source, cooled outside
// -----------------------------------------------------------

struct CylinderErrors {
  double profile, mean;  ///< of the node next to the bore or the axis; of the mean over the surface
};

CylinderErrors cylinder(double bore, int cells) {
  double const R = 0.1, k = 50.0;
  NetworkBuilder builder;
  int const part = builder.part("cylinder");
  Body const body = make_body(
      "cylinder", HollowCylinder{verification_steel(), {0, 0, 0}, {0, 0, 1}, 0.05, 2 * R, 2 * bore, 1, cells});
  add_to(builder, part, body);
  add_film(builder, part, face(body, "outer"), builder.add_boundary({"air", T0, {}}), film);
  Site const all = whole(body);
  double const volume = pi * (R * R - bore * bore) * 0.05;
  for (auto const& c : all.contacts)
    builder.add<SwitchedHeat>(part, {port_of(builder, all, c)}, {source * volume * c.share}, {builder.channel("on")});
  auto const state = steady_state(builder.build(), std::vector{1.0}, std::vector<double>(std::size_t(cells), T0));
  double const surface = source * (R * R - bore * bore) / (2 * R * film);
  auto const exact = [&](double r) {
    double const log_part = bore > 0.0 ? source * bore * bore / (2 * k) * std::log(r / R) : 0.0;
    return surface + source / (4 * k) * (R * R - r * r) + log_part;
  };
  double mean = 0.0;
  int const n = 20000;
  for (int i = 0; i < n; ++i) {
    double const r = bore + (R - bore) * (i + 0.5) / n;
    mean += exact(r) * 2 * r * (R - bore) / n / (R * R - bore * bore);
  }
  return {state[0] - T0 - exact(body.stations[1][0]), reading(all, state) - T0 - mean};
}

TEST(VerificationV4b, SolidCylinderWithUniformSource) {
  EXPECT_NEAR(cylinder(0.0, 40).mean, 0.0, 5e-3);
  for (int cells : {20, 40}) {
    auto const coarse = cylinder(0.0, cells), fine = cylinder(0.0, 2 * cells);
    EXPECT_NEAR(order(coarse.mean, fine.mean), 2.0, 0.05) << cells;
    EXPECT_NEAR(order(coarse.profile, fine.profile), 2.0, 0.05) << cells;
  }
}

TEST(VerificationV4c, HollowCylinderWithUniformSource) {
  EXPECT_NEAR(cylinder(0.04, 40).mean, 0.0, 2e-3);
  for (int cells : {10, 20, 40}) {
    auto const coarse = cylinder(0.04, cells), fine = cylinder(0.04, 2 * cells);
    EXPECT_NEAR(order(coarse.mean, fine.mean), 2.0, 0.05) << cells;
    EXPECT_NEAR(order(coarse.profile, fine.profile), 2.0, 0.05) << cells;
  }
}

}  // namespace
}  // namespace thermotwin::thermal
