#include "thermal/coolant.h"

#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

TEST(TankHeat, AddsItsParts) {
  TankBalance<double> const tank{100.0, 450.0, 7.0, 95.0};
  EXPECT_DOUBLE_EQ(tank_heat(tank, 300.0, 303.0, 295.0, 298.0, 120.0, 200.0),
                   300.0 + 450.0 - 35.0 - 190.0 - 120.0 - 200.0);
}

TEST(RelaySwitch, ChangesSignAtItsTwoThresholds) {
  EXPECT_LT(relay_switch(false, 295.49, 295.0, 1.0), 0.0);
  EXPECT_GT(relay_switch(false, 295.51, 295.0, 1.0), 0.0);
  EXPECT_LT(relay_switch(true, 294.51, 295.0, 1.0), 0.0);
  EXPECT_GT(relay_switch(true, 294.49, 295.0, 1.0), 0.0);
}

TEST(RelayPeriod, IsHeatingPlusCoolingTime) {
  double const capacity = 40e3, band = 1.0, load = 500.0, cooling = 1500.0;
  EXPECT_NEAR(relay_period(capacity, band, load, cooling), capacity * band / load + capacity * band / (cooling - load),
              1e-9);
  EXPECT_DOUBLE_EQ(relay_swing(capacity, band, 0.0, cooling), band);
  EXPECT_DOUBLE_EQ(relay_swing(capacity, band, 4.0, cooling), 1.15);
}

TEST(InverterChiller, IsProportionalBetweenItsLimits) {
  auto const heat = [](auto const& error) {
    using S = std::decay_t<decltype(error)>;
    return inverter_chiller_heat<S>(error, S(0.0), S(500.0), S(0.1), 2000.0);
  };
  EXPECT_NEAR(heat(2.0), 1000.0, 0.5);
  EXPECT_NEAR(heat(-5.0), 0.0, 0.1);
  EXPECT_NEAR(heat(20.0), 2000.0, 0.1);
  EXPECT_GE(heat(-100.0), 0.0);
  EXPECT_LE(heat(100.0), 2000.0);
  expect_continuous_with_slope(heat, -0.5, 0.5);
  expect_continuous_with_slope(heat, 3.5, 4.5);
  expect_slope_is_difference(heat, 4.01, 1e-5);
  EXPECT_NEAR(inverter_chiller_heat(0.0, 1e4, 500.0, 0.1, 2000.0), 1000.0, 0.5);
}

TEST(TransportDelay, IsVolumeOverFlow) { EXPECT_DOUBLE_EQ(transport_delay(1e-3, 1e-4), 10.0); }

}  // namespace
}  // namespace thermotwin::thermal
