#include "twin/input_motion.h"

#include <gtest/gtest.h>

#include "tests/thermal/function_course.h"

namespace thermotwin::twin {
namespace {

TEST(InputMotion, IsWhatItsTermsHaveChangedBySinceTheStart) {
  thermal::FunctionCourse const course({"z.feed", "spindle.speed"}, [](double, std::span<double>) {});
  InputMotion const motion({{"E_Z", "spindle.speed", -2e-10, 2.0}, {"E_Z", "z.feed", 3e-6, 1.0}}, course);
  std::vector<double> const start = {0.5, 100.0}, then = {0.1, 300.0};
  EXPECT_NEAR(motion(then, start), -2e-10 * (9e4 - 1e4) + 3e-6 * (0.1 - 0.5), 1e-18);
  EXPECT_DOUBLE_EQ(motion(start, start), 0.0);
}

TEST(InputMotion, FollowsNoChannelThatTheCourseLacks) {
  thermal::FunctionCourse const course({"spindle.speed"}, [](double, std::span<double>) {});
  InputMotion const motion({{"E_Z", "coolant.on", 5e-6, 1.0}}, course);
  EXPECT_DOUBLE_EQ(motion(std::vector{300.0}, std::vector{0.0}), 0.0);
}

}  // namespace
}  // namespace thermotwin::twin
