#include "thermal/bearing_friction.h"

#include <gtest/gtest.h>
#include <numbers>
#include <string>

#include "tests/thermal/smoothness.h"
#include "thermal/error.h"
#include "thermal/lubricant.h"
#include "thermal/skf_friction.h"

namespace thermotwin::thermal {
namespace {

constexpr double rpm = std::numbers::pi / 30.0;
constexpr double degree = std::numbers::pi / 180.0;

TEST(Palmgren, AgreesWithThePrototype) {  // palmgren_M0 of reference/net.py
  EXPECT_NEAR(palmgren_viscous_torque(0.55, 22e-6, 6000 * rpm, 0.09), 0.10394205078893, 1e-9);
  EXPECT_NEAR(palmgren_viscous_torque(0.8, 22e-6, 2000 * rpm, 0.09), 0.07268381967864489, 1e-9);
  EXPECT_NEAR(palmgren_viscous_torque(0.85, 10e-6, 1500 * rpm, 0.1025), 0.055671954758914316, 1e-9);
  EXPECT_NEAR(palmgren_viscous_torque(0.55, 1e-6, 600 * rpm, 0.09), 0.0064152, 1e-9);
}

TEST(Palmgren, IsTheCatalogueFormulaInSi) {
  double const nu_mm2_per_s = 20.0, n_rpm = 3000.0, dm_mm = 90.0;
  double const catalogue = 1e-3 * 1e-7 * 2.0 * std::pow(nu_mm2_per_s * n_rpm, 2.0 / 3.0) * std::pow(dm_mm, 3);
  EXPECT_NEAR(palmgren_viscous_torque(2.0, 20e-6, 3000 * rpm, 0.09), catalogue, 5e-5 * catalogue);
}

TEST(Palmgren, KeepsF0BelowTheThreshold) {
  EXPECT_NEAR(palmgren_viscous_torque(3.0, 22e-6, 0.0, 0.09) / palmgren_viscous_torque(1.0, 22e-6, 0.0, 0.09), 3.0,
              1e-12);
}

TEST(Palmgren, IsSmoothAcrossItsThresholdAndAtRest) {
  auto const torque = [](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return palmgren_viscous_torque<S>(S(0.55), S(22e-6), w, S(0.09));
  };
  double const threshold = palmgren_threshold / 22e-6;
  expect_smooth_switch(torque, threshold);
  expect_continuous_with_slope(torque, -0.01, 0.01);
  expect_slope_is_difference(torque, threshold, 1e-4);
  expect_slope_is_difference(torque, 300.0, 1e-2);
  EXPECT_DOUBLE_EQ(torque(-300.0), torque(300.0));
}

TEST(Palmgren, BlendReachesNoGoldenMachine) {
  double const smallest_golden = 6.2e-6 * 1500 * rpm;  // VG22 at 80 °C, slowest speed of the reference machines
  double const published = 4500.9 * 0.55 * std::pow(smallest_golden, 2.0 / 3.0) * std::pow(0.09, 3);
  EXPECT_NEAR(palmgren_viscous_torque(0.55, 6.2e-6, 1500 * rpm, 0.09), published, 1e-9 * published);
}

TEST(Palmgren, FallsBy3Point2PercentPerKelvinThroughViscosity) {
  Vogel const oil = mineral_oil_viscosity(22);
  auto const torque = [&](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return palmgren_viscous_torque<S>(S(0.55), viscosity(oil, T), S(6000 * rpm), S(0.09));
  };
  EXPECT_NEAR(slope_of(torque, 303.15) / torque(303.15), -0.032, 5e-4);
  expect_slope_is_difference(torque, 303.15, 0.01);
}

TEST(FrictionHeat, IsTorqueTimesSpeedAndNothingAtRest) {
  auto const heat = [](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return friction_heat<S>(S(0.1), w);
  };
  EXPECT_EQ(heat(0.0), 0.0);
  EXPECT_NEAR(heat(-100.0), 10.0, 1e-8);
  expect_continuous_with_slope(heat, -0.01, 0.01);
}

TEST(LoadTorque, AgreesWithThePrototype) {  // harris_M1 of reference/net.py, front bearing of Set B
  double const load = harris_torque_load(0.0, 300.0, 15 * degree);
  EXPECT_NEAR(load, 3.36 * 300.0, 0.5);
  EXPECT_NEAR(load_torque(0.0005, 0.38, 0.003, 3.36 * 300.0, 0.09), 0.004988605057563065, 1e-12);
}

TEST(LoadTorque, HasAFiniteSlopeWithoutPreload) {
  auto const torque = [](auto const& ratio) {
    using S = std::decay_t<decltype(ratio)>;
    return load_torque<S>(S(5e-4), S(0.38), ratio, S(1000.0), S(0.09));
  };
  EXPECT_TRUE(std::isfinite(slope_of(torque, 0.0)));
  EXPECT_NEAR(torque(0.0), 0.0, 2e-5);
  expect_slope_is_difference(torque, 0.003, 1e-6);
}

TEST(LoadTorque, IsBelowFivePercentOfTheViscousOneInALightlyPreloadedSpindle) {
  EXPECT_LT(load_torque(0.0005, 0.38, 0.003, 1008.0, 0.09),
            0.05 * palmgren_viscous_torque(0.55, 22e-6, 6000 * rpm, 0.09));
}

TEST(TorqueLoad, HarrisIs3Point4TimesSchaefflerAt15Degrees) {
  double const harris = harris_torque_load(0.0, 300.0, 15 * degree);
  EXPECT_NEAR(harris / schaeffler_torque_load(0.0, 300.0, Arrangement::single), 3.36, 0.01);
  EXPECT_NEAR(schaeffler_torque_load(100.0, 300.0, Arrangement::duplex), 1.4 * 300 - 10, 0.01);
}

TEST(TorqueLoad, IsAtLeastTheRadialLoadAndSmoothWhereThatTakesOver) {
  EXPECT_NEAR(harris_torque_load(2000.0, 100.0, 15 * degree), 2000.0, 1e-3);
  EXPECT_NEAR(schaeffler_torque_load(2000.0, 100.0, Arrangement::single), 2000.0, 1e-3);
  expect_continuous_with_slope(
      [](auto const& Fa) {
        using S = std::decay_t<decltype(Fa)>;
        return harris_torque_load<S>(S(100.0), Fa, S(15 * degree));
      },
      25.0, 40.0);
  expect_continuous_with_slope(
      [](auto const& Fa) {
        using S = std::decay_t<decltype(Fa)>;
        return schaeffler_torque_load<S>(S(100.0), Fa, Arrangement::single);
      },
      100.0, 120.0);
}

TEST(StaticEquivalentLoad, FollowsIso76) {
  EXPECT_NEAR(static_axial_factor(15 * degree, Arrangement::single), 0.46, 1e-12);
  EXPECT_NEAR(static_axial_factor(25 * degree, Arrangement::duplex), 0.76, 1e-12);
  EXPECT_NEAR(static_axial_factor(20 * degree, Arrangement::single), 0.42, 1e-12);
  EXPECT_NEAR(static_equivalent_load(100.0, 1000.0, 0.46, Arrangement::single), 510.0, 1e-3);
  EXPECT_NEAR(static_equivalent_load(1000.0, 10.0, 0.46, Arrangement::single), 1000.0, 1e-3);
  EXPECT_DOUBLE_EQ(static_equivalent_load(100.0, 1000.0, 0.92, Arrangement::duplex), 1020.0);
  expect_continuous_with_slope(
      [](auto const& Fr) {
        using S = std::decay_t<decltype(Fr)>;
        return static_equivalent_load<S>(Fr, S(100.0), S(0.46), Arrangement::single);
      },
      80.0, 105.0);
  EXPECT_THROW((void)static_axial_factor(60 * degree, Arrangement::single), InputError);
}

TEST(HarrisCoefficients, AreThoseOfTheTableAndContinuousBetween) {
  EXPECT_DOUBLE_EQ(harris_coefficients(15 * degree).z, 5e-4);
  EXPECT_DOUBLE_EQ(harris_coefficients(25 * degree).y, 0.35);
  EXPECT_NEAR(harris_coefficients(12.5 * degree).z, 4e-4, 1e-15);
  EXPECT_NEAR(harris_coefficients(90 * degree).z, 1.2e-3, 1e-12);
  EXPECT_THROW((void)harris_coefficients(0.0), InputError);
}

TEST(ViscousTorqueFactor, FollowsTheTable) {
  EXPECT_EQ(viscous_torque_factor("angular contact ball", "grease"), 2.0);
  EXPECT_EQ(viscous_torque_factor("angular contact ball pair", "oil bath"), 6.5);
  EXPECT_EQ(viscous_torque_factor("angular contact ball", "oil injection"), 6.6);
  EXPECT_EQ(viscous_torque_factor("angular contact ball", "oil-air"), 1.65);
  EXPECT_EQ(viscous_torque_factor("deep groove ball", "grease"), 1.0);
  EXPECT_EQ(viscous_torque_factor("cylindrical roller", "oil bath"), 3.0);
  EXPECT_EQ(viscous_torque_factor("thrust ball", "oil bath"), 1.5);
}

TEST(ViscousTorqueFactor, UnknownNamesGetTheNearest) {
  try {
    (void)viscous_torque_factor("angular contact bal", "grease");
    FAIL() << "accepted";
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(), "unknown bearing type 'angular contact bal'; did you mean 'angular contact ball'?");
  }
  EXPECT_THROW((void)viscous_torque_factor("needle roller", "butter"), InputError);
}

TEST(InnerRingShare, Is0Point63Of7014C) {
  auto const share = [](auto const& r) {
    using S = std::decay_t<decltype(r)>;
    return inner_ring_share<S>(r, S(45e-3), S(15 * degree));
  };
  EXPECT_NEAR(share(6.15e-3), 0.63, 0.005);
  EXPECT_NEAR(share(0.0), 0.5, 1e-15);
  expect_slope_is_difference(share, 6.15e-3, 1e-5);
}

SkfBearing bearing_7014() {
  SkfBearing b;
  b.bore = 0.070;
  b.outer_diameter = 0.110;
  return b;
}

TEST(SkfFriction, GivesTheNumbersOfPhysics1_2) {  // 7014C, grease 22 mm²/s, 300 N, in N mm
  SkfBearing const b = bearing_7014();
  double const speeds[] = {2000, 4000, 6000}, rolling[] = {79, 157, 234}, sliding[] = {11, 56, 159};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(1e3 * skf_rolling_torque(b, 0.0, 300.0, 22e-6, speeds[i] * rpm), rolling[i], 0.5);
    EXPECT_NEAR(1e3 * skf_sliding_torque(b, 0.0, 300.0, 22e-6, speeds[i] * rpm), sliding[i], 0.5);
  }
  EXPECT_NEAR(1e3 * palmgren_viscous_torque(0.8, 22e-6, 4000 * rpm, 0.09), 115.0, 0.5);
}

TEST(SkfFriction, IsFiniteAtRestAndHasExactSlopes) {
  SkfBearing const b = bearing_7014();
  auto const over_speed = [&](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return skf_torque<S>(b, S(0.0), S(300.0), S(22e-6), w);
  };
  auto const over_viscosity = [&](auto const& nu) {
    using S = std::decay_t<decltype(nu)>;
    return skf_torque<S>(b, S(50.0), S(300.0), nu, S(100.0));
  };
  EXPECT_TRUE(std::isfinite(slope_of(over_speed, 0.0)));
  EXPECT_DOUBLE_EQ(over_speed(-20.0), over_speed(20.0));
  expect_slope_is_difference(over_speed, 200.0, 1e-3);
  expect_slope_is_difference(over_viscosity, 22e-6, 1e-9);
  expect_continuous_with_slope(over_speed, -0.02, 0.02);
}

TEST(SkfFriction, BoundaryFrictionRulesAtCreepingSpeed) {
  SkfBearing const b = bearing_7014();
  double const geometric = b.s1 * std::pow(90.0, 0.26) * b.s2 * std::pow(300.0, 4.0 / 3.0);
  EXPECT_NEAR(1e3 * skf_sliding_torque(b, 0.0, 300.0, 1e-9, 1.0 * rpm), 0.15 * geometric, 1e-3 * geometric);
}

}  // namespace
}  // namespace thermotwin::thermal
