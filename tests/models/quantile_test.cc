#include "models/quantile.h"

#include <gtest/gtest.h>
#include <vector>

namespace thermotwin::models {
namespace {

TEST(Quantile, LiesOnStraightLinesBetweenTheNumbers) {
  std::vector<double> const four = {1.0, 2.0, 4.0, 8.0};
  EXPECT_EQ(quantile(four, 0.0), 1.0);
  EXPECT_EQ(quantile(four, 0.5), 3.0);
  EXPECT_NEAR(quantile(four, 0.9), 4.0 + 0.7 * 4.0, 1e-15);
  EXPECT_EQ(quantile(four, 1.0), 8.0);
  EXPECT_EQ(quantile(std::vector<double>{5.0}, 0.3), 5.0);
}

}  // namespace
}  // namespace thermotwin::models
