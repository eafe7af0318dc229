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

}  // namespace
}  // namespace thermotwin::twin
