#include "twin/compensation/model_clock.h"

#include <gtest/gtest.h>
#include <random>

namespace thermotwin::twin {
namespace {

TEST(ModelClock, RunsAtItsSpeedFromTheFirstMessage) {
  ModelClock clock(60.0, 30.0);
  EXPECT_FALSE(clock.started());
  EXPECT_TRUE(clock.follow(1000.0, 5.0));
  EXPECT_DOUBLE_EQ(clock.now(5.0), 1000.0);
  EXPECT_DOUBLE_EQ(clock.now(7.0), 1120.0);
}

TEST(ModelClock, IsSetByTheMessageWithTheLeastDelay) {
  ModelClock clock(1.0, 30.0);
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    double const delay = 1e-3 * double(random() % 2000);
    ASSERT_TRUE(clock.follow(i, i + delay));
    EXPECT_GE(clock.now(i + delay), i);
  }
  EXPECT_NEAR(clock.now(1000.0), 1000.0, 0.2);
}

TEST(ModelClock, CannotBePushedBeyondItsTolerance) {
  ModelClock clock(1.0, 30.0);
  ASSERT_TRUE(clock.follow(0.0, 0.0));
  EXPECT_FALSE(clock.follow(31.0, 0.0));
  EXPECT_FALSE(clock.follow(1e300, 0.0));
  for (int i = 0; i < 1000; ++i) clock.follow(25.0 + i, 0.0);
  EXPECT_LE(clock.now(0.0), 30.0);
  EXPECT_LE(clock.now(100.0), 130.0);
}

TEST(ModelClock, FollowsAClockThatGoesSlowOrFast) {
  for (double const rate : {0.9995, 1.0005}) {
    ModelClock clock(1.0, 5.0);
    for (int i = 0; i <= 100'000; i += 10) ASSERT_TRUE(clock.follow(rate * i, i)) << rate << " " << i;
    EXPECT_NEAR(clock.now(100'000.0), rate * 100'000.0, 0.02) << rate;
  }
}

TEST(ModelClock, NeverGoesBack) {
  ModelClock clock(10.0, 5.0);
  std::mt19937_64 random(2);
  double last = -1e300;
  for (int i = 0; i < 10'000; ++i) {
    double const wall = 0.01 * i;
    clock.follow(0.1 * i + 1e-2 * (double(random() % 2000) - 1500.0), wall);
    EXPECT_GE(clock.now(wall), last);
    last = clock.now(wall);
  }
}

}  // namespace
}  // namespace thermotwin::twin
