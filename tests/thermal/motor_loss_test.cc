#include "thermal/motor_loss.h"

#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"
#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

TEST(CopperLoss, GrowsWithTemperatureAndCurrentSquared) {
  EXPECT_DOUBLE_EQ(copper_loss(3.0, 0.8, 293.15, 2.0), 9.6);
  EXPECT_NEAR(copper_loss(3.0, 0.8, 393.15, 2.0), 9.6 * 1.39, 1e-12);
  expect_slope_is_difference(
      [](auto const& T) {
        using S = std::decay_t<decltype(T)>;
        return copper_loss<S>(S(3.0), S(0.8), T, S(2.0));
      },
      320.0, 0.1);
}

TEST(Current, OfAnInductionMotorKeepsItsMagnetisingPart) {
  EXPECT_DOUBLE_EQ(permanent_magnet_current(3.2, 1.6), 2.0);
  EXPECT_DOUBLE_EQ(induction_current(3.0, 0.0, 1.6), 3.0);
  EXPECT_DOUBLE_EQ(induction_current(3.0, 6.4, 1.6), 5.0);
  expect_slope_is_difference(
      [](auto const& torque) {
        using S = std::decay_t<decltype(torque)>;
        return induction_current<S>(S(3.0), torque, S(1.6));
      },
      2.0, 1e-4);
}

TEST(BertottiLoss, AddsItsThreeParts) {
  BertottiCoefficients<double> const k{2.0, 0.01, 0.1, 1.8};
  double const f = 50.0, B = 1.2;
  EXPECT_NEAR(bertotti_loss(k, f, B), 2.0 * f * std::pow(B, 1.8) + 0.01 * f * f * B * B + 0.1 * std::pow(f * B, 1.5),
              1e-9);
  EXPECT_EQ(bertotti_loss(k, 0.0, B), 0.0);
  EXPECT_DOUBLE_EQ(bertotti_loss(k, -f, B), bertotti_loss(k, f, B));
  expect_slope_is_difference(
      [](auto const& x) {
        using S = std::decay_t<decltype(x)>;
        return bertotti_loss<S>({S(2.0), S(0.01), S(0.1), S(1.8)}, S(50.0), x);
      },
      1.2, 1e-4);
}

template <class S>
S weakened(S const& r) {
  return iron_loss_with_field_weakening<S>(S(100.0), S(60.0), r, 0.5);
}

TEST(IronLoss, IsThePrototypesPolynomial) {  // Set B: 25 r + 30 r² without its copper
  EXPECT_NEAR(iron_loss(25.0, 30.0, 2.0 / 3.0), 25.0 * 2 / 3 + 30.0 * 4 / 9, 1e-9);
  EXPECT_EQ(iron_loss(25.0, 30.0, 0.0), 0.0);
}

TEST(IronLoss, FieldWeakeningStopsTheSquareLaw) {
  EXPECT_NEAR(weakened(0.25), 100 * 0.25 + 60 * 0.0625, 1e-4);
  EXPECT_NEAR(weakened(1.0), 100 * 0.25 / 1.0 + 60 * 0.25, 0.01);
  EXPECT_NEAR(weakened(0.5), 100 * 0.5 + 60 * 0.25, 0.1);
  EXPECT_EQ(weakened(0.0), 0.0);
  EXPECT_LT(weakened(1.0), weakened(0.5));  // hottest near base speed, as seen on real spindles
}

TEST(IronLoss, FieldWeakeningIsSmooth) {
  auto const loss = [](auto const& r) { return weakened(r); };
  expect_smooth_switch(loss, 0.5);
  expect_continuous_with_slope(loss, -1e-5, 1e-5);
  expect_slope_is_difference(loss, 0.49, 1e-5);
}

TEST(MotorFriction, FollowsItsPower) {
  EXPECT_NEAR(motor_friction_loss(20.0, 0.5, 1.0), 5.0, 1e-9);
  EXPECT_NEAR(motor_friction_loss(20.0, 0.5, 2.0), 2.5, 1e-9);
  EXPECT_EQ(motor_friction_loss(20.0, 0.0, 1.0), 0.0);
}

TEST(RotorSlipLoss, IsSlipTimesAirGapPower) {
  double const slip = 0.02, shaft = 980.0;
  EXPECT_NEAR(rotor_slip_loss(slip, shaft), slip * (shaft / (1 - slip)), 1e-12);
  EXPECT_NEAR(rotor_slip_loss(slip, shaft), 20.0, 1e-12);
}

TEST(MotorLoss, SlopesAreExact) {
  auto const slip = [](auto const& s) {
    using S = std::decay_t<decltype(s)>;
    return rotor_slip_loss<S>(s, S(1000.0));
  };
  auto const friction = [](auto const& r) {
    using S = std::decay_t<decltype(r)>;
    return motor_friction_loss<S>(S(20.0), r, 1.5);
  };
  auto const map = [](auto const& eta) {
    using S = std::decay_t<decltype(eta)>;
    return map_loss<S>(S(900.0), eta, S(50.0));
  };
  expect_slope_is_difference(slip, 0.03, 1e-5);
  expect_slope_is_difference(friction, 0.6, 1e-4);
  expect_slope_is_difference(map, 0.9, 1e-4);
}

TEST(HarmonicsLoss, IsAShareOfIronAndCopper) { EXPECT_DOUBLE_EQ(harmonics_loss(0.15, 60.0, 40.0), 15.0); }

EfficiencyMap sample_map() { return {{0.0, 100.0, 300.0}, {0.0, 10.0}, {0.5, 0.7, 0.6, 0.9, 0.6, 0.8}}; }

TEST(EfficiencyMap, IsBilinearAndConstantOutside) {
  EfficiencyMap const map = sample_map();
  EXPECT_DOUBLE_EQ(map.at(100.0, 10.0), 0.9);
  EXPECT_DOUBLE_EQ(map.at(50.0, 5.0), 0.25 * (0.5 + 0.7 + 0.6 + 0.9));
  EXPECT_DOUBLE_EQ(map.at(200.0, 10.0), 0.85);
  EXPECT_DOUBLE_EQ(map.at(1000.0, 50.0), 0.8);
  EXPECT_DOUBLE_EQ(map.at(-10.0, -1.0), 0.5);
  expect_slope_is_difference(
      [&](auto const& w) {
        using S = std::decay_t<decltype(w)>;
        return map.at<S>(w, S(4.0));
      },
      150.0, 0.1);
}

TEST(EfficiencyMap, RefusesWhatIsNoTable) {
  EXPECT_THROW((void)EfficiencyMap({0.0}, {0.0, 1.0}, {0.5, 0.5}), InputError);
  EXPECT_THROW((void)EfficiencyMap({0.0, 0.0}, {0.0, 1.0}, {0.5, 0.5, 0.5, 0.5}), InputError);
  EXPECT_THROW((void)EfficiencyMap({0.0, 1.0}, {0.0, 1.0}, {0.5, 0.5, 0.5}), InputError);
  EXPECT_THROW((void)EfficiencyMap({0.0, 1.0}, {0.0, 1.0}, {0.5, 0.5, 0.5, 1.5}), InputError);
}

TEST(MapLoss, KeepsTheNoLoadLoss) {
  EXPECT_DOUBLE_EQ(map_loss(0.0, 0.9, 120.0), 120.0);
  EXPECT_NEAR(map_loss(900.0, 0.9, 120.0), 220.0, 1e-12);
}

}  // namespace
}  // namespace thermotwin::thermal
