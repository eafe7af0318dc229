#include "scenarios/course.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {
namespace {

using thermal::from_unit;

constexpr double infinity = std::numeric_limits<double>::infinity();

MachineLimits machine() {
  return {from_unit(6000, "rpm"), {{"z", 0.4, 0.010, 0.12, 0.72}, {"x", 0.5, 0.016, 0.0, 0.4}}};
}

Experiment experiment(double duration = 300 * 60.0) {
  Experiment result;
  result.duration = duration;
  return result;
}

double at(thermal::Course const& course, std::string const& channel, double t) {
  std::vector<double> values(course.channels().size());
  course.evaluate(t, values);
  auto const found = std::find_if(course.channels().begin(), course.channels().end(),
                                  [&](thermal::InputChannel const& c) { return c.name == channel; });
  EXPECT_NE(found, course.channels().end()) << channel;
  return values.at(static_cast<std::size_t>(found - course.channels().begin()));
}

std::vector<double> jumps(thermal::Course const& course) {
  std::vector<double> times;
  for (double t = course.next_jump(0.0); t != infinity; t = course.next_jump(t)) times.push_back(t);
  return times;
}

/// The standard spectrum of the catalogue.
Experiment spectrum() {
  Experiment result = experiment();
  SpindleProgram& spindle = result.spindle.emplace();
  std::vector<std::pair<double, double>> const blocks = {{30, 0.25}, {30, 0.5}, {30, 0.75}, {30, 1.0}, {15, 0.0},
                                                         {30, 0.75}, {30, 0.5}, {45, 1.0},  {60, 0.0}};
  for (auto const& [minutes, share] : blocks) spindle.blocks.push_back({60.0 * minutes, {}, share});
  return result;
}

TEST(ExperimentCourse, JumpsAtBlockBordersAndNowhereElse) {
  std::vector<double> minutes = jumps(ExperimentCourse(spectrum(), machine()));
  for (double& t : minutes) t /= 60.0;
  EXPECT_EQ(minutes, (std::vector<double>{30, 60, 90, 120, 135, 165, 195, 240}));
}

/// A pulse of ten minutes in a record of a day, of which the integrator would see nothing once all is steady.
TEST(ExperimentCourse, BendsWhereARecordedLineDoes) {
  Experiment e = experiment(86400.0);
  e.driven.push_back({{"ambient.temperature", "K", "recorded"},
                      Signal({0.0, 72000.0, 72060.0, 72600.0, 72660.0, 86400.0},
                             {295.0, 295.0, 290.0, 290.0, 295.0, 295.0}, Interpolation::linear)});
  ExperimentCourse const course(e, machine());
  std::vector<double> bends;
  for (double t = course.next_bend(0.0); t != infinity; t = course.next_bend(t)) bends.push_back(t);
  EXPECT_EQ(bends, (std::vector<double>{72000.0, 72060.0, 72600.0, 72660.0, 86400.0}));
}

TEST(ExperimentCourse, AStepFollowsAirConditioningAndDoors) {
  Experiment e = experiment();
  EXPECT_EQ(ExperimentCourse(e, machine()).longest_step(), infinity);
  e.ambient.air_conditioning = AirConditioning{0.5, 1200.0};
  EXPECT_EQ(ExperimentCourse(e, machine()).longest_step(), 100.0);
  e.ambient.door_openings = {{60.0, 60.0, -3.0, 150.0}};
  EXPECT_EQ(ExperimentCourse(e, machine()).longest_step(), 75.0);
}

TEST(ExperimentCourse, ARecordedFloorTemperatureStands) {
  Experiment e = experiment();
  e.ambient.mean = 295.15;
  e.driven.push_back({{"ambient.floor_temperature", "K", "recorded"}, Signal(298.15)});
  ExperimentCourse const course(e, machine());
  EXPECT_EQ(at(course, "ambient.floor_temperature", 0.0), 298.15);
  EXPECT_EQ(std::count_if(course.channels().begin(), course.channels().end(),
                          [](auto const& c) { return c.name == "ambient.floor_temperature"; }),
            1);
}

TEST(ExperimentCourse, NextJumpIsStrictlyAfter) {
  ExperimentCourse const course(spectrum(), machine());
  EXPECT_EQ(course.next_jump(-1.0), 1800.0);
  EXPECT_EQ(course.next_jump(1799.0), 1800.0);
  EXPECT_EQ(course.next_jump(1800.0), 3600.0);
  EXPECT_EQ(course.next_jump(14400.0), infinity);
}

/// The same moment in two records, one in minutes.
TEST(ExperimentCourse, JumpsThatAreARoundingErrorApartAreOne) {
  double const early = 4.1 * 60.0, late = 246.0;
  ASSERT_LT(early, late);
  Experiment e = experiment(600.0);
  e.driven = {{{"spindle.speed", "rad/s", ""}, {{0.0, early}, {0.0, 100.0}, Interpolation::step}},
              {{"coolant.on", "1", ""}, {{0.0, late}, {0.0, 1.0}, Interpolation::step}}};
  ExperimentCourse const course(e, machine());
  EXPECT_EQ(jumps(course), (std::vector<double>{late}));
  for (double const t : {early - 1e-9, early, std::nextafter(late, 0.0), late}) {
    EXPECT_EQ(at(course, "spindle.speed", t), t == late ? 100.0 : 0.0) << late - t;
    EXPECT_EQ(at(course, "coolant.on", t), t == late ? 1.0 : 0.0) << late - t;
  }
}

TEST(ExperimentCourse, HasTheSpeedOfEachBlockToTheSample) {
  ExperimentCourse const course(spectrum(), machine());
  std::vector<double> const expected_rpm = {1500, 3000, 4500, 6000, 0, 4500, 3000, 6000, 0};
  std::vector<double> const from_min = {0, 30, 60, 90, 120, 135, 165, 195, 240, 300};
  for (int minute = 0; minute < 300; ++minute) {
    auto const block = std::upper_bound(from_min.begin(), from_min.end(), minute) - from_min.begin() - 1;
    double const rpm = expected_rpm[static_cast<std::size_t>(block)];
    EXPECT_NEAR(thermal::to_unit(at(course, "spindle.speed", 60.0 * minute), "rpm"), rpm, 1e-9) << minute;
    EXPECT_EQ(at(course, "spindle.running", 60.0 * minute), rpm > 0.0 ? 1.0 : 0.0) << minute;
  }
}

/// What the first sample shows holds from the start: a logger that begins after 90 s saw no start then.
TEST(ExperimentCourse, CountsTimeFromTheStartWhereTheRecordBeginsLater) {
  Experiment e = spectrum();
  e.driven.push_back(
      {{"spindle.speed", "rad/s", "recorded"}, Signal({90.0, 600.0}, {200.0, 300.0}, Interpolation::step)});
  ExperimentCourse const course(e, machine());
  for (double const t : {0.0, 60.0, 90.0, 900.0}) EXPECT_DOUBLE_EQ(at(course, "spindle.time_running", t), t);
}

TEST(ExperimentCourse, CountsTimeFromTheLastStartAndRevolutions) {
  ExperimentCourse const course(spectrum(), machine());
  EXPECT_DOUBLE_EQ(at(course, "spindle.time_running", 100 * 60.0), 100 * 60.0);
  EXPECT_EQ(at(course, "spindle.time_running", 125 * 60.0), 0.0);
  EXPECT_EQ(at(course, "spindle.time_running", 135 * 60.0), 0.0);
  EXPECT_DOUBLE_EQ(at(course, "spindle.time_running", 200 * 60.0), 65 * 60.0);
  double const revolutions = 30 * (1500 + 3000 + 4500 + 6000 + 4500 + 3000) + 45 * 6000;
  EXPECT_NEAR(at(course, "spindle.revolutions", 240 * 60.0), revolutions, 1e-6);
  EXPECT_NEAR(at(course, "spindle.revolutions", 300 * 60.0), revolutions, 1e-6);
}

/// Everything at once.
Experiment eventful() {
  Experiment result = spectrum();
  result.start_time_of_day = 22 * 3600.0;
  FeedProgram& feed = result.axes.emplace_back();
  feed.blocks = {{7000.0, 0.1, {}}};
  feed.resolved = true;
  feed.dwell = 3.0;
  result.ambient.stratification = 0.5;
  result.ambient.drift = 1e-4;
  result.ambient.daily_cycle.emplace();
  result.ambient.air_conditioning.emplace();
  result.ambient.door_openings = {{1000.0, 600.0, -3.0, 300.0}};
  result.coolant.blocks = {{1234.5, true}, {100.0, false}, {100.0, true}};
  result.chiller.blocks = {{777.0, true}};
  result.chiller.on = false;
  result.servo.blocks = {{500.0, false}};
  result.inputs = {{"heater1.duty", {{333.3, "70 %"}, {100.0, "20 %"}}}};
  return result;
}

TEST(ExperimentCourse, IsContinuousBetweenItsJumpsAndFromTheRightAtThem) {
  ExperimentCourse const course(eventful(), machine());
  std::size_t const n = course.channels().size();
  std::vector<double> left(n);
  std::vector<double> right(n);
  double const h = 1e-4;  // the steepest channel rises by 100 1/s
  for (double t = 0.0; t < 18000.0;) {
    double const end = std::min(course.next_jump(t), 18000.0);
    double const middle = 0.5 * (t + end);
    for (auto const& [a, b] : {std::pair{t, t + h}, std::pair{middle, middle + h}, std::pair{end - 2 * h, end - h}}) {
      if (a < t || b >= end) continue;
      course.evaluate(a, left);
      course.evaluate(b, right);
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(left[i], right[i], 0.02) << course.channels()[i].name << " " << a;
    }
    t = end;
  }
}

TEST(ExperimentCourse, MeetsDoorsSwitchesReversalsAndMidnight) {
  std::vector<double> const times = jumps(ExperimentCourse(eventful(), machine()));
  for (double const t : {1000.0, 1600.0, 1234.5, 1334.5, 1434.5, 777.0, 500.0, 333.3, 6.0, 9.0, 7200.0}) {
    bool const met = std::any_of(times.begin(), times.end(), [t](double x) { return std::abs(x - t) < 1e-9; });
    EXPECT_TRUE(met) << t;
  }
}

TEST(ExperimentCourse, SwitchesCoolantChillerAndDrives) {
  ExperimentCourse const course(eventful(), machine());
  EXPECT_EQ(at(course, "coolant.on", 1234.0), 1.0);
  EXPECT_EQ(at(course, "coolant.on", 1234.5), 0.0);
  EXPECT_EQ(at(course, "coolant.on", 1434.5), 0.0);
  EXPECT_EQ(at(course, "chiller.on", 777.0), 0.0);
  EXPECT_EQ(at(course, "servo.on", 499.0), 0.0);
  EXPECT_EQ(at(course, "servo.on", 500.0), 1.0);
  EXPECT_EQ(at(course, "machine.on", 0.0), 1.0);
  EXPECT_EQ(at(course, "coolant.temperature", 0.0), 293.15);
}

TEST(ExperimentCourse, TellsTheTimeOfDay) {
  ExperimentCourse const course(eventful(), machine());
  EXPECT_EQ(at(course, "time_of_day", 0.0), 22 * 3600.0);
  EXPECT_EQ(at(course, "time_of_day", 7200.0), 0.0);
  EXPECT_EQ(at(course, "time_of_day", 7300.0), 100.0);
  EXPECT_NEAR(at(course, "clock.day_cosine", 7200.0), 1.0, 1e-12);  // midnight
  EXPECT_NEAR(at(course, "clock.day_cosine", 14 * 3600.0), -1.0, 1e-12);
  EXPECT_NEAR(at(course, "clock.day_sine", 8 * 3600.0), 1.0, 1e-12);
  EXPECT_NEAR(at(course, "clock.day_sine", 0.0), -0.5, 1e-12);
}

TEST(ExperimentCourse, CarriesTheAir) {
  Experiment const e = eventful();
  ExperimentCourse const course(e, machine());
  for (double const t : {0.0, 1300.0, 9000.0}) {
    EXPECT_EQ(at(course, "ambient.temperature", t), air_temperature(e.ambient, e.start_time_of_day, t));
  }
  EXPECT_EQ(at(course, "ambient.gradient", 0.0), 0.5);
  EXPECT_EQ(at(course, "ambient.door", 1599.0), 1.0);
  EXPECT_EQ(at(course, "ambient.door", 1600.0), 0.0);
}

TEST(ExperimentCourse, MovesItsAxes) {
  Experiment e = experiment(3600.0);
  FeedProgram& feed = e.axes.emplace_back();
  feed.blocks = {{1800.0, from_unit(8000, "mm/min"), {}}};
  feed.duty = 0.88;
  ExperimentCourse const course(e, machine());
  EXPECT_NEAR(thermal::to_unit(at(course, "z.speed", 0.0), "rpm"), 704.0, 1e-9);
  EXPECT_NEAR(thermal::to_unit(at(course, "z.moving_speed", 0.0), "rpm"), 800.0, 1e-9);
  EXPECT_EQ(at(course, "z.moving_speed", 1800.0), 0.0);
  EXPECT_EQ(at(course, "z.running", 0.0), 1.0);
  EXPECT_EQ(at(course, "z.duty", 0.0), 0.88);
  EXPECT_EQ(at(course, "z.speed", 1800.0), 0.0);
  EXPECT_EQ(at(course, "z.stroke_from", 0.0), 0.12);
  EXPECT_EQ(at(course, "z.stroke_to", 0.0), 0.72);
  EXPECT_EQ(at(course, "x.speed", 0.0), 0.0);
  EXPECT_EQ(at(course, "x.stroke_to", 0.0), 0.4);
  EXPECT_EQ(jumps(course), (std::vector<double>{1800.0}));
}

/// ω = 2π v/l · d: a record of two of the three, whatever their rows and signs, is the motion of the programme.
TEST(ExperimentCourse, WhateverIsRecordedOfAScrewCarriesTheOthersAlong) {
  double const feed = from_unit(8000, "mm/min"), speed = 0.5 * from_unit(800, "rpm");
  Experiment programme = experiment(3600.0);
  FeedProgram& axis = programme.axes.emplace_back();
  axis.blocks = {{1800.0, feed, {}}, {1800.0, {}, {}}};
  axis.duty = 0.5;
  ExperimentCourse const due(programme, machine());
  auto const driven = [](std::string const& what, std::string const& unit, double value) -> DrivenChannel {
    return {{"z." + what, unit, "recorded"}, Signal({0.0, 900.0, 1800.0}, {value, value, 0.0}, Interpolation::step)};
  };
  auto const constant_duty = [](double duty) -> DrivenChannel { return {{"z.duty", "1", "recorded"}, Signal(duty)}; };
  Experiment const still = experiment(3600.0);
  std::vector<std::pair<Experiment, std::vector<DrivenChannel>>> const records = {
      {still, {driven("feed", "m/s", -feed), constant_duty(0.5)}},
      {still, {driven("feed", "m/s", feed), driven("duty", "1", 0.5)}},
      {still, {driven("speed", "rad/s", -speed), constant_duty(0.5)}},
      {still, {driven("speed", "rad/s", speed), driven("feed", "m/s", -feed)}},
      {programme, {driven("duty", "1", 0.5)}}};
  for (std::size_t r = 0; r < records.size(); ++r) {
    Experiment e = records[r].first;
    e.driven = records[r].second;
    ExperimentCourse const course(e, machine());
    for (double const t : {0.0, 1000.0, 1800.0, 3000.0})
      for (std::string const what : {"feed", "speed", "moving_speed", "running"})
        EXPECT_NEAR(at(course, "z." + what, t), at(due, "z." + what, t), 1e-12 * speed)
            << what << " at " << t << ", " << r;
    EXPECT_EQ(at(course, "z.duty", 0.0), 0.5) << r;
    EXPECT_EQ(course.next_jump(900.0), 1800.0) << r;
  }
}

TEST(ExperimentCourse, ASpeedOfAScrewAloneIsMotionAllTheTime) {
  Experiment e = experiment(3600.0);
  e.driven = {{{"z.speed", "rad/s", "recorded"}, Signal(-from_unit(800, "rpm"))}};
  ExperimentCourse const course(e, machine());
  EXPECT_NEAR(at(course, "z.feed", 0.0), from_unit(8000, "mm/min"), 1e-12);
  EXPECT_NEAR(at(course, "z.moving_speed", 0.0), from_unit(800, "rpm"), 1e-12);
  EXPECT_EQ(at(course, "z.duty", 0.0), 1.0);
  EXPECT_EQ(at(course, "z.running", 0.0), 1.0);
}

TEST(ExperimentCourse, AFollowedNutIsAStrokeOfNoLength) {
  ExperimentCourse const course(eventful(), machine());
  EXPECT_NEAR(at(course, "z.position", 3.0), 0.42, 1e-12);
  EXPECT_EQ(at(course, "z.stroke_from", 3.0), at(course, "z.position", 3.0));
  EXPECT_EQ(at(course, "z.stroke_to", 3.0), at(course, "z.position", 3.0));
}

TEST(ExperimentCourse, EveryChannelHasAnSIUnitAndAName) {
  std::map<std::string, int> names;
  ExperimentCourse const course(eventful(), machine());
  for (thermal::InputChannel const& channel : course.channels()) {
    EXPECT_EQ(from_unit(1.0, channel.unit), 1.0) << channel.name;
    EXPECT_FALSE(channel.description.empty()) << channel.name;
    EXPECT_EQ(++names[channel.name], 1) << channel.name;
  }
}

class RecordedCourse : public testing::Test {
 protected:
  Experiment recorded(std::string const& text, std::vector<RecordedColumn> const& columns, double duration) {
    tests::put(directory_ / "data.csv", text);
    Experiment result = experiment(duration);
    result.directory = directory_.path();
    Recording& recording = result.recorded.emplace_back();
    recording.file = "data.csv";
    recording.columns = columns;
    return result;
  }

  tests::TemporaryDirectory directory_;
};

TEST_F(RecordedCourse, ReplacesAndAddsChannels) {
  Experiment const e = recorded(
      "time_s,air,flow\n0,20,1\n100,22,1.5\n",
      {{"air", "ambient.temperature", "degC", "linear"}, {"flow", "water.mass_flow", "kg/s", "linear"}}, 100.0);
  ExperimentCourse const course(e, machine());
  EXPECT_DOUBLE_EQ(at(course, "ambient.temperature", 50.0), 294.15);
  EXPECT_DOUBLE_EQ(at(course, "water.mass_flow", 50.0), 1.25);
}

TEST_F(RecordedCourse, CarriesWhatFollowsFromTheSpeed) {
  Experiment const e =
      recorded("time_s,n\n0,0\n60,-600\n120,600\n180,0\n", {{"n", "spindle.speed", "rpm", "step"}}, 200.0);
  ExperimentCourse const course(e, machine());
  EXPECT_DOUBLE_EQ(at(course, "spindle.speed", 60.0), from_unit(600, "rpm"));
  EXPECT_EQ(at(course, "spindle.running", 59.0), 0.0);
  EXPECT_EQ(at(course, "spindle.running", 60.0), 1.0);
  EXPECT_DOUBLE_EQ(at(course, "spindle.time_running", 130.0), 70.0);
  EXPECT_NEAR(at(course, "spindle.revolutions", 200.0), 1200.0, 1e-9);
  EXPECT_EQ(jumps(course), (std::vector<double>{60.0, 180.0}));
}

TEST_F(RecordedCourse, CarriesWhatFollowsFromTheFeed) {
  Experiment const e = recorded("time_s,v\n0,0\n60,6000\n120,0\n", {{"v", "z.feed", "mm/min", "step"}}, 120.0);
  ExperimentCourse const course(e, machine());
  EXPECT_NEAR(thermal::to_unit(at(course, "z.speed", 60.0), "rpm"), 600.0, 1e-9);
  EXPECT_EQ(at(course, "z.running", 60.0), 1.0);
  EXPECT_EQ(at(course, "z.duty", 60.0), 1.0);
}

TEST_F(RecordedCourse, RefusesAnotherDimension) {
  Experiment const e = recorded("time_s,n\n0,0\n60,600\n", {{"n", "spindle.speed", "degC", "step"}}, 60.0);
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(e, machine()); }),
            "recorded[0].columns[0].unit: channel 'spindle.speed': recorded: n is in K, the channel in rad/s, for "
            "example \"6000 rpm\"");
  Experiment const share = recorded("time_s,n\n0,0\n60,40\n", {{"n", "spindle.speed", "%", "step"}}, 60.0);
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(share, machine()); }),
            "recorded[0].columns[0].unit: channel 'spindle.speed': recorded: n is in 1, the channel in rad/s, for "
            "example \"6000 rpm\"; or give a factor: unit = \"rpm\", "
            "factor = 50 reads % of 5000 rpm");
}

/// 22 degC that were written as 22 K.
TEST_F(RecordedCourse, RefusesAirThatNoMachineStandsIn) {
  Experiment const cold = recorded("time_s,air\n0,22\n60,23\n", {{"air", "ambient.temperature", "K", "linear"}}, 60.0);
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(cold, machine()); }),
            "recorded[0].columns[0].unit: channel 'ambient.temperature': recorded: air reaches 22 K; allowed is -50 "
            "degC to 80 degC; is its "
            "unit right?");
  Experiment e = experiment(60.0);
  e.inputs = {{"ambient.temperature", {{60.0, "22 K"}}}};
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(e, machine()); }),
            "inputs[0].blocks: channel 'ambient.temperature': programme reaches 22 K; allowed is -50 degC to 80 degC; "
            "is its unit "
            "right?");
  e.inputs = {{"coolant.temperature", {{60.0, "22 K"}}}};
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(e, machine()); }),
            "inputs[0].blocks: channel 'coolant.temperature': programme reaches 22 K; allowed is -60 degC to 150 degC; "
            "is its unit right?");
  e.inputs = {{"ambient.temperature", {{60.0, "22 degC"}}}};
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(e, machine()); }), "accepted");
}

/// 5 would make 500 W of a pump of 100 W, -1 would make it cool.
TEST_F(RecordedCourse, RefusesSwitchesThatAreMoreThanOn) {
  auto limits = machine();
  limits.shares = {"pump.on"};
  Experiment e = experiment(60.0);
  auto const programme = [&](std::string const& channel, std::string const& value) {
    e.inputs = {{channel, {{60.0, value}}}};
    return tests::refusal([&] { ExperimentCourse(e, limits); });
  };
  EXPECT_EQ(programme("machine.on", "5"),
            "inputs[0].blocks: channel 'machine.on': programme reaches 5; allowed is 0 (off) to 1 (on); is its unit "
            "right?");
  for (std::string const channel : {"spindle.running", "z.running", "ambient.door", "coolant.on", "chiller.on",
                                    "machine.on", "servo.on", "pump.on"})
    for (auto const& [value, is_right] : {std::pair{"0", true},
                                          {"0.4", true},
                                          {"100 %", true},
                                          {"1.1", false},
                                          {"5", false},
                                          {"101 %", false},
                                          {"-1", false}})
      EXPECT_EQ(programme(channel, value) == "accepted", is_right) << channel << " " << value;
  EXPECT_EQ(programme("tool.changes", "12"), "accepted");
  EXPECT_EQ(programme("spindle.revolutions", "1e6"), "accepted");
  auto const record = [&](std::string const& value) {
    auto const recorded_one = recorded("time_s,on\n0,0\n60," + value + "\n", {{"on", "pump.on", "1", "linear"}}, 60.0);
    return tests::refusal([&] { ExperimentCourse(recorded_one, limits); });
  };
  EXPECT_EQ(record("1.1"), "accepted");
  EXPECT_EQ(record("-0.1"), "accepted");
  EXPECT_EQ(record("100"),
            "recorded[0].columns[0].unit: channel 'pump.on': recorded: on reaches 100; allowed is 0 (off) to 1 (on); "
            "is its unit right?");
}

TEST_F(RecordedCourse, RefusesMotionThatTheMachineCannotMake) {
  auto const speed = [&](std::string const& rpm) {
    Experiment const e = recorded("time_s,n\n0,0\n60,-" + rpm + "\n", {{"n", "spindle.speed", "rpm", "step"}}, 60.0);
    return tests::refusal([&] { ExperimentCourse(e, machine()); });
  };
  EXPECT_EQ(speed("7100"), "accepted");
  EXPECT_EQ(speed("60000"),
            "recorded[0].columns[0].unit: channel 'spindle.speed': recorded: n reaches 60000 rpm, and the machine's "
            "maximum is 6000 rpm; is its unit "
            "right?");
  Experiment e = experiment(60.0);
  auto const programme = [&](std::string const& channel, std::string const& value) {
    e.inputs = {{channel, {{60.0, value}}}};
    return tests::refusal([&] { ExperimentCourse(e, machine()); });
  };
  EXPECT_EQ(programme("spindle.speed", "6000 rpm"), "accepted");
  EXPECT_TRUE(programme("spindle.speed", "6100 rpm")
                  .starts_with("inputs[0].blocks: channel 'spindle.speed': programme reaches 6100 rpm"));
  EXPECT_EQ(programme("z.feed", "24 m/min"), "accepted");
  EXPECT_TRUE(programme("z.feed", "25 m/min").starts_with("inputs[0].blocks: channel 'z.feed': programme reaches "));
}

TEST(ExperimentCourse, TakesNoPointOnTheScaleForADifference) {
  Experiment e = experiment(60.0);
  e.inputs = {{"chiller.offset", {{60.0, "2 degC"}}}};
  EXPECT_EQ(
      tests::refusal([&] { ExperimentCourse(e, machine()); }),
      "inputs[0].blocks: channel 'chiller.offset': programme is in degC; a difference is due, for example \"2 K\"");
  e.inputs = {{"chiller.offset", {{60.0, "2 K"}}}};
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(e, machine()); }), "accepted");
}

TEST_F(RecordedCourse, RefusesTwoDriversOfOneChannel) {
  Experiment e = recorded("time_s,n\n0,0\n60,600\n", {{"n", "heater1.duty", "%", "step"}}, 60.0);
  e.inputs = {{"heater1.duty", {{60.0, "50 %"}}}};
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(e, machine()); }),
            "recorded[0].columns[0].channel: channel 'heater1.duty' is driven twice, by inputs or recorded columns");
}

TEST(ExperimentCourse, NamesAxesThatAreMissing) {
  Experiment e = experiment(60.0);
  e.axes.emplace_back().axis = "zz";
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(e, machine()); }),
            "axes[0].axis: the machine has no axis 'zz'; did you mean 'z'?");
  e.axes.clear();
  e.laser.emplace().axis = "w";
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(e, machine()); }),
            "laser.axis: the machine has no axis 'w'; known: 'z', 'x'");
  e.laser.reset();
  e.axes.resize(2);
  EXPECT_EQ(tests::refusal([&] { ExperimentCourse(e, machine()); }), "axes[1].axis: axis 'z' has two programmes");
}

TEST(ExperimentCourse, OfATrulyIdleMachineNeverJumps) {
  Experiment const e = experiment(3600.0);
  EXPECT_EQ(ExperimentCourse(e, MachineLimits{}).next_jump(0.0), infinity);
}

}  // namespace
}  // namespace thermotwin::scenarios
