#include "twin/instruments/sampling.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/thermal/function_course.h"

namespace thermotwin::twin {
namespace {

using testing::ElementsAre;

TEST(Sampling, ServesTheFirstSampleAfterEachInstantOfItsClock) {
  Eigen::VectorXd times(7);
  times << 0.0, 40.0, 70.0, 100.0, 130.0, 300.0, 310.0;
  EXPECT_THAT(due(times, 60.0), ElementsAre(true, false, true, false, true, true, false));
  EXPECT_THAT(due(times, 0.0), testing::Each(true));
  EXPECT_THAT(due(times, 5.0), testing::Each(true));
}

TEST(Sampling, CountsFromTheFirstSampleNotFromZero) {
  Eigen::VectorXd times(3);
  times << 17.0, 77.0, 107.0;
  EXPECT_THAT(due(times, 60.0), ElementsAre(true, true, false));
}

TEST(Sampling, LooksOftenAfterAJumpAndOnceAMinuteInTheEnd) {
  std::vector<double> const jumps{30.0, 190.2, 200.0}, samples{0.0, 10.0, 190.0, 900.0};
  thermal::FunctionCourse const course(
      {"speed"}, [](double, std::span<double>) {}, jumps);
  auto const times = looks(samples, course);
  EXPECT_THAT(times, testing::IsSupersetOf(samples));
  EXPECT_THAT(times, testing::IsSupersetOf({30.0, 200.0}));
  EXPECT_THAT(times, testing::Not(testing::Contains(190.2)));  // as good as at the sample
  for (std::size_t i = 1; i < times.size(); ++i) {
    double since = 0.0;
    for (double const jump : jumps)
      if (jump < times[i - 1] + 0.5) since = jump;
    EXPECT_GE(times[i] - times[i - 1], 0.5);
    EXPECT_LE(times[i] - times[i - 1], std::min(60.0, std::max(5.0, 0.4 * (times[i - 1] - since))) + 0.5);
  }
  EXPECT_LT(times.size(), 60U);
  EXPECT_THAT(looks(std::vector{5.0}, course), ElementsAre(5.0));
}

TEST(Sampling, QuantisesToTheNearestStep) {
  EXPECT_EQ(quantised(20.03, 0.0625), 20.0);
  EXPECT_EQ(quantised(20.04, 0.0625), 20.0625);
  EXPECT_EQ(quantised(-0.05, 0.0625), -0.0625);
  EXPECT_EQ(quantised(20.03, 0.0), 20.03);
}

}  // namespace
}  // namespace thermotwin::twin
