#include "thermal/rolling_contact.h"

#include <gtest/gtest.h>
#include <numbers>

#include "tests/thermal/smoothness.h"
#include "thermal/ball_conductance.h"

namespace thermotwin::thermal {
namespace {

constexpr double rpm = std::numbers::pi / 30.0;
BallBearing const bearing_7014c{20, 12.3e-3, 90e-3, 15.0 * std::numbers::pi / 180.0, 0.52};
BallNut const nut_40x10{40e-3, 10e-3, 6.35e-3, 3.0, std::numbers::pi / 4.0};

ContactOil oil_68() { return {mineral_oil_viscosity(68), 870.0, true}; }

// The expected watts below are the formulas of physics.md §1.5 evaluated once in NumPy.
TEST(RollingFriction, OfAnAngularContactBallBearing) {
  RollingFriction<double> const friction = bearing_contact_friction(bearing_7014c, oil_68(), 300.0);
  EXPECT_NEAR(rolling_friction_heat(friction, 3000 * rpm, 313.15), 174.50606980714696, 1e-9);
  EXPECT_NEAR(rolling_friction_heat(friction, 6000 * rpm, 333.15), 314.25193733717754, 1e-9);
}

TEST(RollingFriction, OfABallNut) {
  EXPECT_NEAR(nut_40x10.balls(), 59.55636168905441, 1e-9);
  auto const single = nut_contact_friction(single_nut_law, nut_40x10, oil_68(), 1500.0);
  auto const twin = nut_contact_friction(double_nut_law, nut_40x10, oil_68(), 1500.0);
  EXPECT_NEAR(rolling_friction_heat(single, 1200 * rpm, 313.15), 55.67174909267205, 1e-9);
  EXPECT_NEAR(rolling_friction_heat(twin, 1200 * rpm, 313.15), 43.543984565127886, 1e-9);
}

TEST(RollingFriction, OfLinearGuides) {
  auto const two = ball_guide_contact_friction(guide_two_point_law, 20, 3e-3, oil_68(), 2000.0);
  auto const four = ball_guide_contact_friction(guide_four_point_law, 20, 3e-3, oil_68(), 2000.0);
  auto const roller = roller_guide_contact_friction(20, 3e-3, 10e-3, oil_68(), 2000.0);
  EXPECT_NEAR(rolling_friction_heat(two, 0.5, 313.15), 0.8517988560692992, 1e-10);
  EXPECT_NEAR(rolling_friction_heat(four, 0.5, 313.15), 2.6226263501047, 1e-10);
  EXPECT_NEAR(rolling_friction_heat(roller, 0.5, 313.15), 2.3148176300328838, 1e-10);
}

TEST(RollingFriction, GrowsWithSpeedToThePower1Point5AndDoublesWithSeals) {
  ContactOil open = oil_68();
  open.sealed = false;
  auto const sealed = nut_contact_friction(single_nut_law, nut_40x10, oil_68(), 1500.0);
  auto const unsealed = nut_contact_friction(single_nut_law, nut_40x10, open, 1500.0);
  double const q1 = rolling_friction_heat(sealed, 50.0, 313.15);
  EXPECT_NEAR(std::log2(rolling_friction_heat(sealed, 100.0, 313.15) / q1), 1.4936, 1e-9);
  EXPECT_NEAR(q1 / rolling_friction_heat(unsealed, 50.0, 313.15), 2.0, 1e-12);
}

TEST(RollingFriction, HasExactSlopesAndNoneAtRest) {
  auto const over_temperature = [](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return rolling_friction_heat<S>(bearing_contact_friction<S>(bearing_7014c, oil_68(), S(300.0)), S(100.0), T);
  };
  auto const over_load = [](auto const& F) {
    using S = std::decay_t<decltype(F)>;
    return rolling_friction_heat<S>(bearing_contact_friction<S>(bearing_7014c, oil_68(), F), S(100.0), S(313.15));
  };
  auto const over_speed = [](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return rolling_friction_heat<S>(bearing_contact_friction<S>(bearing_7014c, oil_68(), S(300.0)), w, S(313.15));
  };
  expect_slope_is_difference(over_temperature, 313.15, 0.01);
  expect_slope_is_difference(over_load, 300.0, 0.1);
  expect_slope_is_difference(over_speed, 100.0, 0.01);
  EXPECT_EQ(over_speed(0.0), 0.0);
  EXPECT_EQ(slope_of(over_speed, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(over_speed(-10.0), over_speed(10.0));
}

TEST(ContactEllipse, OfA7014CAt300N) {
  double const load = 300.0 / (20 * std::sin(bearing_7014c.contact_angle));
  auto const ellipse = race_ellipse(bearing_7014c, bearing_7014c.inner_contact_radius(), load, 208e9 / 0.91);
  EXPECT_NEAR(ellipse.major, 0.59e-3, 0.005e-3);
  EXPECT_NEAR(ellipse.minor, 0.066e-3, 0.0005e-3);
}

TEST(ContactEllipse, IsTheHertzianCircleForTwoSpheres) {
  // two equal spheres of radius R: a³ = 3 F R (1 − ν²)/(4 E), effective radius R/2, E' = E/(1 − ν²)
  double const R = 10e-3, F = 50.0, modulus = 2.3e11;
  auto const ellipse = contact_ellipse(R / 2.0, R / 2.0, F, modulus);
  double const hertz = std::cbrt(3.0 * F * R / (4.0 * modulus));
  EXPECT_NEAR(ellipse.major, hertz, 0.04 * hertz);
  EXPECT_NEAR(ellipse.minor, hertz, 0.04 * hertz);
}

TEST(StaticBallConductance, OfADry7014CIsNegligible) {
  auto const conductance = [](auto const& F) {
    using S = std::decay_t<decltype(F)>;
    return static_ball_conductance<S>(bearing_7014c, F, S(33.0), S(33.0));
  };
  EXPECT_NEAR(conductance(300.0), 0.13, 0.005);
  EXPECT_NEAR(conductance(2400.0) / conductance(300.0), 2.0, 1e-9);  // G ~ F^{1/3}
  expect_slope_is_difference(conductance, 300.0, 0.1);
}

TEST(RotatingBallConductance, Of7014C) {
  EXPECT_NEAR(rotating_ball_conductance(bearing_7014c, 60 * rpm), 3.2, 0.05);
  EXPECT_NEAR(rotating_ball_conductance(bearing_7014c, 2000 * rpm), 4.6, 0.05);
  EXPECT_NEAR(rotating_ball_conductance(bearing_7014c, 6000 * rpm), 5.0, 0.05);
}

TEST(RotatingBallConductance, IsSmoothThroughStandstill) {
  auto const conductance = [](auto const& w) { return rotating_ball_conductance(bearing_7014c, w); };
  EXPECT_GT(conductance(0.0), 0.0);
  EXPECT_EQ(slope_of(conductance, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(conductance(-5.0), conductance(5.0));
  expect_continuous_with_slope(conductance, -5.0, 5.0);
  expect_slope_is_difference(conductance, 100.0, 0.01);
}

RollingElements balls_7014c(bool four_point) {
  RollingElements balls = rolling_elements(bearing_7014c);
  balls.four_point = four_point;
  return balls;
}

double contact_model_7014c(double speed, bool four_point) {
  Vogel const oil = mineral_oil_viscosity(22);
  double const force = 300.0 / (20 * std::sin(bearing_7014c.contact_angle));
  return contact_model_conductance(balls_7014c(four_point), force, 0.13, viscosity(oil, 313.15) * 870.0, speed);
}

TEST(ContactModelConductance, Of7014CIsAFewTenthsOfAWattPerKelvin) {  // NumPy evaluation of physics.md §2.4
  EXPECT_NEAR(contact_model_7014c(60 * rpm, false), 0.5784438254329737, 1e-7);
  EXPECT_NEAR(contact_model_7014c(2000 * rpm, false), 0.6418960404859266, 1e-7);
  EXPECT_NEAR(contact_model_7014c(6000 * rpm, false), 0.46166464210162433, 1e-7);
  EXPECT_NEAR(contact_model_7014c(2000 * rpm, true), 1.0820720809718534, 1e-7);
}

TEST(ContactModelConductance, OfADoubleNutIs2To3WattPerKelvinAt1000Rpm) {
  double const force = 1500.0 / (nut_40x10.balls() * std::sin(nut_40x10.contact_angle));
  double const running = 2 * contact_model_conductance(rolling_elements(nut_40x10), force, 0.13, 0.06, 1000 * rpm);
  double const still = 2 * contact_model_conductance(rolling_elements(nut_40x10), force, 0.13, 0.06, 0.0);
  EXPECT_NEAR(running, 2.5, 0.6);
  EXPECT_NEAR(still, 1.0, 0.3);
}

TEST(ContactModelConductance, IsFiniteAtRestAndHasExactSlopes) {
  auto const over_speed = [](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return contact_model_conductance<S>(balls_7014c(false), S(58.0), S(0.13), S(0.02), w);
  };
  auto const over_force = [](auto const& F) {
    using S = std::decay_t<decltype(F)>;
    return contact_model_conductance<S>(balls_7014c(false), F, S(0.13), S(0.02), S(200.0));
  };
  EXPECT_GT(over_speed(0.0), 20 * 0.05 * 32.8 * 6.15e-3);
  EXPECT_EQ(slope_of(over_speed, 0.0), 0.0);
  expect_slope_is_difference(over_speed, 200.0, 0.01);
  expect_slope_is_difference(over_force, 58.0, 0.01);
  expect_continuous_with_slope(over_speed, -0.01, 0.01);
}

}  // namespace
}  // namespace thermotwin::thermal
