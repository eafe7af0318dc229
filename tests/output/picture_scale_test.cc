#include "output/picture_scale.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace thermotwin::output {
namespace {

TEST(PictureScale, TicksAreRoundAndEncloseTheRange) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> middle(-20.0, 300.0), decade(-1.0, 3.0);
  for (int i = 0; i < 1000; ++i) {
    double const low = middle(random), high = low + std::pow(10.0, decade(random));
    Ticks const ticks = round_ticks(low, high);
    double const last = ticks.first + (ticks.count - 1) * ticks.step;
    EXPECT_LE(ticks.first, low + 1e-6 * ticks.step);
    EXPECT_GE(last, high - 1e-6 * ticks.step);
    EXPECT_GT(ticks.first, low - 1.001 * std::max(ticks.step, 0.4));
    EXPECT_GE(ticks.count, 4);
    EXPECT_LE(ticks.count, 12);
    double const scaled = ticks.step * std::pow(10.0, ticks.decimals);
    EXPECT_NEAR(scaled, std::round(scaled), 1e-9) << "the decimals show the step";
    EXPECT_NEAR(ticks.first / ticks.step, std::round(ticks.first / ticks.step), 1e-6);
  }
}

TEST(PictureScale, TicksAroundOneTemperatureLeaveItInTheMiddle) {
  Ticks const ticks = round_ticks(20.0, 20.0);
  EXPECT_NEAR(ticks.first, 19.8, 1e-12);
  EXPECT_NEAR(ticks.step, 0.1, 1e-12);
  EXPECT_EQ(ticks.count, 5);
  EXPECT_EQ(ticks.decimals, 1);
}

TEST(PictureScale, TicksOfHugeNumbersAreStillApart) {
  for (double const value : {3e16, -1e17, 1e300}) {
    Ticks const ticks = round_ticks(value, value, 0.0);
    EXPECT_GE(ticks.count, 4);
    EXPECT_LE(ticks.count, 12);
    EXPECT_LT(ticks.first, value);
    EXPECT_GT(ticks.first + (ticks.count - 1) * ticks.step, value);
  }
}

TEST(PictureScale, RoundsDownToOneTwoFive) {
  EXPECT_DOUBLE_EQ(round_down(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_down(1.99), 1.0);
  EXPECT_DOUBLE_EQ(round_down(2.0), 2.0);
  EXPECT_DOUBLE_EQ(round_down(4999.0), 2000.0);
  EXPECT_DOUBLE_EQ(round_down(5000.0), 5000.0);
  EXPECT_DOUBLE_EQ(round_down(0.03), 0.02);
  EXPECT_DOUBLE_EQ(round_down(1e-3), 1e-3);
}

TEST(PictureScale, TellsTimeInWords) {
  EXPECT_EQ(time_text(0.0), "0 s");
  EXPECT_EQ(time_text(59.4), "59 s");
  EXPECT_EQ(time_text(59.6), "1 min 00 s");
  EXPECT_EQ(time_text(754.0), "12 min 34 s");
  EXPECT_EQ(time_text(4 * 3600.0), "4 h 00 min");
  EXPECT_EQ(time_text(30 * 3600.0 + 5 * 60.0), "30 h 05 min");
}

TEST(PictureScale, GroupsTheDigitsOfTheMagnification) {
  EXPECT_EQ(magnification_text(0.5), "0.5");
  EXPECT_EQ(magnification_text(200.0), "200");
  EXPECT_EQ(magnification_text(5000.0), "5,000");
  EXPECT_EQ(magnification_text(2e6), "2,000,000");
  EXPECT_EQ(magnification_text(1020.0), "1,020");
}

}  // namespace
}  // namespace thermotwin::output
