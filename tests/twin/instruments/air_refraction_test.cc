#include "twin/instruments/air_refraction.h"

#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

// Values printed in the documentation of the package ref-index, which follows the NIST Engineering Metrology Toolbox.
TEST(AirRefraction, AgreesWithTheToolbox) {
  EXPECT_NEAR(1.0 + refractivity({293.15, 101325.0, 0.2}), 1.0002716291691649, 1e-15);
  EXPECT_NEAR(1.0 + refractivity({293.15, 101325.0, 0.8}), 1.0002711197635226, 1e-15);
  EXPECT_NEAR(1.0 + refractivity({333.15, 101325.0, 0.8}), 1.0002339748542823, 1e-15);
}

// physics.md §4.
TEST(AirRefraction, HasTheSensitivitiesOfARoom) {
  AirState const room;
  EXPECT_NEAR(refractivity(room), 2.7137e-4, 0.5e-8);
  double const per_kelvin = refractivity({293.65, 101325.0, 0.5}) - refractivity({292.65, 101325.0, 0.5});
  double const per_hpa = (refractivity({293.15, 101375.0, 0.5}) - refractivity({293.15, 101275.0, 0.5}));
  double const per_cent = refractivity({293.15, 101325.0, 0.505}) - refractivity({293.15, 101325.0, 0.495});
  EXPECT_NEAR(per_kelvin, -0.955e-6, 0.5e-9);
  EXPECT_NEAR(per_hpa, 0.268e-6, 0.5e-9);
  EXPECT_NEAR(per_cent, -0.0085e-6, 0.05e-9);
}

// IAPWS-IF97, table 35.
TEST(AirRefraction, SaturationPressureIsThatOfIapws) {
  EXPECT_NEAR(saturation_pressure(300.0), 3536.58941, 1e-4);
  EXPECT_NEAR(saturation_pressure(500.0), 2.63889776e6, 1e-1);
}

}  // namespace
}  // namespace thermotwin::twin
