#include "twin/compensation/axis_shift.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(AxisShift, MovesInStepsOfTheResolution) {
  AxisShift shift({0.5, 0.0, infinity, 10.0});
  EXPECT_EQ(shift.move_to(1.2, 1.0), 1.0);
  EXPECT_EQ(shift.move_to(-1.3, 1.0), -1.5);
}

TEST(AxisShift, HasNoNegativeZero) {
  AxisShift shift({1.0, 0.0, infinity, 10.0});
  for (double const target : {-0.3, -0.0, -3.0, -0.0})
    EXPECT_FALSE(shift.move_to(target, 1.0) == 0.0 && std::signbit(shift.offset())) << target;
}

TEST(AxisShift, FollowsTheTargetToTheDeadBandOrHalfAStep) {
  for (double const dead_band : {0.0, 0.3, 0.5, 1.0, 2.0}) {
    AxisShift shift({1.0, dead_band, infinity, 100.0});
    for (int i = 0; i < 10'000; ++i) {
      double const target = 40.0 * std::sin(0.003 * i);
      ASSERT_LE(std::abs(shift.move_to(target, 1.0) - target), std::max(dead_band, 0.5) + 1e-12) << i;
    }
  }
}

TEST(AxisShift, StandsStillWithinTheDeadBand) {
  AxisShift shift({1.0, 2.0, infinity, 100.0});
  EXPECT_EQ(shift.move_to(5.0, 1.0), 5.0);
  EXPECT_EQ(shift.move_to(6.9, 1.0), 5.0);
  EXPECT_EQ(shift.move_to(3.1, 1.0), 5.0);
  EXPECT_EQ(shift.move_to(7.0, 1.0), 7.0);
}

TEST(AxisShift, GoesHomeWhollyWhateverTheDeadBand) {
  AxisShift shift({1.0, 5.0, infinity, 100.0});
  EXPECT_EQ(shift.move_to(6.0, 1.0), 6.0);
  EXPECT_EQ(shift.move_to(0.0, 1.0), 0.0);
}

TEST(AxisShift, CreepsWithLessThanAStepPerDecision) {
  AxisShift shift({1.0, 0.0, 0.5, 100.0});
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(shift.move_to(10.0, 0.01), 0.005 * (i + 1), 0.5 + 1e-9) << i;
}

TEST(AxisShift, ClampsToAWholeNumberOfSteps) {
  AxisShift shift({2.0, 0.0, infinity, 7.0});
  EXPECT_EQ(shift.move_to(1e300, 1.0), 6.0);
  EXPECT_EQ(shift.move_to(-infinity, 1.0), 6.0);
  EXPECT_EQ(shift.move_to(-1e300, 1.0), -6.0);
}

TEST(AxisShift, KeepsItsLimitsWhateverItIsTold) {
  std::mt19937_64 random(1);
  double const wild[] = {0.0, 1e300, -1e300, infinity, -infinity, std::nan(""), 3.0, -3.0, 17.4, -49.9};
  for (auto const& limits : {ShiftLimits{1, 1, 1, 50}, ShiftLimits{0.1, 0, 0.3, 7.77}, ShiftLimits{3, 2, 100, 10}}) {
    AxisShift shift(limits);
    double last = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      double const elapsed = 1e-3 * double(random() % 5000) - 0.5;
      double const now = shift.move_to(wild[random() % std::size(wild)], elapsed);
      EXPECT_LE(std::abs(now), limits.largest);
      EXPECT_LE(std::abs(now - last), limits.slew * std::max(0.0, elapsed) + limits.resolution + 1e-9);
      EXPECT_NEAR(std::remainder(now, limits.resolution), 0.0, 1e-9);
      last = now;
    }
  }
}

TEST(AxisShift, RefusesLimitsThatAreNone) {
  EXPECT_THROW(AxisShift({0, 1, 1, 50}), thermal::InputError);
  EXPECT_THROW(AxisShift({1, -1, 1, 50}), thermal::InputError);
  EXPECT_THROW(AxisShift({1, 1, 0, 50}), thermal::InputError);
  EXPECT_THROW(AxisShift({1, 1, 1, 0.5}), thermal::InputError);
  EXPECT_THROW(AxisShift({1, std::nan(""), 1, 50}), thermal::InputError);
}

TEST(FadingHold, HoldsThenFadesToNothing) {
  FadingHold const fallback{100.0, 50.0};
  EXPECT_EQ(fallback.share(0.0), 1.0);
  EXPECT_EQ(fallback.share(100.0), 1.0);
  EXPECT_DOUBLE_EQ(fallback.share(125.0), 0.5);
  EXPECT_EQ(fallback.share(150.0), 0.0);
  EXPECT_EQ(fallback.share(1e9), 0.0);
}

}  // namespace
}  // namespace thermotwin::twin
