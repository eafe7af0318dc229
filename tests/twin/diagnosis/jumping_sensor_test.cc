#include "twin/diagnosis/jumping_sensor.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <set>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/expected_noise.h"

namespace thermotwin::twin {
namespace {

/// What is told of readings that are off by that from 2 h on and take two minutes over it, as a sensor does that lags.
/// `gap`: nothing was read for twenty minutes about then.
std::optional<FaultySensor> jumping(Value const& truth, std::set<std::string> const& sensors, double by,
                                    bool gap = false) {
  constexpr double begin = 7200.0, lag = 40.0;
  auto run = tests::measured(truth, tests::two_speeds());
  for (auto& channel : run.channels)
    for (Eigen::Index i = 0; i < run.time.size() && sensors.contains(channel.name); ++i) {
      double const after = run.time[i] - begin;
      if (after > 0.0) channel.values[i] += by * -std::expm1(-after / lag);
      if (gap && std::abs(after) < 600.0) channel.values[i] = std::numeric_limits<double>::quiet_NaN();
    }
  tests::add_noise(run, 0.02, 0.05e-6, 11);
  std::vector<BinnedRun> const data = {bin(run, 300.0)};
  auto const estimation = expected_estimation(tests::v450(), data);
  return jumping_sensor(Machine::build(tests::v450()), estimation, estimation.fit(estimation.prior_mean()), 11.0);
}

TEST(JumpingSensor, IsNoneOfAHealthyMachine) { EXPECT_FALSE(jumping(tests::v450(), {}, 0.0)); }

/// No sample shows it: within each minute it goes a part of the way. Calibration follows it by some.
TEST(JumpingSensor, IsOneThatTakesMinutesOverIt) {
  auto const sensor = jumping(tests::v450(), {"T6"}, 0.8);
  ASSERT_TRUE(sensor);
  EXPECT_EQ(sensor->name, "T6");
  EXPECT_THAT(sensor->what,
              testing::MatchesRegex(
                  "jumps by 0\\.[5-9] K at 2\\.0 h of hidden and stays off, though what it touches does not"));
}

TEST(JumpingSensor, IsFoundAcrossAGap) {
  auto const sensor = jumping(tests::v450(), {"T6"}, -2.0, true);
  ASSERT_TRUE(sensor);
  EXPECT_EQ(sensor->name, "T6");
}

/// What pulls at two is no sensor's fault.
TEST(JumpingSensor, IsNoneWhereTwoJump) { EXPECT_FALSE(jumping(tests::v450(), {"T3", "T6"}, 0.8)); }

/// The room's air does so when a door is opened.
TEST(JumpingSensor, IsNoneInTheAir) { EXPECT_FALSE(jumping(tests::v450(), {"T10"}, 0.8)); }

/// Heat that is switched on all at once warms a body slowly.
TEST(JumpingSensor, IsNoneWhereABodyIsHeatedAllAtOnce) {
  EXPECT_FALSE(jumping(tests::with_table(tests::v450(), R"(
    [[heat]]
    name = "heater"
    at = "head_rear"
    power = "60 W"
    while_on = "spindle.running")"),
                       {}, 0.0));
}

}  // namespace
}  // namespace thermotwin::twin
