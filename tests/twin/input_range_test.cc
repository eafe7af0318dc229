#include "twin/input_range.h"

#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

models::Batch batch_of(Eigen::MatrixXd const& rise) { return {"run", {}, {"T1", "T2"}, {"a", "b"}, rise, {}}; }

TEST(InputRange, IsOfAllRunsToAMillikelvin) {
  Eigen::MatrixXd monday(2, 2), tuesday(3, 2);
  monday << 0.0, 0.0, 5.0, -0.50049;
  tuesday << 0.0, 0.0, 7.8126, 0.1, 3.0, 0.2;
  auto const ranges = input_ranges({batch_of(monday), batch_of(tuesday)});
  EXPECT_EQ(ranges, (std::vector<InputRange>{{0.0, 7.813}, {-0.5, 0.2}}));
}

TEST(InputRange, IsLeftByMoreThanATenthOfItsWidth) {
  InputRange const range{-1.0, 9.0};
  for (double const change : {-2.0, -1.0, 0.0, 9.0, 10.0}) EXPECT_FALSE(range.left_by(change)) << change;
  for (double const change : {-2.001, 10.001}) EXPECT_TRUE(range.left_by(change)) << change;
  EXPECT_EQ(range_left_text("T3", 10.26, range),
            "T3 changed by 10.26 K; the model was fitted on changes of -1.00 K to 9.00 K");
}

TEST(InputRange, IsLeftByMoreThanAStepOfTheReadings) {
  InputRange const range{0.0, 0.063};
  EXPECT_TRUE(range.left_by(-0.0625));
  EXPECT_FALSE(range.left_by(-0.0625, 0.0625));
  EXPECT_FALSE(range.left_by(0.125, 0.0625));
  EXPECT_TRUE(range.left_by(-0.125, 0.0625));
  EXPECT_TRUE(range.left_by(0.1875, 0.0625));
}

TEST(InputRange, FindsTheStepOfReadings) {
  EXPECT_EQ(reading_step(Eigen::Vector4d(0.0, 0.25, 0.0625, 0.25)), 0.0625);
  EXPECT_EQ(reading_step(Eigen::Vector4d(0.0, 4.0, 0.0, 2.0)), 0.0) << "no sensor is as coarse";
  EXPECT_EQ(reading_step(Eigen::Vector4d::Zero()), 0.0);
}

}  // namespace
}  // namespace thermotwin::twin
