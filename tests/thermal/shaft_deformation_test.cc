#include "thermal/shaft_deformation.h"

#include <gtest/gtest.h>
#include <numbers>

#include "thermal/dual.h"
#include "thermal/units.h"

namespace thermotwin::thermal {
namespace {

double rpm(double n) { return n * std::numbers::pi / 30.0; }

/// 7014C.
BallBearing spindle_bearing() { return {20, 12.3e-3, 90e-3, 15.0 * std::numbers::pi / 180.0, 0.52}; }

TEST(CentrifugalStrain, ShortensAShaftByMicrometres) {
  RotatingRing const shaft{0.011, 0.035};
  EXPECT_NEAR(0.25 * centrifugal_strain<double>(shaft, rpm(6000)), -0.75e-6, 0.006e-6);
  EXPECT_NEAR(0.25 * centrifugal_strain<double>(shaft, rpm(12000)), -3.0e-6, 0.05e-6);
  EXPECT_NEAR(0.25 * centrifugal_strain<double>(shaft, rpm(24000)), -11.9e-6, 0.05e-6);
}

TEST(CentrifugalStrain, FollowsFromTheWideningOfTheSection) {
  // Without axial force E ε_z = −ν (σ_r + σ_t), and the mean of σ_r + σ_t over a rotating section is its inertia:
  // ∫(σ_r + σ_t) dA = ∫ ρω² r² dA.
  RotatingRing const ring{0.02, 0.05};
  double const w = 800.0;
  int const n = 4000;
  double inertia = 0.0, area = 0.0;
  for (int i = 0; i < n; ++i) {
    double const r = 0.02 + 0.03 * (i + 0.5) / n;
    inertia += 7850.0 * w * w * r * r * r;
    area += r;
  }
  EXPECT_NEAR(centrifugal_strain<double>(ring, w) / (-0.3 / 210e9 * inertia / area), 1.0, 1e-6);
}

TEST(HeldShaft, SharesItsElongationAmongAllThatYields) {
  HeldShaft shaft{200e6, 100e6, 0.0, 0.0};
  EXPECT_NEAR(shaft.front_share(), 1.0 / 3.0, 1e-15);
  shaft.rear_stiffness = 1e-6;
  EXPECT_NEAR(shaft.front_share(), 0.0, 1e-12) << "a floating rear bearing leaves the front one where it is";
  shaft = {200e6, 1e18, 0.0, 0.0};
  EXPECT_NEAR(shaft.front_share(), 1.0, 1e-9) << "a rigid rear bearing makes the whole growth appear in front";
  shaft = {200e6, 100e6, 1.0 / 300e6, 1.0 / 400e6};
  double const force = 10e-6 * shaft.force_per_elongation();
  EXPECT_NEAR(force / 200e6 + force / 100e6 + force / 300e6 + force / 400e6, 10e-6, 1e-18);
}

TEST(SpringPreloadShift, TurnsRadialMismatchIntoAxialByTheAngle) {
  BallBearing b = spindle_bearing();
  double const alpha = 12e-6;
  double const mismatch = alpha * b.inner_contact_radius() * 5.0, ball = alpha * b.ball_diameter * 2.5;
  double const angle = b.contact_angle;
  EXPECT_NEAR(spring_preload_shift<double>(b, alpha, 5.0, 0.0), mismatch / std::tan(angle) + ball / std::sin(angle),
              1e-15);
  EXPECT_GT(spring_preload_shift<double>(b, alpha, 5.0, 0.0), 0.0);
  auto const shift = spring_preload_shift<Dual<2>>(b, alpha, Dual<2>::variable(5.0, 0), Dual<2>::variable(2.0, 1));
  EXPECT_NEAR(shift.partial[0] * 5.0 + shift.partial[1] * 2.0, shift.value, 1e-18) << "linear in both temperatures";
}

TEST(CentrifugalBallShift, IsMicrometresAtSpindleSpeed) {
  BallBearing const b = spindle_bearing();
  EXPECT_NEAR(centrifugal_ball_shift(b, 300.0, 0.0), 0.0, 1e-15);
  double last = 0.0;
  for (double n : {3000.0, 6000.0, 12000.0, 18000.0}) {
    double const shift = centrifugal_ball_shift(b, 300.0, rpm(n));
    EXPECT_GT(shift, last);
    last = shift;
  }
  EXPECT_GT(centrifugal_ball_shift(b, 300.0, rpm(6000)), 1e-6);
  EXPECT_LT(last, 30e-6);
}

TEST(CentrifugalBallShift, IsLessWithLightBallsAndHighPreload) {
  BallBearing const b = spindle_bearing();
  double const steel = centrifugal_ball_shift(b, 300.0, rpm(6000));
  EXPECT_LT(centrifugal_ball_shift(b, 300.0, rpm(6000), 3200.0), 0.6 * steel);
  EXPECT_LT(centrifugal_ball_shift(b, 900.0, rpm(6000)), 0.6 * steel);
}

TEST(CentrifugalBallShift, OfHardBallsIsQuadraticInTheAngleThatTheForceOpens) {
  // Both angles part by ε = ½ F_c sin²α/(F_a/z); where the radial spread is kept, the axial one loses l ε²/sin α.
  BallBearing b = spindle_bearing();
  b.conformity = 0.7;
  double const axial = 300.0, a = b.contact_angle;
  double const ball_mass = 7800.0 * std::numbers::pi / 6.0 * std::pow(b.ball_diameter, 3);
  for (double const w : {rpm(250), rpm(500), rpm(1000)}) {
    double const cage = 0.5 * w * (1.0 - b.ball_diameter * std::cos(a) / b.pitch_diameter);
    double const force = 0.5 * ball_mass * b.pitch_diameter * cage * cage;
    double const opening = 0.5 * force * std::sin(a) * std::sin(a) / (axial / b.balls);
    double const expected = 0.2 * b.ball_diameter * opening * opening / std::sin(a);
    EXPECT_NEAR(centrifugal_ball_shift(b, axial, w) / expected, 1.0, 0.04) << w;
  }
}

}  // namespace
}  // namespace thermotwin::thermal
