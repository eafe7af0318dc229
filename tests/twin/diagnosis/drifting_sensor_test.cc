#include "twin/diagnosis/drifting_sensor.h"

#include <gtest/gtest.h>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/expected_noise.h"

namespace thermotwin::twin {
namespace {

/// Warm for a while between two rests.
scenarios::Experiment between_rests() {
  return tests::experiment(R"(
    duration = "18 h"
    ambient.mean = "22 degC"
    [spindle]
    blocks = [{duration = "1 h", speed = "0 rpm"}, {duration = "8 h", speed = "5000 rpm"},
              {duration = "9 h", speed = "0 rpm"}])");
}

std::optional<FaultySensor> drifting(Value const& truth) {
  auto run = tests::measured(truth, between_rests());
  tests::add_noise(run, 0.02, 0.05e-6, 11);
  std::vector<BinnedRun> const data = {bin(run, 300.0)};
  Value const document = tests::v450();
  auto const estimation = expected_estimation(document, data);
  return drifting_sensor(estimation, estimation.fit(estimation.prior_mean()),
                         hypotheses(document, Machine::build(document)));
}

TEST(DriftingSensor, IsNoneOfAHealthyMachine) { EXPECT_FALSE(drifting(tests::v450())); }

TEST(DriftingSensor, ShowsWhereTheMachineRests) {
  auto const sensor = drifting(tests::with_table(tests::v450(), R"(
    [[sensor_drift]]
    name = "fault"
    sensor = "T3"
    drift = "-0.4 K/day")"));
  ASSERT_TRUE(sensor);
  EXPECT_EQ(sensor->name, "T3");
  EXPECT_EQ(sensor->what.substr(0, 13), "drifts by -0.") << sensor->what;
}

/// What follows the heat is gone at rest: no drift, however far beyond the noise.
TEST(DriftingSensor, IsNotOneThatTouchesBadly) {
  EXPECT_FALSE(drifting(tests::with_table(tests::v450(), R"(
    [[sensor_contact]]
    name = "fault"
    sensor = "T7"
    air_share = 0.03)")));
}

/// It may as well be the room's record that drifts.
TEST(DriftingSensor, IsNoneInTheAir) {
  EXPECT_FALSE(drifting(tests::with_table(tests::v450(), R"(
    [[sensor_drift]]
    name = "fault"
    sensor = "T10"
    drift = "-0.5 K/day")")));
}

/// One end of a column is warmer than the other for hours: what would be a drift of a sensor on the head is none there.
TEST(DriftingSensor, IsNotToldOfALongCastingAsSoonAsOfAHead) {
  auto const of = [](std::string const& sensor) {
    return drifting(tests::with_table(
        tests::v450(), "[[sensor_drift]]\nname = \"fault\"\nsensor = \"" + sensor + "\"\ndrift = \"0.4 K/day\"\n"));
  };
  ASSERT_TRUE(of("T6"));
  EXPECT_EQ(of("T6")->name, "T6");
  EXPECT_FALSE(of("T9"));
}

/// What pulls at many is no sensor's fault.
TEST(DriftingSensor, IsNoneWhereManySeemToDrift) {
  Value truth = tests::v450();
  for (std::string const sensor : {"T1", "T3", "T6", "T8"})
    truth = tests::with_table(
        truth, "[[sensor_drift]]\nname = \"of_" + sensor + "\"\nsensor = \"" + sensor + "\"\ndrift = \"-0.5 K/day\"\n");
  EXPECT_FALSE(drifting(truth));
}

}  // namespace
}  // namespace thermotwin::twin
