#include "thermal/windage.h"

#include <gtest/gtest.h>
#include <numbers>

#include "tests/thermal/smoothness.h"
#include "thermal/fluid.h"

namespace thermotwin::thermal {
namespace {

constexpr double rpm = std::numbers::pi / 30.0;

template <class S>
S motor_gap_windage(S const& speed) {  // r = 60 mm, L = 150 mm, δ = 0.4 mm, air at 25 °C
  return gap_windage<S>(speed, S(0.060), S(0.150), S(0.4e-3), S(1.184), S(1.58e-5));
}

TEST(GapWindage, OfAMotorSpindle) {
  EXPECT_NEAR(motor_gap_windage(6000 * rpm), 18.0, 0.5);
  EXPECT_NEAR(motor_gap_windage(12000 * rpm), 115.0, 1.0);
}

TEST(VrancikFriction, SolvesItsEquation) {
  for (double const reynolds : {5.0, 100.0, 1e3, 1e5, 1e7}) {
    double const root = std::sqrt(vrancik_friction(reynolds));
    EXPECT_NEAR(1.0 / root, 2.04 + 1.768 * std::log(reynolds * root), 1e-10) << reynolds;
  }
  expect_slope_is_difference([](auto const& re) { return vrancik_friction(re); }, 1e4, 1.0);
}

TEST(GapFriction, IsCouetteAtLowSpeed) {
  EXPECT_NEAR(gap_friction(10.0), 0.2, 1e-6);
  // P = 2π μ ω² r³ L/δ
  double const w = 1.0, mu = 1.184 * 1.58e-5;
  EXPECT_NEAR(motor_gap_windage(w), 2 * std::numbers::pi * mu * w * w * std::pow(0.06, 3) * 0.15 / 0.4e-3, 1e-9);
}

TEST(GapFriction, IsSmoothWhereVorticesBegin) {
  expect_smooth_switch([](auto const& re) { return gap_friction(re); }, gap_turbulence_reynolds);
  EXPECT_NEAR(vrancik_friction(gap_turbulence_reynolds), 2.0 / gap_turbulence_reynolds, 0.005 * 2.0 / 87.0);
}

TEST(GapWindage, VanishesWithZeroSlopeAtRest) {
  auto const power = [](auto const& w) { return motor_gap_windage(w); };
  EXPECT_NEAR(power(0.0), 0.0, 1e-15);
  EXPECT_EQ(slope_of(power, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(power(-50.0), power(50.0));
  expect_slope_is_difference(power, 600.0, 0.01);
}

TEST(DiscWindage, OfAChuckAt4500Rpm) {
  FluidProperties<double> const air = properties(Air{}, 298.15);
  EXPECT_NEAR(disc_windage(4500 * rpm, 0.125, air.density, air.kinematic_viscosity), 20.0, 0.5);
}

TEST(DiscWindage, IsSmoothWhereTurbulenceBegins) {
  auto const moment = [](auto const& re) { return disc_moment_coefficient(re); };
  expect_smooth_switch(moment, disc_turbulence_reynolds);
  EXPECT_NEAR(moment(1e5), 3.87 / std::sqrt(1e5), 1e-7);
  EXPECT_NEAR(moment(1e6), 0.146 * std::pow(1e6, -0.2), 1e-7);
}

TEST(DiscWindage, VanishesAtRest) {
  auto const power = [](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return disc_windage<S>(w, S(0.125), S(1.18), S(1.58e-5));
  };
  EXPECT_NEAR(power(0.0), 0.0, 1e-15);
  EXPECT_EQ(slope_of(power, 0.0), 0.0);
  expect_slope_is_difference(power, 200.0, 0.01);
}

}  // namespace
}  // namespace thermotwin::thermal
