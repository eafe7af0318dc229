#include "thermal/feed_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"
#include "thermal/drive_loss.h"

namespace thermotwin::thermal {
namespace {

using testing::AllOf, testing::Ge, testing::Le;

TEST(NutPreloadTorque, Of40By10At1500N) {
  auto const torque = [](auto const& F) {
    using S = std::decay_t<decltype(F)>;
    return nut_preload_torque<S>(F, S(0.010), S(0.040));
  };
  EXPECT_NEAR(torque(1500.0), 0.42, 0.005);
  expect_slope_is_difference(torque, 1500.0, 1.0);
}

TEST(NutLoadTorque, IsThatOfSetA) {  // T_ax of reference/setA.py: F_ax 1000 N, η 0.92
  EXPECT_NEAR(nut_load_torque(1000.0, 0.010, 0.92), 1000 * 0.010 / (2 * std::numbers::pi) * (1 / 0.92 - 1), 1e-12);
  EXPECT_DOUBLE_EQ(nut_load_torque(-1000.0, 0.010, 0.92), nut_load_torque(1000.0, 0.010, 0.92));
  EXPECT_EQ(nut_load_torque(0.0, 0.010, 0.92), 0.0);
}

TEST(PartlyViscousTorque, IsItsReferenceAtTheReferenceAndDryAtRest) {
  EXPECT_NEAR(ball_nut_torque(0.4, 0.6, 1.0, 0.1), 0.5, 1e-9);
  EXPECT_NEAR(ball_nut_torque(0.4, 0.6, 4.0, 0.0), 0.4 * (0.4 + 0.6 * 2), 1e-9);
  EXPECT_NEAR(ball_nut_torque(0.4, 0.6, 0.0, 0.0), 0.4 * 0.4, 1e-4);
  EXPECT_NEAR(screw_bearing_torque(0.2, 8.0), 0.2 * (0.3 + 0.7 * 4), 1e-9);
  EXPECT_NEAR(screw_bearing_torque(0.2, -1.0), 0.2, 1e-9);
}

TEST(PartlyViscousTorque, HasExactSlopesAndAFiniteOneAtRest) {
  auto const nut = [](auto const& x) {
    using S = std::decay_t<decltype(x)>;
    return ball_nut_torque<S>(S(0.4), S(0.6), x, S(0.1));
  };
  expect_slope_is_difference(nut, 0.7, 1e-5);
  EXPECT_EQ(slope_of(nut, 0.0), 0.0);
  expect_continuous_with_slope(nut, -1e-7, 1e-7);
}

TEST(FeedKinematics, MeanSpeedOfSetA) {  // 12 m/min, lead 10 mm, duty 0.88: 1056 rpm
  EXPECT_NEAR(mean_screw_speed(0.2, 0.010, 0.88) * 30 / std::numbers::pi, 1056.0, 1e-9);
  EXPECT_DOUBLE_EQ(duty(8.8, 1.2), 0.88);
}

TEST(RmsTorque, IsTheTorqueItselfWhenConstantAndTheRootMeanSquareElse) {
  StrokeTimes<double> const times{2.0, 0.5, 0.5, 1.0};
  EXPECT_DOUBLE_EQ(rms_torque(times, 1.5, 0.0, 1.5), 1.5);
  double const expected = std::sqrt((1.0 * 2.0 + 16.0 * 0.5 + 4.0 * 0.5 + 0.25 * 1.0) / 4.0);
  EXPECT_NEAR(rms_torque(times, 1.0, 3.0, 0.5), expected, 1e-12);
}

TEST(ReversalHeat, CountsReversals) { EXPECT_DOUBLE_EQ(reversal_heat(0.5, 3.0), 1.5); }

TEST(SlidingHeat, IsForceTimesSpeedAndNothingAtRest) {
  auto const heat = [](auto const& v) {
    using S = std::decay_t<decltype(v)>;
    return sliding_heat<S>(S(100.0), v);
  };
  EXPECT_NEAR(heat(-0.2), 20.0, 1e-6);
  EXPECT_EQ(heat(0.0), 0.0);
  expect_continuous_with_slope(heat, -1e-4, 1e-4);
}

TEST(RollingGuide, AddsLoadSealAndViscousForce) {
  EXPECT_NEAR(rolling_guide_force(0.003, 5000.0, 40.0, 100.0, -0.2), 15.0 + 40.0 + 20.0, 1e-6);
}

TEST(Slideway, FallsFromStaticToKineticFrictionThenRises) {
  auto const force = [](auto const& v) {
    using S = std::decay_t<decltype(v)>;
    return slideway_force<S>({S(0.06), S(0.03), S(0.01), S(0.05)}, S(1000.0), v);
  };
  EXPECT_NEAR(force(0.0), 60.0, 0.01);
  EXPECT_NEAR(force(0.05), 30.0 + 2.5, 0.01);
  EXPECT_NEAR(force(0.5), 30.0 + 25.0, 0.01);
  EXPECT_DOUBLE_EQ(force(-0.3), force(0.3));
  expect_slope_is_difference(force, 0.008, 1e-6);
  expect_continuous_with_slope(force, -1e-4, 1e-4);
}

TEST(BeltLoss, GrowsWithSpeedAndVanishesAtRest) {  // Set B: 45 r W
  EXPECT_NEAR(belt_idle_loss(45.0, 2.0 / 3.0, 1.0), 30.0, 1e-9);
  EXPECT_EQ(belt_idle_loss(45.0, 0.0, 1.0), 0.0);
  EXPECT_NEAR(transmission_loss(0.97, 1000.0), 30.0, 1e-9);
  expect_slope_is_difference(
      [](auto const& r) {
        using S = std::decay_t<decltype(r)>;
        return belt_idle_loss<S>(S(45.0), r, 1.5);
      },
      0.4, 1e-5);
}

TEST(GearChurning, FollowsSpeedAndViscosity) {
  EXPECT_NEAR(gear_churning_loss(50.0, 0.5, 2.0, 1.0), 12.5, 1e-9);
  EXPECT_NEAR(gear_churning_loss(50.0, 1.0, 2.0, 32.0), 100.0, 1e-6);
}

TEST(Hydraulics, TurnPowerIntoHeat) {
  EXPECT_DOUBLE_EQ(throttling_heat(5e6, 1e-4), 500.0);
  EXPECT_DOUBLE_EQ(hydraulic_unit_heat(1500.0, 0.2), 300.0);
  EXPECT_DOUBLE_EQ(coolant_pump_heat(1000.0, 0.5, 0.25), 750.0);
}

TEST(Cutting, HeatIsSharedWhole) {
  EXPECT_DOUBLE_EQ(cutting_power(2e9, 1e-6), 2000.0);
  CuttingHeatShares const shares;
  EXPECT_NEAR(shares.chip + shares.tool + shares.workpiece, 1.0, 1e-12);
  EXPECT_THAT(shares.chip, AllOf(Ge(0.70), Le(0.85)));
  EXPECT_THAT(shares.tool, AllOf(Ge(0.03), Le(0.10)));
  EXPECT_THAT(shares.workpiece, AllOf(Ge(0.10), Le(0.25)));
}

}  // namespace
}  // namespace thermotwin::thermal
