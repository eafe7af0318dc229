#include "twin/compensation/sensor_watch.h"

#include <cmath>
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
