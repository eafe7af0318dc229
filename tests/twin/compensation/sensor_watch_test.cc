#include "twin/compensation/sensor_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

/// A minute between readings, stale after 3, stuck after 5.
WatchSettings const settings{180.0, 300.0, 0.3, 0.02, 0.0, 100.0};

class Watched : public testing::Test {
 protected:
  SensorFault after(double value) {
    time_ += 60.0;
    EXPECT_TRUE(watch_.take(value, time_));
    return watch_.fault(time_);
  }
  /// Readings that rise by 0.6 K/min, half of what is possible.
  void warm_up(int minutes) {
    for (int i = 0; i < minutes; ++i) EXPECT_EQ(after(value_ += 0.6), SensorFault::none);
  }

  SensorWatch watch_{settings};
  double time_ = 0.0, value_ = 20.0;
};

TEST_F(Watched, BelievesWhatTheBodyCanDo) {
  warm_up(60);
  EXPECT_DOUBLE_EQ(watch_.value(), value_);
}

TEST_F(Watched, IsMissingUntilItsFirstReading) {
  EXPECT_EQ(watch_.fault(0.0), SensorFault::missing);
  EXPECT_FALSE(watch_.ever_read());
}

TEST_F(Watched, IsMissingWhileItSaysSo) {
  warm_up(3);
  EXPECT_EQ(after(std::nan("")), SensorFault::missing);
  EXPECT_DOUBLE_EQ(watch_.value(), value_);
  EXPECT_EQ(after(value_ + 1.0), SensorFault::none);
}

TEST_F(Watched, IsStaleWhenNothingComes) {
  warm_up(3);
  EXPECT_EQ(watch_.fault(time_ + 180.0), SensorFault::none);
  EXPECT_EQ(watch_.fault(time_ + 181.0), SensorFault::stale);
  EXPECT_DOUBLE_EQ(watch_.fault_since(time_ + 181.0), time_);
  time_ += 240.0;
  EXPECT_EQ(after(value_ + 2.0), SensorFault::none);
}

TEST_F(Watched, IsStuckAfterTheSameNumberForLong) {
  warm_up(3);
  double const since = time_;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(after(value_), SensorFault::none);
  EXPECT_EQ(after(value_), SensorFault::stuck);
  EXPECT_DOUBLE_EQ(watch_.fault_since(time_), since);
  EXPECT_EQ(after(value_ + 1.0), SensorFault::none);
}

TEST_F(Watched, IsOutOfRangeAtBothEnds) {
  warm_up(3);
  for (double const value : {-0.1, 100.1, 1e308, -1e308}) EXPECT_EQ(after(value), SensorFault::out_of_range);
  EXPECT_EQ(after(value_ + 0.5), SensorFault::none);
}

TEST_F(Watched, OnlyALeapBackEndsAJump) {
  warm_up(3);
  EXPECT_EQ(after(value_ + 5.0), SensorFault::jump);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(after(value_ + 5.0 + 0.01 * i), SensorFault::jump) << i;
  EXPECT_EQ(after(value_ + 0.3), SensorFault::none);
}

TEST_F(Watched, ASpikeIsOneReadingLong) {
  warm_up(3);
  EXPECT_EQ(after(value_ - 10.0), SensorFault::jump);
  EXPECT_EQ(after(value_), SensorFault::none);
  warm_up(3);
}

TEST_F(Watched, AReadingThatIsMissingOrOutOfRangeEndsNoJump) {
  warm_up(3);
  for (double const none : {std::nan(""), 850.0}) {
    for (int i = 0; i < 10; ++i) EXPECT_EQ(after(value_ + 5.0 + 0.01 * i), SensorFault::jump) << i;
    EXPECT_NE(after(none), SensorFault::none);
    EXPECT_EQ(after(value_ + 5.0), SensorFault::jump) << none;
  }
  EXPECT_DOUBLE_EQ(watch_.value(), value_);
  EXPECT_EQ(after(value_), SensorFault::none);
}

TEST_F(Watched, ALeapFurtherAwayOrHalfBackEndsNoJump) {
  warm_up(3);
  for (double const wrong : {5.0, 2.5, 10.0, 5.0, -5.0})
    for (int i = 0; i < 10; ++i) EXPECT_EQ(after(value_ + wrong + 0.01 * i), SensorFault::jump) << wrong << " " << i;
  EXPECT_DOUBLE_EQ(watch_.value(), value_);
  EXPECT_EQ(after(value_), SensorFault::none);
}

TEST_F(Watched, ALooseContactIsNotBelieved) {
  warm_up(3);
  for (double const any : {85.0, value_ + 2.0, 60.0, value_ - 7.0, 90.0})
    EXPECT_EQ(after(any), SensorFault::jump) << any;
  EXPECT_EQ(after(value_), SensorFault::none);
}

TEST_F(Watched, ASensorThatWasPulledOutAndReadsRightAgainIsBelieved) {
  warm_up(3);
  EXPECT_EQ(after(value_ + 5.0), SensorFault::jump);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(after(std::nan("")), SensorFault::missing);
  EXPECT_EQ(after(value_ + 0.5), SensorFault::none);
}

/// As a worn connector does: its sensor goes on with the body, off by as much as it leapt.
TEST_F(Watched, ALeapBackCountsFromWhereTheBodyIsMeanwhile) {
  warm_up(3);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(after((value_ += 0.2) + 5.0), SensorFault::jump);
  EXPECT_EQ(after(value_ += 0.2), SensorFault::none);
  warm_up(3);
}

/// As a sensor does that shows 85 degC without its supply.
TEST_F(Watched, MostOfTheWayBackIsEnoughForAReadingThatStays) {
  warm_up(3);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(after(85.0), SensorFault::jump);
  value_ += 6.0;
  EXPECT_EQ(after(value_), SensorFault::jump);
  warm_up(3);
}

/// 1.5 K in a minute is no leap yet.
TEST_F(Watched, WhatOnlyJustLeaptComesBackWithLessThanALeap) {
  warm_up(3);
  EXPECT_EQ(after(value_ + 1.6), SensorFault::jump);
  EXPECT_EQ(after(value_ + 1.6), SensorFault::jump);
  EXPECT_EQ(after(value_ + 0.2), SensorFault::none);
}

TEST_F(Watched, RefusesTimesThatAreNotLater) {
  warm_up(3);
  EXPECT_FALSE(watch_.take(50.0, time_));
  EXPECT_FALSE(watch_.take(50.0, time_ - 1.0));
  EXPECT_FALSE(watch_.take(50.0, -1e300));
  EXPECT_DOUBLE_EQ(watch_.value(), value_);
  EXPECT_EQ(watch_.fault(time_), SensorFault::none);
}

TEST(InputWatch, LetsInputsLeapAndStandStill) {
  SensorWatch watch(WatchSettings::for_inputs(60.0));
  double time = 0.0;
  for (double const value : {0.0, 4500.0, 4500.0, -1e300, 1e300, 0.0, 0.0}) {
    ASSERT_TRUE(watch.take(value, time += 50.0));
    EXPECT_EQ(watch.fault(time), SensorFault::none) << value;
  }
  EXPECT_EQ(watch.fault(time + 61.0), SensorFault::stale);
}

/// --highest "120 K" is -153.15 degC: every reading would be out of range.
TEST(SensorWatch, RefusesARangeUpsideDown) {
  EXPECT_THAT(([] {
                SensorWatch const watch({60.0, 600.0, 0.3, 0.02, -20.0, -153.15});
              }),
              testing::ThrowsMessage<thermal::InputError>(testing::HasSubstr(
                  "-20 degC at least and -153.15 degC at most: the highest must be above the lowest")));
}

}  // namespace
}  // namespace thermotwin::twin
