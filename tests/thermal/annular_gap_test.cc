#include "thermal/annular_gap.h"

#include <gtest/gtest.h>
#include <numbers>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

constexpr double rpm = std::numbers::pi / 30.0;

template <class S>
S motor_gap(S const& speed) {  // r 60 mm, δ 0.4 mm, air at 40 °C
  return annular_gap_film<S>(S(313.15), S(313.15), S(0.060), S(0.4e-3), speed);
}

TEST(AnnularGap, GivesTheNumbersOfPhysics2_8) {
  EXPECT_NEAR(motor_gap(6000 * rpm), 92.0, 0.5);
  EXPECT_NEAR(jungnickel_gap_film(0.060, 0.4e-3, 6000 * rpm), 116.0, 1.0);
}

TEST(AnnularGap, OnlyConductsAtRest) {
  EXPECT_NEAR(motor_gap(0.0), properties(Air{}, 313.15).conductivity / 0.4e-3, 1e-6);
  EXPECT_EQ(jungnickel_gap_film(0.060, 0.4e-3, 0.0), 0.0);
}

TEST(AnnularGap, IsSmoothAcrossEveryChangeOfRegime) {
  auto const nusselt = [](auto const& ta) {
    using S = std::decay_t<decltype(ta)>;
    return annular_gap_nusselt<S>(ta, S(0.71));
  };
  expect_smooth_switch(nusselt, vortex_taylor);
  expect_smooth_switch(nusselt, turbulent_vortex_taylor);
  EXPECT_NEAR(nusselt(10.0), 2.0, 0.01);
  EXPECT_NEAR(nusselt(65.0), 0.202 * std::pow(65.0, 0.63) * std::pow(0.71, 0.27), 0.002);
  EXPECT_NEAR(nusselt(200.0), 0.386 * std::sqrt(200.0) * std::pow(0.71, 0.27), 1e-6);
}

TEST(AnnularGap, BeckerAndKayeIsSmoothAndClose) {
  auto const nusselt = [](auto const& ta) { return becker_kaye_nusselt(ta); };
  expect_smooth_switch(nusselt, std::sqrt(becker_kaye_vortex));
  expect_smooth_switch(nusselt, std::sqrt(becker_kaye_turbulent_vortex));
  for (double const ta : {20.0, 70.0, 300.0})
    EXPECT_NEAR(nusselt(ta), annular_gap_nusselt(ta, 0.71), 0.15 * nusselt(ta)) << ta;
}

TEST(AnnularGap, HasExactSlopes) {
  auto const over_speed = [](auto const& w) { return motor_gap(w); };
  auto const over_temperature = [](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return annular_gap_film<S>(T, S(300.0), S(0.060), S(0.4e-3), S(600.0));
  };
  auto const jungnickel = [](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return jungnickel_gap_film<S>(S(0.060), S(0.4e-3), w);
  };
  expect_slope_is_difference(over_speed, 600.0, 0.01);
  expect_slope_is_difference(over_speed, 320.0, 1e-3);
  expect_slope_is_difference(over_temperature, 330.0, 0.01);
  expect_slope_is_difference(jungnickel, 600.0, 0.01);
  EXPECT_DOUBLE_EQ(over_speed(-600.0), over_speed(600.0));
  expect_continuous_with_slope(jungnickel, -0.01, 0.01);
}

}  // namespace
}  // namespace thermotwin::thermal
