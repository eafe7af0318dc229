#include "twin/room_air.h"

#include <gtest/gtest.h>

#include "tests/thermal/function_course.h"

namespace thermotwin::twin {
namespace {

TEST(RoomAir, IsWarmerAboveByItsGradient) {
  thermal::FunctionCourse const course({"spindle.speed", "ambient.gradient", "ambient.floor_temperature"},
                                       [](double, std::span<double>) {});
  std::vector<double> const inputs = {100.0, 0.5, 295.0};
  RoomAir const air(course);
  EXPECT_DOUBLE_EQ(air.at(0.0, inputs), 295.0);
  EXPECT_DOUBLE_EQ(air.at(height_near_tool, inputs), 295.5);
  EXPECT_DOUBLE_EQ(air.at(-2.0, inputs), 294.0);
}

TEST(RoomAir, IsAtTwentyDegreesWhereTheCourseDoesNotSay) {
  thermal::FunctionCourse const course({"spindle.speed"}, [](double, std::span<double>) {});
  EXPECT_DOUBLE_EQ(RoomAir(course).at(3.0, std::vector{100.0}), 293.15);
  EXPECT_DOUBLE_EQ(RoomAir().at(3.0, {}), 293.15);
}

}  // namespace
}  // namespace thermotwin::twin
