#include "thermal/lubricant.h"

#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"
#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

double oil_mm2_per_s(int grade, double celsius) {
  return 1e6 * viscosity(mineral_oil_viscosity(grade), celsius + zero_celsius);
}

struct GoldenOil {
  int grade;
  double at_20, at_30, at_40, at_50, at_60, at_80, tolerance;
};

class VogelCameron : public testing::TestWithParam<GoldenOil> {};

TEST_P(VogelCameron, GivesTheTableOfPhysics1_3) {
  GoldenOil const& o = GetParam();
  EXPECT_NEAR(oil_mm2_per_s(o.grade, 20), o.at_20, 10 * o.tolerance);
  EXPECT_NEAR(oil_mm2_per_s(o.grade, 30), o.at_30, 10 * o.tolerance);
  EXPECT_NEAR(oil_mm2_per_s(o.grade, 40), o.at_40, o.tolerance);
  EXPECT_NEAR(oil_mm2_per_s(o.grade, 50), o.at_50, o.tolerance);
  EXPECT_NEAR(oil_mm2_per_s(o.grade, 60), o.at_60, o.tolerance);
  EXPECT_NEAR(oil_mm2_per_s(o.grade, 80), o.at_80, o.tolerance);
}

INSTANTIATE_TEST_SUITE_P(Grades, VogelCameron,
                         testing::Values(GoldenOil{10, 22.5, 14.6, 10.1, 7.3, 5.6, 3.5, 0.051},
                                         GoldenOil{22, 58.1, 34.5, 22.2, 15.1, 10.8, 6.2, 0.051},
                                         GoldenOil{32, 91.5, 52.2, 32.3, 21.4, 14.9, 8.2, 0.051},
                                         GoldenOil{68, 229.0, 120.0, 69.2, 43.0, 28.5, 14.3, 0.051}));

TEST(VogelCameronLaw, EveryGradeHasItsNominalViscosityAt40Celsius) {
  for (int const grade : iso_viscosity_grades) EXPECT_NEAR(oil_mm2_per_s(grade, 40), grade, 0.1 * grade) << grade;
}

TEST(VogelCameronLaw, FallsBy4Point8PercentPerKelvinForVg22At30Celsius) {
  Vogel const oil = mineral_oil_viscosity(22);
  auto const nu = [&](auto const& T) { return viscosity(oil, T); };
  EXPECT_NEAR(slope_of(nu, 303.15) / nu(303.15), -748.0 / (125.0 * 125.0), 1e-12);
  EXPECT_NEAR(slope_of(nu, 303.15) / nu(303.15), -0.048, 5e-4);
  expect_slope_is_difference(nu, 303.15, 0.01);
}

TEST(VogelCameronLaw, CoefficientFormIsTheSame) {
  EXPECT_DOUBLE_EQ(vogel_cameron_viscosity(0.087e-6, 748.0, 320.0), viscosity(mineral_oil_viscosity(22), 320.0));
  // visc_vc of reference/net.py
  EXPECT_NEAR(vogel_cameron_viscosity(0.087e-6, 748.0, 313.15), 2.2173404615316918e-05, 1e-17);
  expect_slope_is_difference(
      [](auto const& B) {
        using S = std::decay_t<decltype(B)>;
        return vogel_cameron_viscosity<S>(S(0.087e-6), B, S(313.15));
      },
      748.0, 0.1);
}

TEST(VogelCameronLaw, UnknownGradeIsRefusedWithTheKnownOnes) {
  try {
    (void)mineral_oil_viscosity(20);
    FAIL() << "accepted";
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(), "no oil of ISO viscosity grade 20; known: 10, 15, 22, 32, 46, 68, 100");
  }
}

TEST(Andrade, GoesThroughBothPoints) {
  Vogel const law = andrade_through(2.2e-6, 293.15, 1.3e-6, 313.15);
  EXPECT_NEAR(viscosity(law, 293.15), 2.2e-6, 1e-18);
  EXPECT_NEAR(viscosity(law, 313.15), 1.3e-6, 1e-18);
}

TEST(Walther, GoesThroughBothPointsAndStaysNearVogelBetween) {
  Vogel const vogel = mineral_oil_viscosity(32);
  Walther const law = walther_through(viscosity(vogel, 313.15), 313.15, viscosity(vogel, 373.15), 373.15);
  EXPECT_NEAR(viscosity(law, 313.15), viscosity(vogel, 313.15), 1e-15);
  EXPECT_NEAR(viscosity(law, 373.15), viscosity(vogel, 373.15), 1e-15);
  EXPECT_NEAR(viscosity(law, 343.15), viscosity(vogel, 343.15), 0.02 * viscosity(vogel, 343.15));
  expect_slope_is_difference([&](auto const& T) { return viscosity(law, T); }, 330.0, 0.01);
}

}  // namespace
}  // namespace thermotwin::thermal
