#include "thermal/evaporation.h"

#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

constexpr double celsius(double t) { return t + zero_celsius; }

double per_square_metre(double water) {  // h = 8 W/(m² K), room 22 °C, 50 %
  return evaporation_heat(1.0, 8.0, lewis_factor, celsius(water), celsius(22), 0.5);
}

TEST(SaturationPressure, IsThatOfTheSteamTable) {
  EXPECT_NEAR(saturation_pressure(celsius(0)), 611.2, 1e-9);
  EXPECT_NEAR(saturation_pressure(celsius(20)), 2339.0, 10.0);
  EXPECT_NEAR(saturation_pressure(celsius(40)), 7385.0, 40.0);
  EXPECT_NEAR(saturated_vapour_density(celsius(20)), 0.0173, 1e-4);
}

TEST(Evaporation, GivesTheNumbersOfPhysics2_14) {
  EXPECT_NEAR(per_square_metre(22), 175.0, 3.0);
  EXPECT_NEAR(per_square_metre(25), 240.0, 3.0);
  EXPECT_NEAR(per_square_metre(30), 370.0, 3.0);
}

TEST(Evaporation, IsThatOfSetCsTank) {  // ev() of reference/setC.py at 25 °C: 0.6 m², h 12, factor 0.9
  EXPECT_NEAR(evaporation_heat(0.6, 12.0, 0.9, celsius(25), celsius(22), 0.5), 176.00354017501468, 1e-9);
}

TEST(Evaporation, EndsWhereWaterIsAtTheDewPointAndCondensesBelow) {
  EXPECT_NEAR(evaporation_heat(1.0, 8.0, lewis_factor, celsius(22), celsius(22), 1.0), 0.0, 1e-12);
  EXPECT_LT(per_square_metre(5), 0.0);
}

TEST(Evaporation, CoolsAWetSurface2To5KelvinBelowAmbient) {
  // balance of evaporation, convection and radiation at h = 8 + 5 W/(m² K) in a 50 % room
  auto const surplus = [](double T) { return 13.0 * (22.0 - T) - per_square_metre(T); };
  EXPECT_LT(surplus(20.0), 0.0);
  EXPECT_GT(surplus(16.0), 0.0);
}

TEST(PondEvaporation, AddsFreeAndForcedAsSquares) {
  double const excess = 0.01 * (saturation_pressure(celsius(30)) - 0.5 * saturation_pressure(celsius(22)));
  double const free = 2.7 * 2.0;  // ΔT = 8 K
  EXPECT_NEAR(pond_evaporation_flux(celsius(30), celsius(22), 0.5, 0.0), free * excess, 1e-3);
  EXPECT_NEAR(pond_evaporation_flux(celsius(30), celsius(22), 0.5, 1.0), std::hypot(free, 3.8) * excess, 1e-3);
}

TEST(PondEvaporation, IsSmoothWhereTheWaterIsAsColdAsTheAir) {
  auto const flux = [](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return pond_evaporation_flux<S>(T, S(celsius(22)), S(0.5), S(0.5));
  };
  expect_continuous_with_slope(flux, celsius(21.95), celsius(22.05));
  expect_slope_is_difference(flux, celsius(25), 1e-3);
  expect_slope_is_difference(flux, celsius(18), 1e-3);
}

TEST(Evaporation, SlopesAreExact) {
  expect_slope_is_difference(
      [](auto const& T) {
        using S = std::decay_t<decltype(T)>;
        return evaporation_heat<S>(S(1.0), S(8.0), S(0.9), T, S(295.15), S(0.5));
      },
      300.0, 1e-3);
}

}  // namespace
}  // namespace thermotwin::thermal
