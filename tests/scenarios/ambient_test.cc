#include "scenarios/ambient.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/refusal.h"

namespace thermotwin::scenarios {
namespace {

using tests::refusal;

constexpr double hour = 3600.0;

double rise(Ambient const& ambient, double t, double start = 8 * hour) {
  return air_temperature(ambient, start, t) - ambient.mean;
}

TEST(AirTemperature, OfStillAirIsItsMean) { EXPECT_EQ(air_temperature({}, 0.0, 1234.5), 293.15); }

TEST(AirTemperature, PeaksOnceADayAtThePeakTime) {
  Ambient ambient;
  ambient.daily_cycle = DailyCycle{1.5, 15 * hour};
  EXPECT_NEAR(rise(ambient, 7 * hour), 1.5, 1e-12);
  EXPECT_NEAR(rise(ambient, 19 * hour), -1.5, 1e-12);
  EXPECT_NEAR(rise(ambient, 31 * hour), 1.5, 1e-12);
  EXPECT_NEAR(rise(ambient, 0.0, 15 * hour), 1.5, 1e-12);
}

TEST(AirTemperature, DriftsSteadily) {
  Ambient ambient;
  ambient.drift = 2.0 / 86400.0;
  EXPECT_NEAR(rise(ambient, 12 * hour), 1.0, 1e-12);
}

TEST(AirTemperature, SwingsWithTheAirConditioning) {
  Ambient ambient;
  ambient.air_conditioning = AirConditioning{0.5, 1200.0};
  EXPECT_EQ(rise(ambient, 0.0), 0.0);
  EXPECT_NEAR(rise(ambient, 300.0), 0.5, 1e-12);
  EXPECT_NEAR(rise(ambient, 900.0), -0.5, 1e-12);
}

TEST(AirTemperature, FallsAndRisesExponentiallyWithTheDoor) {
  Ambient ambient;
  ambient.door_openings = {{1000.0, 600.0, -3.0, 300.0}};
  EXPECT_EQ(rise(ambient, 1000.0), 0.0);
  EXPECT_NEAR(rise(ambient, 1300.0), -3.0 * (1.0 - std::exp(-1.0)), 1e-12);
  double const lowest = -3.0 * (1.0 - std::exp(-2.0));
  EXPECT_NEAR(rise(ambient, 1600.0), lowest, 1e-12);
  EXPECT_NEAR(rise(ambient, 1900.0), lowest * std::exp(-1.0), 1e-12);
  EXPECT_NEAR(rise(ambient, 1600.0 + 1e-6), rise(ambient, 1600.0 - 1e-6), 1e-7);
}

TEST(AirTemperature, IsTheSumOfItsParts) {
  Ambient daily;
  daily.daily_cycle.emplace();
  Ambient drift;
  drift.drift = 1e-4;
  Ambient conditioned;
  conditioned.air_conditioning.emplace();
  Ambient door;
  door.door_openings = {{600.0, 600.0, -3.0, 600.0}, {900.0, 60.0, -1.0, 60.0}};
  Ambient all = daily;
  all.drift = drift.drift;
  all.air_conditioning = conditioned.air_conditioning;
  all.door_openings = door.door_openings;
  for (double t = 0.0; t < 4 * hour; t += 97.0) {
    EXPECT_NEAR(rise(all, t), rise(daily, t) + rise(drift, t) + rise(conditioned, t) + rise(door, t), 1e-11);
  }
}

TEST(Door, IsOpenFromItsTimeToItsEnd) {
  Ambient ambient;
  ambient.door_openings = {{100.0, 50.0, -3.0, 60.0}, {300.0, 50.0, -3.0, 60.0}};
  EXPECT_FALSE(door_open(ambient, std::nextafter(100.0, 0.0)));
  EXPECT_TRUE(door_open(ambient, 100.0));
  EXPECT_FALSE(door_open(ambient, 150.0));
  EXPECT_TRUE(door_open(ambient, 349.0));
}

TEST(Ambient, RefusesTimesThatCannotBe) {
  auto const refused = [](Ambient const& ambient) { return refusal([&] { check(ambient, 0.0, 3600.0); }); };
  Ambient ambient;
  ambient.air_conditioning = AirConditioning{0.5, 0.0};
  EXPECT_EQ(refused(ambient), "ambient.air_conditioning.period: 0 min must be above 0 s");
  ambient = {};
  ambient.door_openings = {{0.0, 60.0, -3.0, 60.0}, {-60.0, 60.0, -3.0, 60.0}};
  EXPECT_EQ(refused(ambient), "ambient.door_openings[1].time: -1 min is before the start of the run");
  ambient.door_openings = {{0.0, 0.0, -3.0, 60.0}};
  EXPECT_EQ(refused(ambient), "ambient.door_openings[0].duration: 0 min must be above 0 s");
  ambient.door_openings = {{0.0, 60.0, -3.0, -60.0}};
  EXPECT_EQ(refused(ambient), "ambient.door_openings[0].time_constant: -1 min must be above 0 s");
}

TEST(Ambient, IsThatOfARoomInWhichPeopleWork) {
  Ambient ambient;
  ambient.mean = 22.0;
  EXPECT_EQ(refusal([&] { check(ambient, 0.0, 3600.0); }), "ambient.mean: 22 K; allowed is -50 degC to 80 degC");
  ambient.mean = 273.15 + 2200.0;
  EXPECT_EQ(refusal([&] { check(ambient, 0.0, 3600.0); }), "ambient.mean: 2200 degC; allowed is -50 degC to 80 degC");
  ambient.mean = 273.15 + 45.0;
  EXPECT_EQ(refusal([&] { check(ambient, 0.0, 3600.0); }), "accepted");
  ambient.drift = 1.0 / 60.0;
  EXPECT_EQ(refusal([&] { check(ambient, 0.0, 1800.0); }), "accepted");
  EXPECT_THAT(refusal([&] { check(ambient, 0.0, 3.0 * 3600.0); }), testing::StartsWith("ambient: the air reaches 80."));
  ambient.drift = 0.0;
  ambient.door_openings = {{600.0, 3600.0, -200.0, 300.0}};
  EXPECT_THAT(refusal([&] { check(ambient, 0.0, 3.0 * 3600.0); }),
              testing::StartsWith("ambient.door_openings[0].step: the air reaches 118."));
}

}  // namespace
}  // namespace thermotwin::scenarios
