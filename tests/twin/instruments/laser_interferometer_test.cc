#include "twin/instruments/laser_interferometer.h"

#include <cmath>
#include <gtest/gtest.h>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double hour = 3600.0;

LaserInterferometer ideal() {
  LaserInterferometer laser;
  laser.air_temperature_error = laser.pressure_error = laser.humidity_error = laser.material_temperature_error = 0.0;
  laser.dead_path = laser.lost_motion = laser.turning_error = laser.noise = laser.resolution = 0.0;
  laser.time_per_target = 0.0;
  laser.relative_to_first_pass = false;
  return laser;
}

/// Air that warms by `warming` in an hour; no error of the axis.
LaserCourse room(double warming) {
  VectorXd time(2), air(2);
  time << 0.0, hour;
  air << 293.15, 293.15 + warming;
  return {[](double, double) { return 0.0; }, time, air, {}, {}};
}

LaserReadings measure(LaserInterferometer const& laser, LaserCourse const& course) {
  return read(laser, {"laser z"}, scenarios::LaserMeasurement{}, hour, course);
}

TEST(LaserInterferometer, VisitsThirteenTargetsEveryQuarterOfAnHour) {
  output::Positioning const table = measure(ideal(), room(0.0)).readings;
  EXPECT_EQ(table.axis, "z");
  ASSERT_EQ(table.position_mm.size(), 13);
  EXPECT_NEAR(table.position_mm[12], 600.0, 1e-9);
  ASSERT_EQ(table.time_s.size(), 5);
  EXPECT_EQ(table.time_s[4], hour);
}

TEST(LaserInterferometer, IdealShowsTheErrorOfTheAxis) {
  LaserCourse course = room(4.0);
  course.error = [](double x, double t) { return 80e-6 * x / 0.6 * (1.0 - std::exp(-t / 1800.0)); };
  LaserReadings const result = measure(ideal(), course);
  double const expected = 80.0 * (1.0 - std::exp(-2.0));
  EXPECT_NEAR(result.readings.forward_um(4, 12), expected, 1e-6);
  EXPECT_NEAR(result.readings.backward_um(4, 6), 0.5 * expected, 1e-6);
  EXPECT_LT((result.readings.forward_um - result.truth.forward_um).cwiseAbs().maxCoeff(), 1e-6);
}

// physics.md §4, §7 no. 36: 0.955 ppm/K of the distance; warm air shortens the optical path.
TEST(LaserInterferometer, UncompensatedAirShowsInProportionToTheDistance) {
  LaserInterferometer laser = ideal();
  laser.air_compensation = false;
  MatrixXd const errors = measure(laser, room(1.0)).readings.forward_um;
  EXPECT_NEAR(errors(4, 12), -0.955 * 0.6, 0.003);
  EXPECT_NEAR(errors(4, 6), 0.5 * errors(4, 12), 1e-9);
  EXPECT_NEAR(errors(0, 12), 0.0, 1e-9);
  LaserCourse weather = room(0.0);
  weather.pressure = VectorXd::LinSpaced(2, 101325.0, 102325.0);
  EXPECT_NEAR(measure(laser, weather).readings.forward_um(4, 12), 2.68 * 0.6, 0.01);
}

TEST(LaserInterferometer, EnvironmentUnitPassesItsOwnErrorOn) {
  LaserInterferometer laser = ideal();
  laser.air_temperature_error = 0.2;
  laser.humidity_error = 0.05;
  EXPECT_NEAR(measure(laser, room(5.0)).readings.forward_um(0, 12), (0.955 * 0.2 + 0.0085 * 5) * 0.6, 0.002);
}

// physics.md §4: 0.5 m and 3 K make 1.4 µm.
TEST(LaserInterferometer, DeadPathShiftsAllTargetsWithTheAir) {
  LaserInterferometer laser = ideal();
  laser.dead_path = 0.5;
  MatrixXd const errors = measure(laser, room(3.0)).readings.forward_um;
  EXPECT_NEAR(errors(4, 0), -1.4, 0.05);
  EXPECT_NEAR(errors(4, 12), errors(4, 0), 1e-9);
  EXPECT_EQ(errors(0, 12), 0.0);
  laser.dead_path_correction = true;
  EXPECT_LT(measure(laser, room(3.0)).readings.forward_um.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LaserInterferometer, MountGrowsTowardsTheReflector) {
  LaserInterferometer laser = ideal();
  laser.mount_length = 0.2;
  EXPECT_NEAR(measure(laser, room(2.0)).readings.forward_um(4, 3), -11.5 * 0.2 * 2.0, 1e-9);
}

TEST(LaserInterferometer, MaterialCompensationRefersTheDistanceTo20Degrees) {
  LaserInterferometer laser = ideal();
  laser.material_expansion = 11.5e-6;
  laser.material_temperature_error = 0.1;
  LaserCourse course = room(0.0);
  course.material = VectorXd::Constant(2, 298.15);
  EXPECT_NEAR(measure(laser, course).readings.forward_um(2, 12), -11.5 * 5.1 * 0.6, 1e-6);
}

TEST(LaserInterferometer, LostMotionShowsBackwardsExceptWhereTheAxisTurns) {
  LaserInterferometer laser = ideal();
  laser.lost_motion = 3e-6;
  output::Positioning const turned = measure(laser, room(0.0)).readings;
  for (int i = 0; i < 12; ++i) EXPECT_NEAR(turned.backward_um(1, i) - turned.forward_um(1, i), 3.0, 1e-9);
  EXPECT_NEAR(turned.backward_um(1, 12) - turned.forward_um(1, 12), 0.0, 1e-9);
  EXPECT_NEAR((measure(laser, room(0.0)).truth.backward_um - turned.backward_um).cwiseAbs().maxCoeff(), 0.0, 1e-9);
  laser.overrun = true;
  LaserReadings const overrun = measure(laser, room(0.0));
  EXPECT_NEAR(overrun.readings.backward_um(1, 12) - overrun.readings.forward_um(1, 12), 3.0, 1e-9);
  EXPECT_NEAR(overrun.truth.backward_um(1, 12), 3.0, 1e-9);
}

TEST(LaserInterferometer, LastTargetIsUnreliableAndOnlyTheLast) {
  LaserInterferometer laser = ideal();
  laser.turning_error = 2e-6;
  scenarios::LaserMeasurement measurement;
  measurement.interval = 1.0;
  LaserReadings const result = read(laser, {"laser z"}, measurement, 4000.0, room(0.0));
  VectorXd const last = result.readings.forward_um.col(12);
  EXPECT_NEAR(std::sqrt(last.squaredNorm() / double(last.size())), 2.0, 0.1);
  EXPECT_EQ(result.readings.forward_um.leftCols(12).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LT((last - result.readings.backward_um.col(12)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(result.truth.forward_um.cwiseAbs().maxCoeff(), 0.0);
}

TEST(LaserInterferometer, FirstPassCanBeTakenOff) {
  LaserInterferometer laser;
  LaserCourse course = room(1.0);
  course.error = [](double x, double t) { return 30e-6 * std::sin(9.0 * x) + 1e-6 * t / hour; };
  LaserReadings const result = measure(laser, course);
  EXPECT_EQ(result.readings.forward_um.row(0).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(result.readings.backward_um.row(0).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_NEAR(result.truth.forward_um(4, 5), 1.0, 1e-9);
}

TEST(LaserInterferometer, AxisMovesOnDuringAPass) {
  LaserInterferometer laser = ideal();
  laser.time_per_target = 5.0;
  LaserCourse course = room(0.0);
  course.error = [](double, double t) { return 1e-9 * t; };
  MatrixXd const forward = measure(laser, course).truth.forward_um;
  MatrixXd const backward = measure(laser, course).truth.backward_um;
  EXPECT_NEAR(forward(1, 12) - forward(1, 0), 12 * 5e-3, 1e-12);
  EXPECT_NEAR(backward(1, 0) - forward(1, 0), 25 * 5e-3, 1e-12);
}

TEST(LaserInterferometer, OneDirectionLeavesTheOtherOpen) {
  scenarios::LaserMeasurement measurement;
  measurement.both_directions = false;
  LaserReadings const result = read(LaserInterferometer{}, {"laser z"}, measurement, hour, room(0.0));
  EXPECT_TRUE(result.readings.backward_um.array().isNaN().all());
  EXPECT_TRUE(result.readings.forward_um.allFinite());
}

TEST(LaserInterferometer, SameSeedGivesTheSameReadings) {
  scenarios::LaserMeasurement const measurement;
  LaserInterferometer const laser;
  MatrixXd const a = read(laser, {"laser z", 4}, measurement, hour, room(1.0)).readings.forward_um;
  EXPECT_EQ(a, read(laser, {"laser z", 4}, measurement, hour, room(1.0)).readings.forward_um);
  EXPECT_NE(a, read(laser, {"laser z", 5}, measurement, hour, room(1.0)).readings.forward_um);
}

TEST(LaserInterferometer, TableOfErrorsIsLinearInPlaceAndTime) {
  VectorXd const time = VectorXd::LinSpaced(3, 0.0, 20.0), position = VectorXd::LinSpaced(2, 0.0, 1.0);
  MatrixXd table(3, 2);
  table << 0.0, 0.0, 1.0, 3.0, 1.0, 5.0;
  auto const error = error_table(time, position, table);
  EXPECT_NEAR(error(0.25, 10.0), 1.5, 1e-14);
  EXPECT_NEAR(error(0.5, 15.0), 2.5, 1e-14);
  EXPECT_NEAR(error(7.0, 99.0), 5.0, 1e-14);
  EXPECT_THROW(error_table(time, position, MatrixXd::Zero(2, 3)), thermal::InputError);
}

TEST(LaserInterferometer, RefusesCoursesThatDoNotFit) {
  LaserCourse course = room(0.0);
  course.pressure = VectorXd::Constant(3, 101325.0);
  EXPECT_THROW(measure(LaserInterferometer{}, course), thermal::InputError);
  course = room(0.0);
  course.error = nullptr;
  EXPECT_THROW(measure(LaserInterferometer{}, course), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
