#include "thermal/preload.h"

#include <gtest/gtest.h>
#include <numbers>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

constexpr double rpm = std::numbers::pi / 30.0;
constexpr double expansion = 11.8e-6;
BallBearing const bearing_7014c{20, 12.3e-3, 90e-3, 15.0 * std::numbers::pi / 180.0, 0.52};

/// F_a/F_a0 of a rigid short-span pair of 7014C at 300 N, whose inner rings are warmer.
template <class S>
S preload_ratio(S const& inner_rise) {
  PairGrowth<S> growth;
  growth.inner = inner_rise;
  S const approach = normal_approach<S>(bearing_7014c, PairArrangement::back_to_back, S(expansion), growth);
  return preload<S>(bearing_7014c, S(300.0), approach) / 300.0;
}

TEST(ContactDeflection, Of7014CAt300NIs2Point83Micrometres) {
  EXPECT_NEAR(ball_load(bearing_7014c, 300.0), 58.0, 0.1);
  EXPECT_NEAR(contact_deflection(bearing_7014c, ball_load(bearing_7014c, 300.0)), 2.83e-6, 0.005e-6);
}

TEST(Preload, GrowsWithTheRingsTemperatureDifference) {
  EXPECT_NEAR(preload_ratio(2.0), 1.5, 0.05);
  EXPECT_NEAR(preload_ratio(5.0), 2.4, 0.05);
  EXPECT_NEAR(preload_ratio(10.0), 4.1, 0.05);
  EXPECT_DOUBLE_EQ(preload_ratio(0.0), 1.0);
}

TEST(Preload, IsLostSmoothly) {
  EXPECT_EQ(preload_ratio(-10.0), 0.0);
  auto const ratio = [](auto const& rise) { return preload_ratio(rise); };
  double const lost = -2.83e-6 / (std::cos(bearing_7014c.contact_angle) * expansion * 39.06e-3);
  expect_continuous_with_slope(ratio, 1.5 * lost, 0.5 * lost);
  expect_slope_is_difference(ratio, 5.0, 1e-4);
  expect_slope_is_difference(ratio, 0.5 * lost, 1e-4);
}

TEST(NormalApproach, HotShaftUnloadsBackToBackAndLoadsFaceToFace) {
  PairGrowth<double> growth;
  growth.shaft_elongation = 10e-6;
  double const o = normal_approach(bearing_7014c, PairArrangement::back_to_back, expansion, growth);
  double const x = normal_approach(bearing_7014c, PairArrangement::face_to_face, expansion, growth);
  EXPECT_NEAR(o, -0.5 * 10e-6 * std::sin(bearing_7014c.contact_angle), 1e-15);
  EXPECT_DOUBLE_EQ(x, -o);
  growth.housing_elongation = 10e-6;
  EXPECT_EQ(normal_approach(bearing_7014c, PairArrangement::back_to_back, expansion, growth), 0.0);
}

TEST(NormalApproach, UniformWarmingOfRingsAndBallsOnlyScalesTheGap) {
  // r_o − r_i = D_b cos α, so that rings and balls of one material and temperature leave α D_b (1 − cos² α) θ.
  PairGrowth<double> growth;
  growth.inner = growth.outer = growth.ball = 10.0;
  double const sine = std::sin(bearing_7014c.contact_angle);
  EXPECT_NEAR(normal_approach(bearing_7014c, PairArrangement::back_to_back, expansion, growth),
              expansion * 12.3e-3 * sine * sine * 10.0, 1e-15);
}

TEST(NormalApproach, CentrifugalGrowthLoadsTheBalls) {
  PairGrowth<double> growth;
  growth.centrifugal = 1e-6;
  EXPECT_NEAR(normal_approach(bearing_7014c, PairArrangement::back_to_back, expansion, growth),
              1e-6 * std::cos(bearing_7014c.contact_angle), 1e-18);
}

TEST(NutApproach, IsTheDifferentialExpansion) { EXPECT_NEAR(nut_approach(11.8e-6, 0.02, 12.0, 2.0), 2.36e-6, 1e-15); }

TEST(LoopGain, IsHeatSlopeOverConductance) { EXPECT_DOUBLE_EQ(loop_gain(5.0, 10.0), 0.5); }

TEST(CentrifugalGrowth, OfAShaft70By22) {
  RotatingRing const shaft{0.011, 0.035, 210e9, 0.29, 7850.0};
  auto const growth = [&](auto const& w) { return centrifugal_growth(shaft, 0.035, w); };
  EXPECT_NEAR(growth(6000 * rpm), 0.16e-6, 0.005e-6);
  EXPECT_NEAR(growth(12000 * rpm), 0.65e-6, 0.005e-6);
  EXPECT_NEAR(growth(24000 * rpm), 2.6e-6, 0.05e-6);
  EXPECT_DOUBLE_EQ(growth(-100.0), growth(100.0));
  expect_slope_is_difference(growth, 628.0, 0.1);
}

TEST(CentrifugalGrowth, OfAThinRingIsRhoOmega2R3OverE) {
  RotatingRing const thin{0.0999, 0.1001, 210e9, 0.3, 7850.0};
  double const w = 1000.0;
  double const membrane = 7850.0 * w * w * 1e-3 / 210e9;
  EXPECT_NEAR(centrifugal_growth(thin, 0.1, w), membrane, 2e-3 * membrane);
}

}  // namespace
}  // namespace thermotwin::thermal
