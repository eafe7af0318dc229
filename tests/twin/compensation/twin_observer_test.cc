#include "twin/compensation/twin_observer.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/twin/compensation/closed_loop.h"
#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using tests::close_loop;
using tests::simulated;

Machine g200() { return Machine::read(machine_file("g200")); }

/// A row of a run in the order of an observer's inputs.
std::vector<double> values_of(output::Dataset const& data, Eigen::Index row, std::vector<ModelInput> const& inputs,
                              bool with_sensors) {
  std::vector<double> values;
  for (auto const& input : inputs)
    for (auto const* channels : {&data.inputs, &data.readings})
      for (auto const& channel : *channels)
        if (channel.name == input.name) {
          EXPECT_EQ(channel.unit, input.unit) << input.name;
          values.push_back(input.sensor && !with_sensors ? std::nan("") : channel.values[row]);
        }
  EXPECT_EQ(values.size(), inputs.size());
  return values;
}

/// What the observer makes of a run: its estimate of a displacement against the truth [um], with or without its
/// sensors.
double largest_miss(output::Dataset const& data, bool with_sensors, std::string const& machine = "g200",
                    std::string const& displacement = "E_X") {
  TwinObserver observer(Machine::read(machine_file(machine)), displacement);
  auto const truth = std::find_if(data.truth_displacements.begin(), data.truth_displacements.end(),
                                  [&](auto const& channel) { return channel.name == displacement; });
  double worst = 0.0;
  for (Eigen::Index row = 0; row < data.time_s.size(); ++row) {
    auto const values = values_of(data, row, observer.inputs(), with_sensors);
    worst = std::max(worst, std::abs(observer.error(data.time_s[row], values) - truth->values[row]));
  }
  return worst;
}

/// A machine that is not quite what its file says: friction, flows, conductances.
std::map<std::string, std::string> const other_machine{
    {"bearing.front.grease_factor", "0.55"}, {"bearing.rear.grease_factor", "1.1"},
    {"heat.coolant_pump.power", "600 W"},    {"joint.bed.conductance", "12 W/K"},
    {"coolant_flow.jacket.flow", "6 L/min"}, {"film.bed_base.area", "3 m2"}};

TEST(TwinObserver, WithoutSensorsIsTheSimulation) {
  auto const data = simulated("duty_003", 10.0);
  EXPECT_LT(largest_miss(data, false), 0.05);
}

TEST(TwinObserver, TakesTheAirOfTheRoomToBeThatAtTheReferenceHeight) {
  for (char const* const height : {"0 m", "1 m", "2.5 m"}) {
    auto const rest = read_experiment(parse_toml(std::string(R"(
      title = "at rest in layered air"
      machine = "v450"
      duration = "4 h"
      sampling = "1 min"
      ambient.stratification = "1.5 K/m"
      ambient.reference_height = ")") + height + "\"\n",
                                                 "rest.toml"),
                                      "rest.toml");
    auto const data = run(Machine::read(machine_file("v450")), rest, {}).dataset;
    EXPECT_LT(largest_miss(data, false, "v450", "E_Z"), 0.05) << height;
  }
}

TEST(TwinObserver, SensorsMakeItFollowAMachineThatIsNotQuiteIts) {
  auto const data = simulated("duty_003", 10.0, other_machine);
  double const alone = largest_miss(data, false), corrected = largest_miss(data, true);
  EXPECT_GT(alone, 2.0);
  EXPECT_LT(corrected, 0.5);
}

/// Switched on while the machine is warm from work: what it grows and shrinks by from then on, by an observer that
/// knows its numbers, against the truth [um]. Where its sensors are silent at first, it begins with the room.
double largest_miss_after_work(bool silent_at_first) {
  auto const day = read_experiment(parse_toml(R"(
    title = "work, then the observer is switched on"
    machine = "v450"
    duration = "10 h"
    sampling = "1 min"
    [spindle]
    blocks = [{duration = "4 h", speed = "6000 rpm"}, {duration = "3 h", speed = "0 rpm"},
              {duration = "3 h", speed = "3000 rpm"}])",
                                              "day.toml"),
                                   "day.toml");
  auto const data = run(Machine::read(machine_file("v450")), day, {}).dataset;
  TwinObserver observer(Machine::read(machine_file("v450")), "E_Z");
  auto const truth = find_channel(data.truth_displacements, "E_Z")->values;
  Eigen::Index const on = 4 * 60 + 30;
  double worst = 0.0;
  for (Eigen::Index row = on; row < data.time_s.size(); ++row) {
    double const said =
        observer.error(data.time_s[row], values_of(data, row, observer.inputs(), row > on || !silent_at_first));
    worst = std::max(worst, std::abs(said - (truth[row] - truth[on])));
  }
  return worst;
}

TEST(TwinObserver, BeginsAsWarmAsItsSensorsTell) {
  double const with_room = largest_miss_after_work(true);
  EXPECT_GT(with_room, 10.0);
  EXPECT_LT(largest_miss_after_work(false), 0.2 * with_room);
}

/// The growth of a screw at the nut, less the scale's: linear in temperatures as displacements are. A screw that turns
/// carries no sensor; those of its nut and bearings tell what its friction makes of it.
TEST(TwinObserver, FollowsTheErrorAlongAScrew) {
  auto const follow = [](std::map<std::string, std::string> const& changes, bool with_sensors) {
    return largest_miss(simulated("feed_12000", 10.0, changes, "vmc850"), with_sensors, "vmc850", "E_P_720mm");
  };
  EXPECT_LT(follow({}, false), 0.05);
  std::map<std::string, std::string> const other_nut{{"ball_nut.nut.preload", "800 N"}};
  double const alone = follow(other_nut, false);
  EXPECT_GT(alone, 2.0);
  EXPECT_LT(follow(other_nut, true), 0.5 * alone);
}

/// The twin is the machine's own, and knows what the sensor missed: 10 K.
TEST(TwinObserver, TakesASensorThatIsHeardLateFromWhatItSeesThen) {
  auto data = simulated("duty_003", 10.0);
  auto& late = *std::find_if(data.readings.begin(), data.readings.end(), [](auto const& r) { return r.name == "T3"; });
  Eigen::VectorXd const shown = late.values.array() - late.values[0];
  constexpr Eigen::Index silent = 200, heard = 90;
  ASSERT_GT(shown[silent], 8.0);
  late.values.head(silent).setConstant(std::nan(""));
  TwinObserver observer(g200(), "E_X");
  for (Eigen::Index row = 0; row < silent + heard; ++row) {
    static_cast<void>(observer.error(data.time_s[row], values_of(data, row, observer.inputs(), true)));
    if (row >= silent) {
      ASSERT_NEAR(observer.change("T3"), shown[row], 0.5) << data.time_s[row] << " s";
    }
  }
}

TEST(TwinObserver, InTheLoopLeavesThreeMicrometresOfTheDiameter) {
  auto const data = simulated("duty_003", 10.0, other_machine);
  CompensationSettings settings;
  settings.shift.dead_band = 0.5;
  settings.watch.fastest = 0.5;  // a bearing ring warms by 2 K in 10 s
  CompensationLoop loop({TwinObserver(g200(), "E_X"), settings}, {10.0, 1.0, 30.0, 30.0});
  auto const played = close_loop(loop, VirtualMachine(data, {}));
  EXPECT_GT(2.0 * played.largest_error(), 27.0);
  EXPECT_LE(2.0 * played.largest_residual(), 3.0);
}

TEST(TwinObserver, GoesOnWithoutASensorAndNotWithoutAnInput) {
  auto const data = simulated("duty_003", 10.0, other_machine);
  for (auto const& [silent, goes_on] : {std::pair{"/T2", true}, {"/spindle.speed", false}}) {
    CompensationSettings settings;
    settings.watch.fastest = 0.5;
    CompensationLoop loop({TwinObserver(g200(), "E_X"), settings}, {10.0, 1.0, 30.0, 30.0});
    Decision last;
    auto const played = close_loop(
        loop, VirtualMachine(data, {}),
        [ending = std::string(silent)](double time, std::string const& topic, std::string& payload) {
          if (time > 600.0 && topic.ends_with(ending)) payload.clear();
        },
        [&](Decision const& decision) { last = decision; });
    EXPECT_EQ(last.support, goes_on ? Support::good : Support::off) << silent;
    EXPECT_EQ(last.faults.size(), 1u);
    EXPECT_LE(played.worst_excess(), settings.shift.dead_band);
    if (goes_on) {
      EXPECT_LT(2.0 * played.largest_residual(), 5.0);
    }
  }
}

/// What a run showed in a row, as told at a time.
std::vector<Reading> readings_of(output::Dataset const& data, Eigen::Index row, double time,
                                 std::vector<ModelInput> const& inputs) {
  std::vector<Reading> readings;
  for (auto const* channels : {&data.inputs, &data.readings})
    for (auto const& channel : *channels)
      if (std::any_of(inputs.begin(), inputs.end(), [&](auto const& input) { return input.name == channel.name; }))
        readings.push_back({channel.name, channel.values[row], channel.unit, time, "good"});
  return readings;
}

/// What the machine did in a night nobody knows; for a minute or two it did what it had done before.
TEST(TwinObserver, BeginsAnewAfterANightAndNotAfterAMinute) {
  auto const data = simulated("duty_003", 10.0);
  CompensationSettings settings;
  settings.watch.fastest = 0.5;
  settings.shift.slew = 1000.0;
  Compensator compensator(TwinObserver(g200(), "E_X"), settings);
  Decision decision;
  auto const hear = [&](Eigen::Index row, double time) {
    decision = compensator.step(time, readings_of(data, row, time, compensator.inputs()), 10.0);
  };
  Eigen::Index const half = data.time_s.size() / 2;
  for (Eigen::Index row = 0; row < half; ++row) {
    hear(row, data.time_s[row]);
    EXPECT_FALSE(decision.warm_begin);
  }
  double const warm = decision.error;
  ASSERT_GT(std::abs(warm), 5.0);
  double const soon = data.time_s[half] + 100.0, tomorrow = soon + 12.0 * 3600.0;
  hear(half, soon);
  EXPECT_FALSE(decision.anew);
  EXPECT_NEAR(decision.error, warm, 0.2 * std::abs(warm));
  hear(half + 1, tomorrow);
  EXPECT_TRUE(decision.anew);
  ASSERT_TRUE(decision.warm_begin);
  EXPECT_EQ(decision.warm_begin->contradicted, "");
  EXPECT_GT(decision.warm_begin->deviation, 0.1);
  EXPECT_LT(decision.warm_begin->deviation, 3.0);
  EXPECT_EQ(decision.error, 0.0);
  EXPECT_EQ(decision.offset, 0.0);
  hear(half + 2, tomorrow + 10.0);
  EXPECT_FALSE(decision.anew);
  EXPECT_FALSE(decision.warm_begin);
  EXPECT_EQ(decision.support, Support::good);
  EXPECT_LT(std::abs(decision.error), 1.0);
}

/// One that is not among them is as one that is never believed.
TEST(TwinObserver, FollowsTheNamedSensorsInTheirOrder) {
  auto const data = simulated("duty_003", 60.0, other_machine);
  TwinObserver some(g200(), "E_X", {}, std::vector<std::string>{"T10", "T2"}), all(g200(), "E_X");
  auto const machine = std::size_t(
      std::count_if(all.inputs().begin(), all.inputs().end(), [](auto const& input) { return !input.sensor; }));
  ASSERT_EQ(some.inputs().size(), machine + 2);
  EXPECT_EQ(some.inputs()[machine].name, "T10");
  EXPECT_EQ(some.inputs()[machine + 1].name, "T2");
  for (Eigen::Index row = 0; row < 100; ++row) {
    auto told = values_of(data, row, all.inputs(), true);
    for (std::size_t i = 0; i < told.size(); ++i)
      if (auto const& input = all.inputs()[i]; input.sensor && input.name != "T10" && input.name != "T2")
        told[i] = std::nan("");
    ASSERT_NEAR(some.error(data.time_s[row], values_of(data, row, some.inputs(), true)),
                all.error(data.time_s[row], told), 1e-9);
  }
  EXPECT_THROW(static_cast<void>(some.change("T3")), thermal::InputError);
}

TEST(TwinObserver, RefusesWhatItCannotObserve) {
  try {
    TwinObserver const observer(g200(), "E_X", {}, std::vector<std::string>{"T2", "T99"});
    FAIL() << "not refused";
  } catch (thermal::InputError const& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("the twin has no sensor 'T99' on a body; did you mean 'T"));
  }
  try {
    TwinObserver const observer(g200(), "E_x");
    FAIL() << "not refused";
  } catch (thermal::InputError const& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("the machine has no displacement 'E_x'; did you mean 'E_X'?"));
  }
  try {
    TwinObserver const observer(g200(), "B");
    FAIL() << "not refused";
  } catch (thermal::InputError const& error) {
    EXPECT_STREQ(error.what(), "'B' of the machine is an angle; the twin observes displacements in um");
  }
  try {
    auto document = read_toml(machine_file("vmc850"));
    set_parameter(document, "ball_screw.E_P_fixed.unilateral", "true");
    TwinObserver const observer(Machine::build(document), "E_P_fixed_720mm");
    FAIL() << "not refused";
  } catch (thermal::InputError const& error) {
    EXPECT_STREQ(error.what(),
                 "'E_P_fixed_720mm' is the error along a screw that loses its pretension; the twin observes what is "
                 "linear in temperatures: displacements, and errors along other screws");
  }
  EXPECT_THROW(TwinObserver(Machine::read(machine_file("v450_fine")), "E_Z"), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
