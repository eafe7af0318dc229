#include "twin/instruments/sampling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "thermal/error.h"

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

TEST(Sampling, AveragesWhatFitsIntoTheWindow) {
  double const ever = std::numeric_limits<double>::infinity();
  EXPECT_EQ(conversions(0.0, 0.1, ever), 1);
  EXPECT_EQ(conversions(0.3, 0.1, ever), 3);
  EXPECT_EQ(conversions(60.0, 0.75, ever), 80);
  EXPECT_EQ(conversions(60.0, 1.0, 10.0), 10);
  EXPECT_THROW(conversions(1.0, 0.0, ever), thermal::InputError);
}

TEST(Sampling, QuantisesToTheNearestStep) {
  EXPECT_EQ(quantised(20.03, 0.0625), 20.0);
  EXPECT_EQ(quantised(20.04, 0.0625), 20.0625);
  EXPECT_EQ(quantised(-0.05, 0.0625), -0.0625);
  EXPECT_EQ(quantised(20.03, 0.0), 20.03);
}

}  // namespace
}  // namespace thermotwin::twin
