#include "thermal/contact.h"

#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

constexpr double air = 0.026;
RoughContact const iron_on_steel{33.0, 48.0, 0.8e-6, 0.1, 2.5e9};

TEST(ContactFilm, GivesTheNumbersOfPhysics2_2) {
  double const pressures[] = {0.2e6, 1e6, 5e6, 20e6}, films[] = {0.8e3, 3.6e3, 17e3, 62e3};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(contact_film(iron_on_steel, pressures[i]), films[i], 0.04 * films[i]);
}

TEST(JointFilm, AddsTheGapAndGrowsWithPressure) {
  double const separation = 1.53 * 0.8e-6 * std::pow(1e6 / 2.5e9, -0.097);
  EXPECT_NEAR(gap_film(iron_on_steel, 1e6, air, air_gas_parameter), air / (separation + 0.37e-6), 1e-9);
  EXPECT_DOUBLE_EQ(joint_film(iron_on_steel, 1e6, air, air_gas_parameter),
                   contact_film(iron_on_steel, 1e6) + gap_film(iron_on_steel, 1e6, air, air_gas_parameter));
  auto const film = [](auto const& p) {
    using S = std::decay_t<decltype(p)>;
    return joint_film<S>(iron_on_steel, p, S(0.13), 0.0);
  };
  EXPECT_GT(film(2e6), film(1e6));
  expect_slope_is_difference(film, 1e6, 10.0);
}

TEST(JungnickelJoint, Gives14To16InAirAnd70WithOil) {
  double const heights = 2 * ten_point_height::milling;
  auto const film = [&](double gas, double p) { return jungnickel_joint_film(gas, 33.0, 48.0, heights, p, 750e6); };
  EXPECT_NEAR(film(air, 0.1e6), 14e3, 500.0);
  EXPECT_NEAR(film(air, 5e6), 16e3, 500.0);
  EXPECT_NEAR(film(0.13, 0.1e6), 69e3, 500.0);
  EXPECT_NEAR(film(0.13, 5e6), 71e3, 500.0);
}

TEST(JungnickelJoint, RoughnessFactorIsSmoothAcrossBothSwitches) {
  auto const factor = [](auto const& height) { return joint_roughness_factor(height); };
  expect_smooth_switch(factor, fine_joint_height);
  expect_smooth_switch(factor, coarse_joint_height);
  EXPECT_NEAR(factor(8e-6), 15.0 / 8.0, 1e-3);
  EXPECT_NEAR(factor(22e-6), std::pow(30.0 / 22.0, 0.33), 0.005);
  EXPECT_NEAR(factor(50e-6), 1.0, 1e-6);
}

TEST(JungnickelJoint, HasExactSlopes) {
  auto const over_pressure = [](auto const& p) {
    using S = std::decay_t<decltype(p)>;
    return jungnickel_joint_film<S>(S(air), S(33.0), S(48.0), S(12.6e-6), p, S(750e6));
  };
  expect_slope_is_difference(over_pressure, 2e6, 10.0);
}

Fit ring_in_housing() {  // ring 110/101 in an iron housing Ø160
  Fit fit;
  fit.diameter = 0.110;
  fit.inner_bore = 0.101;
  fit.outer_diameter = 0.160;
  fit.contact = iron_on_steel;
  return fit;
}

TEST(FitGap, ARing5KelvinHotterCloses6Point5Micrometres) {
  EXPECT_NEAR(fit_gap(10e-6, 0.110, 11.8e-6, 5.0, 10.5e-6, 0.0), 10e-6 - 6.5e-6, 0.05e-6);
  EXPECT_NEAR(fit_gap(0.0, 0.110, 11.8e-6, 10.0, 10.5e-6, 10.0), -0.110 * 1.3e-6 * 10.0, 1e-15);
}

TEST(FitPressure, Is0Point11MpaPerMicrometre) {
  EXPECT_NEAR(fit_pressure(ring_in_housing(), -1e-6), 0.11e6, 0.005e6);
  EXPECT_NEAR(fit_pressure(ring_in_housing(), -10e-6), 1.1e6, 0.05e6);
  EXPECT_LT(fit_pressure(ring_in_housing(), 10e-6), 1e3);
}

TEST(FitFilm, GivesTheNumbersOfPhysics2_3ForAir) {
  double const radial[] = {2e-6, 5e-6, 10e-6, 30e-6}, films[] = {7.4e3, 4.0e3, 2.3e3, 0.8e3};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(fit_film(ring_in_housing(), 2 * radial[i], air), films[i], 0.05e3);
}

TEST(FitFilm, OfAnInterferenceAddsTheSpotsThatTouch) {
  double const pressure = fit_pressure(ring_in_housing(), -10e-6);
  EXPECT_NEAR(fit_film(ring_in_housing(), -10e-6, air), air / 1.5e-6 + contact_film(iron_on_steel, pressure), 20.0);
}

TEST(FitFilm, IsSmoothFromClearanceToInterference) {
  auto const film = [](auto const& gap) {
    using S = std::decay_t<decltype(gap)>;
    return fit_film<S>(ring_in_housing(), gap, S(air));
  };
  expect_continuous_with_slope(film, -1e-6, 1e-6);
  expect_slope_is_difference(film, 0.05e-6, 1e-11);
  expect_slope_is_difference(film, -3e-6, 1e-10);
  expect_slope_is_difference(film, 30e-6, 1e-9);
  for (double gap = -5e-6; gap < 50e-6; gap += 0.1e-6) EXPECT_LT(slope_of(film, gap), 0.0) << gap;
}

}  // namespace
}  // namespace thermotwin::thermal
