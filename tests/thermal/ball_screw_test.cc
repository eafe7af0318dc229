#include "thermal/ball_screw.h"

#include <gtest/gtest.h>
#include <numbers>

namespace thermotwin::thermal {
namespace {

using Support = BallScrew::Support;

/// Screw of Set A (physics.md 6.1).
BallScrew screw(Support support) {
  BallScrew s;
  s.support = support;
  s.section_area = std::numbers::pi / 4.0 * 0.0365 * 0.0365;
  s.unilateral = false;
  for (int i = 0; i <= 42; ++i) s.edges.push_back(0.02 * i);
  return s;
}

/// Rises of Set A after 4 h at 12 m/min, by the prototype.
std::vector<double> const set_a = {
    8.50973,  8.21749,  8.15621,  8.32398,  8.72017,  9.25666,  9.85615,  10.45126, 10.98650, 11.40583, 11.73430,
    11.99154, 12.19680, 12.35459, 12.47818, 12.57119, 12.63920, 12.68629, 12.71897, 12.73552, 12.74059, 12.73448,
    12.71315, 12.67534, 12.62243, 12.55127, 12.45760, 12.33958, 12.18638, 11.98885, 11.73517, 11.41017, 10.99441,
    10.46300, 9.78414,  9.00949,  8.19003,  7.38949,  6.68816,  6.17424,  5.83348,  5.65650};

std::vector<double> uniform(double rise) { return std::vector<double>(42, rise); }

TEST(BallScrew, FreeScrewGrowsWithTheHeatBetweenBearingAndNut) {
  auto const s = screw(Support::fixed_supported);
  EXPECT_NEAR(s.position_error(0.6, uniform(10.0)), 70.8e-6, 1e-12);
  auto local = uniform(0.0);
  local[20] = 5.0;
  EXPECT_EQ(s.position_error(0.40, local), 0.0);
  EXPECT_NEAR(s.position_error(0.41, local), 11.8e-6 * 5.0 * 0.01, 1e-15);
  EXPECT_NEAR(s.position_error(0.84, local), 11.8e-6 * 5.0 * 0.02, 1e-15);
}

TEST(BallScrew, GoldenErrorsOfSetA) {
  auto const free = screw(Support::fixed_supported), held = screw(Support::fixed_fixed);
  double const expected[3][3] = {{0.12, 12.0795, -16.6296}, {0.42, 54.4525, 1.7858}, {0.72, 95.9096, 19.2851}};
  for (auto const& [x, supported, fixed] : expected) {
    EXPECT_NEAR(free.position_error(x, set_a) * 1e6, supported, 2e-4);
    EXPECT_NEAR(held.position_error(x, set_a) * 1e6, fixed, 2e-4);
  }
  EXPECT_NEAR(held.force_change(held.free_growth(0.84, set_a)), -17213.4, 0.1);
}

TEST(BallScrew, BarBetweenSpringsIsInBalanceWithBothBearings) {
  auto s = screw(Support::fixed_fixed);
  s.stiffness_far = 0.4e9;
  for (double const seat : {0.0, 20e-6, -35e-6}) {
    double const growth = s.free_growth(0.84, set_a);
    double const force = s.force_change(growth - seat);
    EXPECT_NEAR(s.position_error(0.0, set_a, seat), force / s.stiffness_fixed, 1e-18) << "the start pulls its bearing";
    EXPECT_NEAR(s.position_error(0.84, set_a, seat), seat - force / s.stiffness_far, 1e-18) << "and so does the end";
  }
}

TEST(BallScrew, UniformRiseOfScrewAndSeatsLeavesTheForceAlone) {
  auto const s = screw(Support::fixed_fixed);
  double const growth = 11.8e-6 * 0.84 * 7.0;
  EXPECT_NEAR(s.force_change(s.free_growth(0.84, uniform(7.0)) - growth), 0.0, 1e-9);
  EXPECT_NEAR(s.position_error(0.5, uniform(7.0), growth), 11.8e-6 * 0.5 * 7.0, 1e-15);
}

TEST(BallScrew, PretensionHoldsUntilItsWarmingIsReached) {
  auto s = screw(Support::fixed_fixed);
  s.unilateral = true;
  auto const error = [&](double rise) { return s.position_error(0.72, uniform(rise)); };
  auto const slope = [&](double rise) { return (error(rise + 0.01) - error(rise - 0.01)) / 0.02; };
  EXPECT_NEAR(s.pretension() + s.force_change(s.free_growth(0.84, uniform(3.0))), 0.0, 1e-6);
  EXPECT_NEAR(error(3.0 - 1e-9), error(3.0 + 1e-9), 1e-13) << "no jump";
  auto held = s;
  held.unilateral = false;
  EXPECT_EQ(error(2.9), held.position_error(0.72, uniform(2.9)));
  EXPECT_NEAR(slope(4.0), 11.8e-6 * 0.72, 1e-12) << "then as the free screw";
  EXPECT_LT(slope(2.5), 0.4 * slope(4.0));
}

TEST(BallScrew, WhatIsLeftOfTheFarStiffnessSetsTheSlopeAfterRelief) {
  auto s = screw(Support::fixed_fixed);
  s.unilateral = true;
  auto const slope = [&] { return s.position_error(0.72, uniform(9.0)) - s.position_error(0.72, uniform(8.0)); };
  s.released_stiffness = 1e-9;
  EXPECT_NEAR(slope(), 11.8e-6 * 0.72, 1e-12);
  s.released_stiffness = 1.0;
  auto held = s;
  held.unilateral = false;
  EXPECT_NEAR(s.position_error(0.72, uniform(9.0)), held.position_error(0.72, uniform(9.0)), 1e-18);
  double last = slope();
  for (double const left : {0.5, 0.2, 0.05, 0.0}) {
    s.released_stiffness = left;
    EXPECT_GT(slope(), last) << left;
    last = slope();
  }
}

TEST(BallScrew, VerySoftFarBearingIsAFloatingOne) {
  auto s = screw(Support::fixed_fixed);
  s.stiffness_far = 1e-3;
  EXPECT_NEAR(s.position_error(0.72, set_a), screw(Support::fixed_free).position_error(0.72, set_a), 1e-15);
}

TEST(BallScrew, ColderScrewIsPulledAndPretensionNeverEnds) {
  auto s = screw(Support::fixed_fixed);
  s.unilateral = true;
  EXPECT_GT(s.force_change(s.free_growth(0.84, uniform(-5.0))), 0.0);
  auto held = s;
  held.unilateral = false;
  EXPECT_EQ(s.position_error(0.3, uniform(-5.0)), held.position_error(0.3, uniform(-5.0)));
}

}  // namespace
}  // namespace thermotwin::thermal
