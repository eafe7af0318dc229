#include "twin/instruments/averaging_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "tests/scenarios/refusal.h"

namespace thermotwin::twin {
namespace {

using testing::ElementsAre;

/// Of x = t.
double itself(double t) { return t; }

int count_of(double length, double interval) {
  int count = 0;
  AveragingWindow(length, interval).mean(0.0, [&](double) { return double(++count); });
  return count;
}

TEST(AveragingWindow, HoldsAsManyConversionsAsFit) {
  EXPECT_EQ(count_of(0.0, 0.1), 1);
  EXPECT_EQ(count_of(0.3, 0.1), 3);
  EXPECT_EQ(count_of(60.0, 0.75), 80);
  EXPECT_EQ(tests::refusal([] { AveragingWindow(1.0, 0.0); }), "conversion_interval is 0 s; it must be positive");
}

/// However often it is read, and also when it is read for the first time: of what changes evenly, the middle.
TEST(AveragingWindow, IsAsLongAsItSays) {
  for (double const length : {30.0, 60.0, 120.0, 300.0, 600.0}) {
    AveragingWindow window(length, 1.0);
    for (double t = 0.0; t <= 3600.0; t += 60.0)
      EXPECT_NEAR(window.mean(t, itself), t - 0.5 * (length - 1.0), 1e-9) << length;
  }
}

TEST(AveragingWindow, AsksForEachConversionOnce) {
  AveragingWindow window(4.0, 1.0);
  std::vector<double> asked;
  for (double const t : {0.0, 2.0, 4.0})
    window.mean(t, [&](double at) {
      asked.push_back(at);
      return at;
    });
  EXPECT_THAT(asked, ElementsAre(-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0));
}

/// What is read more often than it converts converts when it is read.
TEST(AveragingWindow, MayBeReadMoreOftenThanItConverts) {
  AveragingWindow window(4.0, 3.0);
  EXPECT_EQ(window.mean(0.0, itself), 0.0);
  EXPECT_EQ(window.mean(2.0, itself), 1.0);
  EXPECT_EQ(window.mean(4.0, itself), 3.0);
}

}  // namespace
}  // namespace thermotwin::twin
