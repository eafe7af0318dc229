#include "twin/instruments/resistance_law.h"

#include <gtest/gtest.h>

#include "thermal/error.h"
#include "thermal/physical_constant.h"

namespace thermotwin::twin {
namespace {

using thermal::zero_celsius;

// Tables of IEC 60751 and of the thermometers made after it.
TEST(Pt100, HasTheResistanceOfTheTable) {
  EXPECT_DOUBLE_EQ(pt100_resistance(zero_celsius), 100.0);
  EXPECT_NEAR(pt100_resistance(100.0 + zero_celsius), 138.5055, 1e-12);
  EXPECT_NEAR(pt100_resistance(-100.0 + zero_celsius), 60.26, 0.005);
  EXPECT_NEAR(pt100_resistance(-200.0 + zero_celsius), 18.52, 0.005);
  EXPECT_NEAR(pt100_resistance(850.0 + zero_celsius), 390.48, 0.005);
}

TEST(Pt100, InverseReturnsTheTemperature) {
  for (double t = -200.0; t <= 850.0; t += 7.0)
    EXPECT_NEAR(pt100_temperature(pt100_resistance(t + zero_celsius)), t + zero_celsius, 1e-9) << t;
}

TEST(Pt100, LawIsContinuousWithItsSlopeAtZero) {
  double const h = 1e-3;
  double const below = pt100_resistance(zero_celsius) - pt100_resistance(zero_celsius - h);
  double const above = pt100_resistance(zero_celsius + h) - pt100_resistance(zero_celsius);
  EXPECT_NEAR(below, above, 1e-9);
}

TEST(Pt100, ClassesAllowWhatTheStandardSays) {
  EXPECT_DOUBLE_EQ(pt100_tolerance("AA").constant + 100.0 * pt100_tolerance("AA").slope, 0.27);
  EXPECT_DOUBLE_EQ(pt100_tolerance("A").constant + 100.0 * pt100_tolerance("A").slope, 0.35);
  EXPECT_DOUBLE_EQ(pt100_tolerance("B").constant + 100.0 * pt100_tolerance("B").slope, 0.8);
  EXPECT_THROW(pt100_tolerance("C"), thermal::InputError);
}

TEST(Thermistor, HasItsNominalResistanceAt25DegreesAndInverts) {
  EXPECT_DOUBLE_EQ(thermistor_resistance(298.15, 10e3, 3435.0), 10e3);
  EXPECT_NEAR(thermistor_resistance(358.15, 10e3, 3435.0), 1451.0, 2.0);  // a common 10 kΩ thermistor of this β
  for (double t = 250.0; t < 400.0; t += 11.0)
    EXPECT_NEAR(thermistor_temperature(thermistor_resistance(t, 5e3, 3950.0), 5e3, 3950.0), t, 1e-10);
}

}  // namespace
}  // namespace thermotwin::twin
