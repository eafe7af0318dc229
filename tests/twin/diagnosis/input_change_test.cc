#include "twin/diagnosis/input_change.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

using scenarios::SampledInput;
using testing::ElementsAre;

std::vector<InputChange> changes_in(SampledInput const& input) {
  return changes_of(input, scenarios::driven_channel(input).signal);
}

std::vector<double> times_of(std::vector<InputChange> const& changes) {
  std::vector<double> times;
  for (auto const& change : changes) times.push_back(change.time);
  return times;
}

/// Every minute, the speed of four blocks of ten minutes each.
SampledInput four_blocks() {
  SampledInput input{.name = "spindle.speed", .unit = "rad/s", .times = {}, .values = {}};
  for (int minute = 0; minute < 40; ++minute) {
    input.times.push_back(60.0 * minute);
    input.values.push_back(std::vector{100.0, 400.0, 0.0, 300.0}[std::size_t(minute / 10)]);
  }
  return input;
}

TEST(InputChange, WasAtAnyMomentSinceTheSampleBefore) {
  auto const changes = changes_in(four_blocks());
  EXPECT_THAT(times_of(changes), ElementsAre(600.0, 1200.0, 1800.0));
  for (auto const& change : changes) EXPECT_EQ(change.earlier, 60.0);
  EXPECT_DOUBLE_EQ(changes[0].size, 0.75);
  EXPECT_DOUBLE_EQ(changes[1].size, 1.0);
}

TEST(InputChange, WasAtAnyMomentInWhichNothingWasRecorded) {
  auto input = four_blocks();
  input.values[18] = input.values[19] = NAN;
  auto const changes = changes_in(input);
  EXPECT_EQ(changes[1].time, 1200.0);
  EXPECT_EQ(changes[1].earlier, 180.0);
}

/// A list of blocks: each row is a change, at its time.
TEST(InputChange, IsKnownWhereOnlyChangesAreRecorded) {
  SampledInput const input{"spindle.speed", "rad/s", {0.0, 600.0, 1200.0, 1800.0}, {100.0, 400.0, 0.0, 300.0}};
  EXPECT_THAT(changes_in(input), testing::IsEmpty());
}

/// The same with a row every 100 s between.
TEST(InputChange, IsKnownWhereRowsAtRegularTimesStandBetweenThoseOfChanges) {
  SampledInput input{"spindle.speed", "rad/s", {}, {}};
  double speed = 0.0;
  for (int second = 0; second <= 14400; ++second) {
    bool const changes = second % 290 == 77 || second % 290 == 201;
    if (changes) speed = speed > 0.0 ? 0.0 : 300.0 + second % 7;
    if (!changes && second % 100 != 0) continue;
    input.times.push_back(second);
    input.values.push_back(speed);
  }
  ASSERT_LT(2 * scenarios::driven_channel(input).signal.jumps().size(), input.times.size());
  EXPECT_THAT(changes_in(input), testing::IsEmpty());
}

/// Most rows of a quiet day are those at regular times.
TEST(InputChange, IsKnownWhereFewOfManyRowsAreOfChanges) {
  SampledInput input{"spindle.speed", "rad/s", {}, {}};
  for (int second = 0; second <= 14400; ++second) {
    if (second % 300 != 0 && second % 3600 != 2005) continue;
    input.times.push_back(second);
    input.values.push_back((second + 3600 - 2005) / 3600 % 2 == 0 ? 0.0 : 300.0);
  }
  ASSERT_EQ(scenarios::driven_channel(input).signal.jumps().size(), 4U);
  EXPECT_THAT(changes_in(input), testing::IsEmpty());
}

TEST(InputChange, OfSeveralInputsAtOneMomentIsOne) {
  auto const changes = merged({{600.0, 10.0, 0.5}, {1200.0, 10.0, 1.0}, {600.0, 60.0, 0.25}});
  EXPECT_THAT(times_of(changes), ElementsAre(600.0, 1200.0));
  EXPECT_EQ(changes[0].earlier, 60.0);
  EXPECT_EQ(changes[0].size, 0.75);
}

TEST(InputChange, OfTooManyTheLargestStay) {
  auto const changes = merged({{600.0, 60.0, 0.1}, {1200.0, 60.0, 1.0}, {1800.0, 10.0, 1.0}, {2400.0, 60.0, 0.5}}, 2);
  EXPECT_THAT(times_of(changes), ElementsAre(1200.0, 2400.0));
}

}  // namespace
}  // namespace thermotwin::twin
