#include "thermal/seal.h"

#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"
#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

TEST(BearingSeal, FollowsTheSkfConstants) {
  EXPECT_NEAR(bearing_seal("angular contact ball", 0.110).torque(0.080), 1e-3 * (0.014 * 6400 + 10), 1e-12);
  EXPECT_NEAR(bearing_seal("cylindrical roller", 0.110).torque(0.080), 1e-3 * (0.032 * 6400 + 50), 1e-12);
  EXPECT_NEAR(bearing_seal("spherical roller", 0.110).torque(0.080), 1e-3 * (0.057 * 6400 + 50), 1e-12);
}

TEST(BearingSeal, OfADeepGrooveBearingDependsOnItsSize) {
  EXPECT_EQ(bearing_seal("deep groove ball", 0.062).k2, 2.0);
  EXPECT_EQ(bearing_seal("deep groove ball", 0.080).k2, 20.0);
  EXPECT_EQ(bearing_seal("deep groove ball", 0.100).k2, 15.0);
  EXPECT_EQ(bearing_seal("deep groove ball", 0.110).k2, 0.0);
  EXPECT_NEAR(bearing_seal("deep groove ball", 0.062).torque(0.040), 1e-3 * (0.023 * std::pow(40.0, 2.25) + 2), 1e-12);
}

TEST(BearingSeal, UnknownTypeGetsTheNearest) {
  try {
    (void)bearing_seal("spherical rollers", 0.1);
    FAIL() << "accepted";
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(), "no seal torque for bearing type 'spherical rollers'; did you mean 'spherical roller'?");
  }
}

TEST(LipSeal, Is0Point45NmOf80MmAt150NPerM) {
  auto const torque = [](auto const& d) {
    using S = std::decay_t<decltype(d)>;
    return lip_seal_torque<S>(S(0.3), S(150.0), d);
  };
  EXPECT_NEAR(torque(0.080), 0.45, 0.005);
  expect_slope_is_difference(torque, 0.080, 1e-5);
}

TEST(PurgeAir, CoolsAWarmNose) {
  EXPECT_NEAR(purge_air_heat(0.5e-3, 1.19 * 1007.0, 295.15, 315.15), -0.5e-3 * 1.19 * 1007.0 * 20.0, 1e-12);
}

}  // namespace
}  // namespace thermotwin::thermal
