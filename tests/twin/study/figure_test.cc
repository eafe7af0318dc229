#include "twin/study/figure.h"

#include <cmath>
#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

TEST(StudyIntervals, AreStudentsOnes) {
  auto const of = interval({1, 2, 3, 4, 5});
  EXPECT_EQ(of.mean, 3.0);
  EXPECT_NEAR(of.half, 2.7764451 * std::sqrt(2.5 / 5.0), 1e-6);
  EXPECT_EQ(interval({2, NAN}).mean, 2.0);
  EXPECT_EQ(text_of(interval({2})), "2.00");
  EXPECT_EQ(text_of(interval({})), "-");
}

TEST(StudyFigures, AreBetterByLessButForSome) {
  for (auto const* figure :
       {"cross.r_squared", "validation.r_squared", "improvement", "selection.found", "selection.rank_correlation"})
    EXPECT_TRUE(more_is_better(figure)) << figure;
  for (auto const* figure : {"cross.rmse", "self.mape", "S", "Mn.least", "selection.regret", "feed_8000 at 60 min.max"})
    EXPECT_FALSE(more_is_better(figure)) << figure;
}

TEST(StudyIntervals, HaveNoNegativeZero) {
  EXPECT_EQ(text_of(interval({-1e-17, -2e-17})), "0.00 ± 0.00");
  EXPECT_EQ(text_of(interval({-0.004})), "0.00");
  EXPECT_EQ(text_of(interval({-0.006})), "-0.01");
  EXPECT_EQ(text_of(interval({-0.004}), 3), "-0.004");
}

/// A constant denominator leaves the interval of a, in units of it. Paired: R = 2, a − R b is 0, −1 and 1, over b̄ = 2.
/// A small denominator in one repetition does not make the ratio large.
TEST(StudyRatios, AreOfTheMeans) {
  auto const of = interval(ratio_of_means({4, 3, 5}, {2, 2, 2}));
  EXPECT_NEAR(of.mean, 2.0, 1e-12);
  EXPECT_NEAR(of.half, 0.5 * interval({4, 3, 5}).half, 1e-12);
  auto const paired = interval(ratio_of_means({2, 3, 7}, {1, 2, 3}));
  EXPECT_NEAR(paired.mean, 2.0, 1e-12);
  EXPECT_NEAR(paired.half, 4.3026527 * 0.5 / std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(interval(ratio_of_means({1, 1}, {0.01, 1.99})).mean, 1.0, 1e-12);
  EXPECT_NEAR(interval(ratio_of_means({3, 100, 6}, {1, NAN, 2})).mean, 3.0, 1e-12);
  EXPECT_NEAR(interval(ratio_of_means({1, 2, 3}, {2, 4, 6})).half, 0.0, 1e-12);
  EXPECT_EQ(interval(ratio_of_means({1}, {4})).values, 1);
  EXPECT_EQ(interval(ratio_of_means({}, {4})).values, 0);
}

}  // namespace
}  // namespace thermotwin::twin
