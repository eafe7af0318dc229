#include "thermal/smooth.h"

#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

TEST(SmoothAbs, IsTheMagnitudeAwayFromZeroAndFlatAtZero) {
  EXPECT_NEAR(smooth_abs(-3.0, 0.01), 3.0, 1e-4);
  EXPECT_EQ(slope_of([](auto const& x) { return smooth_abs(x, 0.01); }, 0.0), 0.0);
}

TEST(VanishingPower, IsExactlyZeroAtRest) {
  for (double const exponent : {0.5, 0.8, 1.0, 1.5, 2.0, 3.0}) {
    auto const f = [&](auto const& x) { return vanishing_power(x, exponent, 1e-3); };
    EXPECT_EQ(f(0.0), 0.0);
    EXPECT_EQ(slope_of(f, 0.0), 0.0);
    EXPECT_NEAR(f(-2.0), std::pow(2.0, exponent), 1e-6);
    expect_continuous_with_slope(f, -0.01, 0.01);
    expect_slope_is_difference(f, 0.3, 1e-5);
  }
}

TEST(SmoothMax, IsTheLargerOneUpToHalfEpsilon) {
  EXPECT_NEAR(smooth_max(5.0, 1.0, 0.1), 5.0, 1e-3);
  EXPECT_DOUBLE_EQ(smooth_max(2.0, 2.0, 0.1), 2.05);
  expect_continuous_with_slope([](auto const& x) { return smooth_max<std::decay_t<decltype(x)>>(x, 1.0, 0.05); }, 0.0,
                               2.0);
}

TEST(SmoothPositive, StaysPositiveFarBelowZero) {
  auto const f = [](auto const& x) { return smooth_positive(x, 1e-7); };
  EXPECT_GT(f(-1.0), 0.0);
  EXPECT_NEAR(f(-1.0), 2.5e-15, 1e-20);
  EXPECT_NEAR(f(1.0), 1.0, 1e-14);
  EXPECT_DOUBLE_EQ(f(0.0), 0.5e-7);
  expect_continuous_with_slope(f, -1e-6, 1e-6);
  expect_slope_is_difference(f, -1e-6, 1e-10);
}

TEST(ChangeOfRegime, TakesEachLawOnItsSide) {
  auto const f = [](auto const& x) {
    using S = std::decay_t<decltype(x)>;
    return change_of_regime<S>(S(1.0), S(3.0), x, 100.0);
  };
  EXPECT_DOUBLE_EQ(f(100.0), 2.0);
  EXPECT_NEAR(f(50.0), 1.0, 1e-4);
  EXPECT_NEAR(f(200.0), 3.0, 1e-8);
  EXPECT_NEAR((f(115.0) - f(85.0)) / 2.0, 0.9, 0.01);
  expect_smooth_switch(f, 100.0);
}

TEST(Continuity, HelperSeesJumpsAndKinks) {
  auto const kink = [](auto const& x) { return x.value < 1.0 ? x : 2.0 * x - 1.0; };
  auto const jump = [](auto const& x) { return x.value < 1.0 ? x : x + 1e-3; };
  Roughness const coarse_kink = roughness(kink, 0.5, 2.0, 2000);
  Roughness const fine_kink = roughness(kink, 0.5, 2.0, 16000);
  EXPECT_NEAR(fine_kink.slope, coarse_kink.slope, 1e-12);
  EXPECT_GT(roughness(jump, 0.5, 2.0, 16000).value, 0.3 * roughness(jump, 0.5, 2.0, 2000).value);
}

TEST(Dual, Expm1AgreesWithItsDifference) {
  expect_slope_is_difference(
      [](auto const& x) {
        using std::expm1;
        return expm1(x);
      },
      0.7, 1e-5);
}

}  // namespace
}  // namespace thermotwin::thermal
