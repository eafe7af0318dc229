#include "twin/compensation/model_clock.h"

#include <gtest/gtest.h>
#include <random>

namespace thermotwin::twin {
namespace {

/// Whether the clock believes a message; if so it is followed.
bool told(ModelClock& clock, std::size_t sender, double stamp, double wall) {
  double const lead = clock.lead(stamp, wall);
  clock.hear(sender, lead);
  if (!clock.believes(lead)) return false;
  clock.follow(lead, wall);
  return true;
}

TEST(ModelClock, RunsAtItsSpeedFromTheFirstMessage) {
  ModelClock clock(60.0, 30.0, 1);
  EXPECT_FALSE(clock.started());
  EXPECT_TRUE(told(clock, 0, 1000.0, 5.0));
  EXPECT_DOUBLE_EQ(clock.now(5.0), 1000.0);
  EXPECT_DOUBLE_EQ(clock.now(7.0), 1120.0);
}

TEST(ModelClock, IsSetByTheMessageWithTheLeastDelay) {
  ModelClock clock(1.0, 30.0, 3);
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    double const delay = 1e-3 * double(random() % 2000);
    bool const believed = told(clock, std::size_t(i) % 3, i, i + delay);
    EXPECT_EQ(believed, i > 0) << "the first of three is not most of them";
    EXPECT_TRUE(!believed || clock.now(i + delay) >= i);
  }
  EXPECT_NEAR(clock.now(1000.0), 1000.0, 0.2);
}

TEST(ModelClock, StartsWhenMostHaveBeenHeard) {
  for (std::size_t const senders : {1u, 2u, 3u, 5u, 50u}) {
    ModelClock clock(1.0, 30.0, senders);
    for (std::size_t i = 0; i <= senders / 2; ++i) {
      EXPECT_FALSE(clock.started());
      told(clock, i, 100.0, 0.0);
    }
    EXPECT_TRUE(clock.started()) << senders;
  }
}

/// As on a loaded machine whose clock is played 6000 times as fast: the first messages a second late, the others not.
TEST(ModelClock, IsSetRightByThoseWhoseFirstMessagesWereLate) {
  constexpr double speed = 6000.0;
  ModelClock clock(speed, 30.0, 5);
  for (std::size_t i = 0; i < 5; ++i) told(clock, i, 0.0, 1.0);
  int believed = 0;
  for (int row = 1; row <= 4; ++row)
    for (std::size_t i = 0; i < 5; ++i) believed += told(clock, i, row * 30.0, row * 30.0 / speed);
  EXPECT_EQ(believed, 2 * 5 + 3);  // after two of three senders, twice each
  EXPECT_DOUBLE_EQ(clock.now(0.02), 120.0);
}

TEST(ModelClock, IsNotPushedByOneSenderOfMany) {
  ModelClock clock(1.0, 30.0, 3);
  for (std::size_t i = 0; i < 3; ++i) told(clock, i, 0.0, 0.0);
  for (int i = 1; i < 1000; ++i) {
    EXPECT_FALSE(told(clock, 0, 1e9 + i, i));
    EXPECT_TRUE(told(clock, 1, i, i));
    EXPECT_TRUE(told(clock, 2, i, i));
    EXPECT_LE(clock.now(i), i);
  }
}

TEST(ModelClock, IsNotPushedByOneStampAmongTrueOnes) {
  ModelClock clock(1.0, 30.0, 1);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(told(clock, 0, i, i));
    EXPECT_FALSE(told(clock, 0, 1e9, i));
  }
  EXPECT_DOUBLE_EQ(clock.now(1000.0), 1000.0);
}

TEST(ModelClock, IsPushedByItsToleranceAtMost) {
  ModelClock clock(1.0, 30.0, 3);
  for (std::size_t i = 0; i < 3; ++i) told(clock, i, 0.0, 0.0);
  for (int i = 0; i < 1000; ++i) told(clock, 1, 25.0 + i, 0.0);
  EXPECT_DOUBLE_EQ(clock.now(0.0), 30.0);
}

TEST(ModelClock, FollowsAClockThatGoesSlowOrFast) {
  for (double const rate : {0.9995, 1.0005}) {
    ModelClock clock(1.0, 5.0, 1);
    for (int i = 0; i <= 100'000; i += 10) ASSERT_TRUE(told(clock, 0, rate * i, i)) << rate << " " << i;
    EXPECT_NEAR(clock.now(100'000.0), rate * 100'000.0, 0.02) << rate;
  }
}

TEST(ModelClock, NeverGoesBack) {
  ModelClock clock(10.0, 5.0, 1);
  std::mt19937_64 random(2);
  double last = -1e300;
  for (int i = 0; i < 10'000; ++i) {
    double const wall = 0.01 * i;
    told(clock, 0, 0.1 * i + 1e-2 * (double(random() % 2000) - 1500.0), wall);
    EXPECT_GE(clock.now(wall), last);
    last = clock.now(wall);
  }
}

}  // namespace
}  // namespace thermotwin::twin
