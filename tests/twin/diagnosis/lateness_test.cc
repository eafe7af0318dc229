#include "twin/diagnosis/lateness.h"

#include <cmath>
#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

using Eigen::VectorXd;

/// Up and down with a time constant of half an hour, at times that do not repeat themselves.
double course(double t) {
  double sum = 0.0, level = 1.0;
  for (double const at : {1.0, 3.5, 5.0, 8.5, 10.5}) {
    if (double const since = t - at * 3600.0; since > 0.0) sum += level * (1.0 - std::exp(-since / 1800.0));
    level = -level;
  }
  return sum;
}

class LatenessTest : public testing::Test {
 protected:
  VectorXd const time = VectorXd::LinSpaced(200, 0.0, 12.0 * 3600.0);
  VectorXd const due = time.unaryExpr([](double t) { return course(t); });
};

TEST_F(LatenessTest, IsTheShiftOfACourseOfAnySizeOnASlope) {
  for (double const shift : {-1800.0, 0.0, 600.0}) {
    VectorXd const seen = time.unaryExpr([&](double t) { return 300.0 + 3.0 * course(t - shift) + 1e-5 * t; });
    auto const lateness = lateness_of(time, seen, due);
    EXPECT_NEAR(lateness.time, shift, 120.0);
    EXPECT_GT(lateness.agreement, 0.95);
  }
}

TEST_F(LatenessTest, NothingIsLeftByTheRightShiftAndAllByNone) {
  VectorXd const seen = time.unaryExpr([](double t) { return course(t - 900.0); });
  EXPECT_LT(lateness_of(time, seen, due).left(), 0.2);
  EXPECT_DOUBLE_EQ(lateness_of(time, due, due).time, 0.0);
}

TEST_F(LatenessTest, MissingReadingsAreLeftOut) {
  VectorXd seen = time.unaryExpr([](double t) { return course(t - 900.0); });
  for (Eigen::Index i = 0; i < seen.size(); i += 5) seen[i] = NAN;
  EXPECT_NEAR(lateness_of(time, seen, due).time, 900.0, 120.0);
}

}  // namespace
}  // namespace thermotwin::twin
