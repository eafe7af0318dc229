#include "twin/diagnosis/plausibility.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/refusal.h"
#include "tests/twin/diagnosis/diagnosis_bench.h"

/// Mistakes of people who bring data, made one at a time in the run of a machine whose file is rough and lacks a heat.
namespace thermotwin::twin {
namespace {

using Eigen::VectorXd;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class PlausibilityTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Value truth = tests::with_table(read_toml(machine_file("v450")), R"(
      [[heat]]
      name = "cabinet"
      at = "column_rear"
      power = "60 W"
      while_on = "machine.on")");
    set_parameter(truth, "bearing.front.grease_factor", "0.6");
    set_parameter(truth, "film.motor.coefficient", "18 W/(m2 K)");
    auto const made = run(Machine::build(truth), tests::experiment(R"(
      duration = "10 h"
      seed = 4
      ambient.mean = "22 degC"
      ambient.daily_cycle.amplitude = "1.5 K"
      [spindle]
      blocks = [{duration = "90 min", speed = "5000 rpm"}, {duration = "1 h", speed = "1000 rpm"},
                {duration = "80 min", speed = "4500 rpm"}, {duration = "50 min", speed = "0 rpm"},
                {duration = "1 h", speed = "6000 rpm"}, {duration = "70 min", speed = "2000 rpm"},
                {duration = "50 min", speed = "5000 rpm"}, {duration = "2 h", speed = "0 rpm"}])"),
                          {})
                          .dataset;
    sound.time_s = made.time_s;
    sound.inputs = made.inputs;
    sound.readings = made.readings;
    sound.displacements = made.displacements;
  }
  void SetUp() override { data = sound; }

  static VectorXd& values(std::vector<output::Channel>& channels, std::string const& name) {
    return std::find_if(channels.begin(), channels.end(), [&](auto const& c) { return c.name == name; })->values;
  }
  VectorXd& input(std::string const& name) { return values(data.inputs, name); }
  VectorXd& sensor(std::string const& name) { return values(data.readings, name); }
  VectorXd& displacement(std::string const& name) { return values(data.displacements, name); }
  void cut_before(Eigen::Index row) {
    auto const rows = data.time_s.size() - row;
    for (auto* group : {&data.inputs, &data.readings, &data.displacements})
      for (auto& channel : *group) channel.values = channel.values.tail(rows).eval();
    data.time_s = data.time_s.tail(rows).eval();
  }

  /// The texts of what is doubted.
  std::vector<std::string> said() const {
    Machine const machine = Machine::read(machine_file("v450"));
    auto const run = measured_run(data, machine, "run");
    std::vector<std::string> texts;
    for (auto const& doubt : doubts(machine, {bin(run, fitting_interval(run))})) texts.push_back(doubt.text);
    return texts;
  }

  static output::Dataset sound;
  output::Dataset data;
};

output::Dataset PlausibilityTest::sound;

TEST_F(PlausibilityTest, SoundDataOfARoughFileAreNotDoubtedThoughAHeatIsMissing) { EXPECT_THAT(said(), IsEmpty()); }

TEST_F(PlausibilityTest, NorIsAChannelOfWhichReadingsAreMissing) {
  for (auto& channel : data.readings)
    for (Eigen::Index row = 0; row < data.time_s.size(); row += 3) channel.values[row] = NAN;
  sensor("T3").setConstant(NAN);
  displacement("E_Y").setConstant(NAN);
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(PlausibilityTest, SignOfADisplacement) {
  displacement("E_Z") *= -1.0;
  EXPECT_THAT(said(), ElementsAre(StartsWith("E_Z moves against the machine (correlation -0.9")));
}

TEST_F(PlausibilityTest, UnitOfADisplacement) {
  for (double const factor : {1e6, 1e3, 1e-3, 1e-6}) {
    data = sound;
    displacement("E_Z") *= factor;
    EXPECT_THAT(said(), ElementsAre(AllOf(StartsWith("E_Z moves by "), HasSubstr("is its unit right?"))));
  }
}

TEST_F(PlausibilityTest, FahrenheitOfASensor) {
  sensor("T6") = (1.8 * sensor("T6").array() + 32.0).matrix();
  EXPECT_THAT(said(), ElementsAre(AllOf(StartsWith("T6 begins at 7"), HasSubstr("degF"))));
}

TEST_F(PlausibilityTest, UnitOfADisplacementUnlikeTheMachine) {
  VectorXd& e = displacement("E_Z");
  for (Eigen::Index row = 0; row < e.size(); ++row) e[row] = 1e7 * std::sin(0.3 * double(row));
  EXPECT_THAT(said(), ElementsAre(AllOf(StartsWith("E_Z moves by "), HasSubstr("is its unit right?"))));
}

TEST_F(PlausibilityTest, CelsiusOfASensorCalledFahrenheit) {
  sensor("T6") = ((sensor("T6").array() - 32.0) / 1.8).matrix();
  EXPECT_THAT(said(), ElementsAre(AllOf(StartsWith("T6 begins at -5."), HasSubstr("is its unit right?"))));
}

TEST_F(PlausibilityTest, FahrenheitOfAll) {
  for (auto& channel : data.readings) channel.values = (1.8 * channel.values.array() + 32.0).matrix();
  input("ambient.temperature") = (1.8 * input("ambient.temperature").array() + 32.0).matrix();
  EXPECT_THAT(said(), ElementsAre(StartsWith("the room is at 7")));
}

/// T10 hangs in it.
TEST_F(PlausibilityTest, ARoomGivenAsSteadyThatIsNot) {
  input("ambient.temperature").setConstant(22.0);
  auto const mean = sensor("T10").mean();
  sensor("T10") = (mean + 3.0 * (sensor("T10").array() - mean)).matrix();
  EXPECT_THAT(said(), ElementsAre(AllOf(StartsWith("the room is given as steady, and T10, which hangs in the air"),
                                        HasSubstr("is there no record of the room?"))));
}

TEST_F(PlausibilityTest, TwoSensorsSwapped) {
  std::swap(sensor("T6"), sensor("T8"));
  EXPECT_THAT(said(), ElementsAre(StartsWith("T6 follows what T8 should show")));
}

/// With more sensors its start is estimated.
TEST_F(PlausibilityTest, AMachineThatWasNotAtRest) {
  cut_before(Eigen::Index(data.time_s.size() / 8));
  EXPECT_THAT(said(), IsEmpty());
  data.readings.resize(3);
  EXPECT_THAT(said(), ElementsAre(StartsWith("the run does not start at rest with the room: T1 +")));
}

TEST_F(PlausibilityTest, AClockThatIsOff) {
  Eigen::Index const rows = data.time_s.size();
  auto const late = Eigen::Index(std::round(1200.0 / (data.time_s[1] - data.time_s[0])));
  VectorXd& speed = input("spindle.speed");
  speed.head(rows - late) = speed.tail(rows - late).eval();
  EXPECT_THAT(said(), ElementsAre(HasSubstr("min after what the inputs say; is a clock off?")));
}

TEST_F(PlausibilityTest, SpeedInTurnsPerSecond) {
  input("spindle.speed") /= 60.0;
  EXPECT_THAT(said(), ElementsAre(HasSubstr("the spindle reaches 100 of 6000 rpm; is the unit of its speed right?")));
}

TEST_F(PlausibilityTest, ARoomThatFollowsTheSpindle) {
  input("ambient.temperature") = sensor("T8");
  EXPECT_THAT(said(), ElementsAre(HasSubstr("does its sensor hang on the machine?")));
}

TEST_F(PlausibilityTest, UnitOfTime) {
  data.time_s /= 60.0;
  EXPECT_THAT(said(), ElementsAre(HasSubstr("in 10 min; is `time_unit` right?")));
  data.time_s /= 60.0;
  EXPECT_THAT(said(), ElementsAre(HasSubstr("the run lasts 10 s in all; is `time_unit` right?")));
  data.time_s *= 1e6;
  EXPECT_THAT(said(), ElementsAre(HasSubstr("days; is `time_unit` right?")));
}

TEST_F(PlausibilityTest, ARunThatIsGivenTwice) {
  Machine const machine = Machine::read(machine_file("v450"));
  auto const once = measured_run(data, machine, "run1"), again = measured_run(data, machine, "copy");
  auto const all = doubts(machine, {bin(once, 300.0), bin(again, 300.0)});
  ASSERT_EQ(all.size(), 1);
  EXPECT_EQ(all[0].run, "copy");
  EXPECT_THAT(all[0].text, HasSubstr("holds the same readings as run1, given as number 1"));
  EXPECT_THAT(doubt_lines(all), HasSubstr("Look at the data first"));
  EXPECT_EQ(doubt_lines({}), "");
}

TEST_F(PlausibilityTest, ASensorThatWasExchangedBetweenTwoRuns) {
  Machine const machine = Machine::read(machine_file("v450"));
  auto const before = measured_run(data, machine, "monday");
  for (auto& reading : data.readings) reading.values.array() += 0.1;  // another morning
  auto const same = measured_run(data, machine, "tuesday");
  EXPECT_TRUE(doubts(machine, {bin(before, 300.0), bin(same, 300.0)}).empty());
  sensor("T8").array() -= 0.7;
  auto const after = measured_run(data, machine, "tuesday");
  auto const all = doubts(machine, {bin(before, 300.0), bin(after, 300.0)});
  ASSERT_EQ(all.size(), 1);
  EXPECT_EQ(all[0].channel, "T8");
  EXPECT_EQ(all[0].text,
            "T8 stands -0.7 K otherwise against the other sensors than at the start of monday; was it exchanged, or "
            "calibrated anew?");
}

/// Where there is no fit, people are told what may be why.
TEST(Doubts, FollowTheComplaintOfAFit) {
  std::vector<Doubt> const doubts = {{"monday", "", "the run lasts 5 s in all; is `time_unit` right?"}};
  auto const fail = []() -> int { throw thermal::InputError("the machine cannot be run"); };
  auto const complaint = [&](std::vector<Doubt> const& told) {
    return thermotwin::tests::refusal([&] { (void)with_doubts(told, fail); });
  };
  EXPECT_THAT(complaint(doubts), StartsWith("the machine cannot be run"));
  EXPECT_THAT(complaint(doubts), HasSubstr("the run lasts 5 s in all; is `time_unit` right?"));
  EXPECT_EQ(complaint({}), "the machine cannot be run");
}

}  // namespace
}  // namespace thermotwin::twin
