#include "models/metrics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

namespace thermotwin::models {
namespace {

using Eigen::Vector4d;
using Eigen::VectorXd;

TEST(Metrics, AreWhatAHandComputes) {
  // e = −1, 1, 2, −2; y = 0.5, 4, 8, 10
  auto const m = metrics(Vector4d(0.5, 4, 8, 10), Vector4d(1.5, 3, 6, 12));
  EXPECT_DOUBLE_EQ(m.rmse, std::sqrt(10.0 / 4.0));
  EXPECT_DOUBLE_EQ(m.mae, 1.5);
  EXPECT_DOUBLE_EQ(m.max, 2.0);
  EXPECT_DOUBLE_EQ(m.r_squared, 1.0 - 10.0 / 53.6875);  // ȳ = 5.625
  EXPECT_DOUBLE_EQ(m.mape, 100.0 * (0.25 + 0.25 + 0.2) / 3.0);
  EXPECT_EQ(m.mape_samples, 3);
}

TEST(Metrics, MapeLeavesOutWhatIsNearlyZero) {
  auto const m = metrics(Vector4d(0, 0.001, -0.5, 0), Vector4d(1, 1, 1, 1));
  EXPECT_EQ(m.mape_samples, 0);
  EXPECT_TRUE(std::isnan(m.mape));
  EXPECT_EQ(metrics(Vector4d(0, 2, 2, 2), Vector4d(1, 2, 2, 2), 0.0).mape, 0.0);
}

TEST(Metrics, HaveNoShareOfAConstantExplained) {
  EXPECT_TRUE(std::isnan(metrics(Vector4d::Ones(), Vector4d::Zero()).r_squared));
}

TEST(Metrics, RefuseUnequalLengths) {
  EXPECT_THROW(metrics(Vector4d::Ones(), VectorXd::Ones(3)), std::invalid_argument);
  EXPECT_THROW(metrics(VectorXd(), VectorXd()), std::invalid_argument);
}

TEST(Improvement, IsTheShareThatWent) {
  EXPECT_DOUBLE_EQ(improvement(4.0, 1.0), 75.0);
  EXPECT_DOUBLE_EQ(improvement(2.0, 3.0), -50.0);
  EXPECT_THROW(improvement(0.0, 1.0), std::invalid_argument);
}

TEST(CompensationRate, ComparesTheLargest) {
  EXPECT_DOUBLE_EQ(compensation_rate(Vector4d(1, -27, 3, 4), Vector4d(10, -2, 0, 0)), 1.0 - 10.0 / 27.0);
  EXPECT_THROW(compensation_rate(Vector4d::Zero(), Vector4d::Ones()), std::invalid_argument);
}

}  // namespace
}  // namespace thermotwin::models
