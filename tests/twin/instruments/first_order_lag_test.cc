#include "twin/instruments/first_order_lag.h"

#include <cmath>
#include <gtest/gtest.h>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using Eigen::VectorXd;

// V12 of physics.md §9.
TEST(FirstOrderLag, FollowsARampByItsClosedForm) {
  double const rate = 0.002, lag = 40.0;
  VectorXd const time = VectorXd::LinSpaced(11, 0.0, 600.0);
  FirstOrderLag const sensor(time, rate * time, lag);
  for (double t : {1.0, 37.0, 60.0, 240.0, 599.0})
    EXPECT_NEAR(sensor.at(t), rate * (t - lag * (1.0 - std::exp(-t / lag))), 1e-14) << t;
}

TEST(FirstOrderLag, DoesNotDependOnTheGridOfALinearCourse) {
  VectorXd const fine = VectorXd::LinSpaced(901, 0.0, 900.0);
  VectorXd const course = (fine.array() < 300.0).select(0.01 * fine, 3.0 - 0.005 * (fine.array() - 300.0));
  VectorXd coarse(3), corners(3);
  coarse << 0.0, 300.0, 900.0;
  corners << 0.0, 3.0, 0.0;
  FirstOrderLag const a(fine, course, 25.0), b(coarse, corners, 25.0);
  for (double t = 0.5; t < 900.0; t += 13.0) EXPECT_NEAR(a.at(t), b.at(t), 1e-13) << t;
}

TEST(FirstOrderLag, SettlesToTheLastValueAndHoldsTheFirst) {
  VectorXd time(2), course(2);
  time << 10.0, 20.0;
  course << 1.0, 2.0;
  FirstOrderLag const sensor(time, course, 5.0);
  EXPECT_EQ(sensor.at(-100.0), 1.0);
  double const at_end = sensor.at(20.0);
  EXPECT_NEAR(at_end, 2.0 - 0.5 * (1.0 - std::exp(-2.0)), 1e-14);
  EXPECT_NEAR(sensor.at(25.0), 2.0 + (at_end - 2.0) * std::exp(-1.0), 1e-14);
  EXPECT_NEAR(sensor.at(1e4), 2.0, 1e-14);
}

TEST(FirstOrderLag, WithoutLagIsTheCourseAndApproachesItContinuously) {
  VectorXd time(3), course(3);
  time << 0.0, 1.0, 3.0;
  course << 1.0, 4.0, 0.0;
  FirstOrderLag const none(time, course, 0.0), tiny(time, course, 1e-9);
  for (double const t : {0.0, 0.25, 1.0, 2.5, 3.0, 9.0}) EXPECT_NEAR(none.at(t), tiny.at(t), 1e-8) << t;
  EXPECT_DOUBLE_EQ(none.at(2.5), 1.0);
}

TEST(FirstOrderLag, RejectsWhatIsNoCourse) {
  VectorXd const two = VectorXd::LinSpaced(2, 0.0, 1.0);
  EXPECT_THROW(FirstOrderLag(two, VectorXd::Zero(3), 0.0), thermal::InputError);
  EXPECT_THROW(FirstOrderLag(VectorXd::Zero(2), two, 0.0), thermal::InputError);
  EXPECT_THROW(FirstOrderLag(two, two, -1.0), thermal::InputError);
  EXPECT_THROW(FirstOrderLag({}, {}, 1.0), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
