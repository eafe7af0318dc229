#include "thermal/radiation.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

TEST(Radiation, IsTheDifferenceOfFourthPowers) {
  double const expected = 5.670374419e-8 * 0.5 * 2.0 * 0.3 * (std::pow(350.0, 4) - std::pow(300.0, 4));
  EXPECT_NEAR(radiation_heat(0.5, 2.0, 0.3, 300.0, 350.0), expected, 1e-9);
  EXPECT_DOUBLE_EQ(radiation_heat(0.5, 2.0, 0.3, 350.0, 300.0), -radiation_heat(0.5, 2.0, 0.3, 300.0, 350.0));
}

TEST(Radiation, BlackBodiesExchangeAllAndParallelPlatesTheKnownShare) {
  EXPECT_DOUBLE_EQ(exchange_emissivity(1.0, 1.0, 0.4, 0.4), 1.0);
  EXPECT_NEAR(exchange_emissivity(0.9, 0.8, 1.0, 1.0), 1.0 / (1 / 0.9 + 1 / 0.8 - 1), 1e-12);
  EXPECT_NEAR(exchange_emissivity(0.9, 0.8, 1.0, 0.0), 0.72, 1e-12);
}

TEST(Radiation, RoomFilmIs4Point1To4Point7ForPaint) {
  EXPECT_NEAR(room_radiation_film(0.9, 293.15), 4.1, 0.05);
  EXPECT_NEAR(room_radiation_film(0.9, 306.15), 4.7, 0.05);
  double const exact = radiation_film(0.72, 303.15, 293.15);
  EXPECT_NEAR(room_radiation_film(0.9, 298.15), exact, 1e-3 * exact);
}

TEST(Radiation, SlopesAreExact) {
  expect_slope_is_difference(
      [](auto const& T) {
        using S = std::decay_t<decltype(T)>;
        return radiation_heat<S>(S(0.9), S(1.0), S(0.5), T, S(330.0));
      },
      300.0, 0.01);
  expect_slope_is_difference(
      [](auto const& emissivity) {
        using S = std::decay_t<decltype(emissivity)>;
        return exchange_emissivity<S>(emissivity, S(0.8), S(0.6), S(0.5));
      },
      0.7, 1e-4);
}

}  // namespace
}  // namespace thermotwin::thermal
