#include "scenarios/feed_program.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "tests/scenarios/refusal.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {
namespace {

using tests::refusal;
using thermal::from_unit;
using thermal::to_unit;

AxisLimits axis() { return {"z", from_unit(24, "m/min"), 0.010, 0.12, 0.72}; }

FeedProgram to_and_fro(double feed, double duration) {
  FeedProgram program;
  program.blocks = {{duration, feed, {}}};
  return program;
}

TEST(AxisMotion, MeanScrewSpeedIsFeedOverLeadTimesDuty) {
  struct Case {
    double feed_mm_min;
    double mean_rpm;
  };
  for (Case const& c : {Case{8000, 704}, Case{12000, 1056}, Case{16000, 1408}}) {  // physics.md 6.1
    FeedProgram program = to_and_fro(from_unit(c.feed_mm_min, "mm/min"), 60.0);
    program.duty = 0.88;
    EXPECT_NEAR(to_unit(axis_motion(program, axis(), 60.0).screw_speed.at(0.0), "rpm"), c.mean_rpm, 1e-9);
  }
}

TEST(AxisMotion, DwellIsADuty) {
  FeedProgram program = to_and_fro(0.1, 60.0);  // 6 s per stroke of 600 mm
  program.dwell = 2.0;
  AxisMotion const motion = axis_motion(program, axis(), 60.0);
  EXPECT_DOUBLE_EQ(motion.duty.at(0.0), 0.75);
  EXPECT_DOUBLE_EQ(motion.screw_speed.at(0.0), 2.0 * M_PI * 0.1 / 0.010 * 0.75);
}

TEST(AxisMotion, StandsStillAfterItsBlocks) {
  AxisMotion const motion = axis_motion(to_and_fro(0.1, 60.0), axis(), 120.0);
  EXPECT_EQ(motion.duty.at(59.0), 1.0);
  for (Signal const* signal : {&motion.feed, &motion.duty, &motion.screw_speed}) EXPECT_EQ(signal->at(60.0), 0.0);
}

TEST(AxisMotion, TakesTheMachinesStrokeUnlessGiven) {
  FeedProgram program = to_and_fro(0.1, 60.0);
  EXPECT_DOUBLE_EQ(axis_motion(program, axis(), 60.0).position.at(0.0), 0.42);
  program.stroke_to = 0.32;
  AxisMotion const motion = axis_motion(program, axis(), 60.0);
  EXPECT_DOUBLE_EQ(motion.stroke_from.at(0.0), 0.12);
  EXPECT_DOUBLE_EQ(motion.stroke_to.at(0.0), 0.32);
}

TEST(AxisMotion, AShareOfRapidIsAFeed) {
  FeedProgram program;
  program.blocks = {{60.0, {}, 0.25}};
  EXPECT_DOUBLE_EQ(axis_motion(program, axis(), 60.0).feed.at(0.0), 0.1);
}

FeedProgram followed(double feed, double duration, double dwell) {
  FeedProgram program = to_and_fro(feed, duration);
  program.dwell = dwell;
  program.resolved = true;
  return program;
}

TEST(ResolvedAxisMotion, GoesToTheEndRestsAndComesBack) {
  AxisMotion const motion = axis_motion(followed(0.1, 60.0, 2.0), axis(), 60.0);
  EXPECT_DOUBLE_EQ(motion.position.at(0.0), 0.12);
  EXPECT_NEAR(motion.position.at(3.0), 0.42, 1e-12);
  for (double const t : {6.0, 7.0, 8.0}) EXPECT_NEAR(motion.position.at(t), 0.72, 1e-12);
  EXPECT_NEAR(motion.position.at(11.0), 0.42, 1e-12);
  EXPECT_NEAR(motion.position.at(15.0), 0.12, 1e-12);
  EXPECT_EQ(motion.feed.at(7.0), 0.0);
  EXPECT_EQ(motion.duty.at(7.0), 0.0);
  EXPECT_EQ(motion.feed.at(11.0), 0.1);
}

TEST(ResolvedAxisMotion, HasTheMeanOfTheMeanMotion) {
  FeedProgram program = followed(0.1, 1600.0, 2.0);  // 100 double strokes
  double const resolved = axis_motion(program, axis(), 1600.0).screw_speed.integral(1600.0);
  program.resolved = false;
  EXPECT_NEAR(resolved / axis_motion(program, axis(), 1600.0).screw_speed.integral(1600.0), 1.0, 1e-12);
}

TEST(ResolvedAxisMotion, DutyAndDwellAreTheSame) {
  FeedProgram program = followed(0.1, 100.0, 2.0);
  AxisMotion const rested = axis_motion(program, axis(), 100.0);
  program.dwell.reset();
  program.duty = 0.75;
  AxisMotion const duty = axis_motion(program, axis(), 100.0);
  for (double t = 0.5; t < 100.0; t += 1.0) EXPECT_NEAR(rested.position.at(t), duty.position.at(t), 1e-12);
}

TEST(ResolvedAxisMotion, ItsSpeedIsTheSlopeOfItsPosition) {
  AxisMotion const motion = axis_motion(followed(0.13, 60.0, 1.3), axis(), 90.0);
  double const h = 1e-5;
  for (double t = 0.25; t < 90.0; t += 0.5) {
    double const slope = (motion.position.at(t + h) - motion.position.at(t - h)) / (2 * h);
    EXPECT_NEAR(std::abs(slope), motion.feed.at(t), 1e-9) << t;
  }
}

TEST(ResolvedAxisMotion, StaysWhereABlockEndsAndGoesOnFromThere) {
  FeedProgram program = followed(0.1, 3.0, 0.0);
  program.blocks.push_back({5.0, {}, {}});
  program.blocks.push_back({3.0, 0.05, {}});
  AxisMotion const motion = axis_motion(program, axis(), 20.0);
  EXPECT_NEAR(motion.position.at(7.0), 0.42, 1e-12);
  EXPECT_NEAR(motion.position.at(11.0), 0.57, 1e-12);
  EXPECT_NEAR(motion.position.at(20.0), 0.57, 1e-12);
}

TEST(ResolvedAxisMotion, RefusesTooManyPasses) {
  FeedProgram program = followed(0.4, 1e7, 0.0);
  EXPECT_EQ(refusal([&] { axis_motion(program, axis(), 1e7); }),
            "axes.z.resolved: 6666667 passes are too many to follow; leave resolved out");
}

std::string refused(FeedProgram const& program) {
  return refusal([&] { axis_motion(program, axis(), 60.0); });
}

TEST(AxisMotion, RefusesWhatCannotBe) {
  EXPECT_EQ(refused(to_and_fro(0.5, 60.0)),
            "axes.z.blocks[0].feed: 30000 mm/min is above the axis' rapid feed, 24000 mm/min");
  EXPECT_EQ(refused(to_and_fro(-0.1, 60.0)), "axes.z.blocks[0].feed: -6000 mm/min is negative");
  EXPECT_EQ(refused(to_and_fro(0.1, 0.0)), "axes.z.blocks[0].duration: 0 min must be above 0 s");
  EXPECT_EQ(refused({}), "axes.z.blocks: the programme is empty; write blocks, or leave the axis out");

  FeedProgram program = to_and_fro(0.1, 60.0);
  program.blocks[0].of_rapid = 0.5;
  EXPECT_EQ(refused(program), "axes.z.blocks[0].feed: give either feed or of_rapid, not both");
  program.blocks = {{60.0, {}, 1.2}};
  EXPECT_EQ(refused(program), "axes.z.blocks[0].of_rapid: 1.2 must be from 0 to 1");
  program = to_and_fro(0.1, 60.0);
  program.duty = 1.1;
  EXPECT_EQ(refused(program), "axes.z.duty: 1.1 must be above 0 and at most 1");
  program.duty = 0.0;
  EXPECT_EQ(refused(program), "axes.z.duty: 0 must be above 0 and at most 1");
  program.dwell = 1.0;
  EXPECT_EQ(refused(program), "axes.z.duty: give either duty or dwell, not both");
  program.duty.reset();
  program.dwell = -1.0;
  EXPECT_EQ(refused(program), "axes.z.dwell: -1 s is negative");
  program.dwell.reset();
  program.stroke_to = 0.1;
  EXPECT_EQ(refused(program), "axes.z.stroke_to: 100 mm must be beyond stroke_from, 120 mm");
  program.stroke_to.reset();
  program.cycles = 0;
  EXPECT_EQ(refused(program), "axes.z.cycles: 0 must be 1 or more");
}

TEST(LaserMeasurement, HasThirteenTargetsEvery15Minutes) {
  LaserMeasurement const laser;
  std::vector<double> const places = targets(laser);
  ASSERT_EQ(places.size(), 13U);
  EXPECT_EQ(places.front(), 0.0);
  EXPECT_NEAR(places.back(), 0.6, 1e-12);
  std::vector<double> const times = measurement_times(laser, 240 * 60.0);
  EXPECT_EQ(times.size(), 17U);
  EXPECT_EQ(times.back(), 240 * 60.0);
}

TEST(LaserMeasurement, IsMadeAtTheEndInSpiteOfRounding) {
  LaserMeasurement laser;
  laser.interval = 0.1;
  for (int const tenths : {3, 6, 7}) {
    std::vector<double> const times = measurement_times(laser, tenths / 10.0);
    EXPECT_EQ(times.size(), std::size_t(tenths) + 1) << tenths;
    EXPECT_EQ(times.back(), tenths / 10.0);
  }
}

TEST(LaserMeasurement, RefusesWhatCannotBe) {
  LaserMeasurement laser;
  laser.pitch = 0.0;
  EXPECT_EQ(refusal([&] { targets(laser); }),
            "laser: targets from 0 mm to 600 mm every 0 mm; the pitch must be above 0 and to beyond from");
  laser.interval = 0.0;
  EXPECT_EQ(refusal([&] { measurement_times(laser, 60.0); }), "laser.interval: 0 min must be above 0 s");
}

}  // namespace
}  // namespace thermotwin::scenarios
