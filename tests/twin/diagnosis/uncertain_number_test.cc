#include "twin/diagnosis/uncertain_number.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>
#include <utility>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "thermal/evaluation.h"
#include "twin/diagnosis/calibration.h"
#include "twin/diagnosis/number_derivatives.h"
#include "twin/machine.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {
namespace {

/// A machine's document, made ready, and what is uncertain in it.
struct Uncertain {
  explicit Uncertain(Value of) : document(std::move(of)), numbers(uncertain_numbers(document)) {}

  [[nodiscard]] UncertainNumber const* find(std::string const& path) const {
    auto const it = std::find_if(numbers.begin(), numbers.end(), [&](auto const& n) { return n.path == path; });
    return it == numbers.end() ? nullptr : &*it;
  }

  Value document;
  std::vector<UncertainNumber> numbers;
};

TEST(UncertainNumbers, OfTheLumpedMachineAreItsJointsFilmsLossesMassesAndGrowth) {
  Uncertain const v450(tests::v450());
  struct Expected {
    char const* path;
    double nominal, deviation;
  };
  for (auto const& [path, nominal, deviation] :
       {Expected{"joint.front_seat.coefficient", 3000.0, 0.30}, Expected{"joint.guide.conductance", 18.0, 0.30},
        Expected{"bearing.front.conductance", 9.0, 0.30}, Expected{"bearing.front.grease_factor", 0.55, 0.25},
        Expected{"bearing.rear.grease_factor", 0.55, 0.25}, Expected{"motor_loss.stator.constant", 18.0, 0.25},
        Expected{"motor_loss.rotor.hysteresis", 7.5, 0.25}, Expected{"belt.belt.loss", 45.0, 0.25},
        Expected{"film.head_front.area", 0.55, 0.20}, Expected{"film.motor.coefficient", 22.0, 0.20},
        Expected{"lump.column_rear.mass", 230.0, 0.10}, Expected{"lump.front_ring.heat_capacity", 282.0, 0.10},
        Expected{"bar.test_bar.capacity_factor", 1.0, 0.10}, Expected{"bar.shaft.capacity_factor", 1.0, 0.10},
        Expected{"bearing.front.viscosity_temperature", 748.0, 0.04},
        Expected{"bearing.rear.viscous_exponent", 2.0 / 3.0, 0.30},
        Expected{"displacement.E_Z.segment.0.growth_factor", 1.0, 0.10},
        Expected{"displacement.E_Z.segment.6.growth_factor", 1.0, 0.10},
        Expected{"rotation.A.segment.1.growth_factor", 1.0, 0.10}}) {
    auto const* number = v450.find(path);
    ASSERT_TRUE(number) << path;
    EXPECT_NEAR(number->nominal, nominal, 1e-9 * nominal) << path;
    EXPECT_EQ(number->deviation, deviation) << path;
  }
}

/// Balls that roll conduct otherwise than at rest, nobody knows in which direction.
TEST(UncertainNumbers, OfABearingIsWhatItsConductanceGainsWithSpeed) {
  Uncertain const v450(tests::v450());
  auto const* gain = v450.find("bearing.front.conductance_speed");
  ASSERT_TRUE(gain);
  EXPECT_EQ(gain->nominal, 0.0);
  EXPECT_DOUBLE_EQ(gain->deviation, 0.1 * 9.0);
  EXPECT_DOUBLE_EQ(gain->value(-1.5), -1.5);
  EXPECT_GT(9.0 + gain->value(gain->lower), 0.0);
  auto const d = differentiate(v450.document, gain->path);
  EXPECT_TRUE(changes_heat(d.network));
}

TEST(UncertainNumbers, ABarsCapacityFactorIsAFactorOfItsCapacities) {
  Uncertain v450(tests::v450());
  auto const before = Machine::build(v450.document).network().capacity();
  auto const range = Machine::build(v450.document).network().range("test_bar");
  set_number(v450.document, find_number(v450.document, "bar.test_bar.capacity_factor"), 1.2);
  auto const after = Machine::build(v450.document).network().capacity();
  for (int i = 0; i < int(before.size()); ++i) {
    bool const inside = i >= range.first && i < range.first + range.count;
    EXPECT_DOUBLE_EQ(after[std::size_t(i)], (inside ? 1.2 : 1.0) * before[std::size_t(i)]) << i;
  }
}

/// What a table leaves to its default, as the conductances of a nut, is not known better.
TEST(UncertainNumbers, OfTheOtherMachinesAreNutsScrewsAndTheOilToo) {
  auto const of = [](std::string const& name) { return Uncertain(read_toml(machine_file(name))); };
  auto const axis = of("vmc850"), spindle = of("g200");
  for (auto const& [numbers, path, deviation] : {std::tuple{&axis, "ball_nut.nut.preload", 0.25},
                                                 {&axis, "feed_motor.motor.resistance", 0.20},
                                                 {&axis, "ball_nut.nut.conductance_rest", 0.30},
                                                 {&axis, "ball_nut.nut.conductance_speed", 0.30},
                                                 {&axis, "ball_screw.E_P.growth_factor", 0.10},
                                                 {&spindle, "coolant_flow.jacket.inlet_offset", 0.3},
                                                 {&spindle, "coolant_flow.jacket.flow", 0.20}}) {
    ASSERT_TRUE(numbers->find(path)) << path;
    EXPECT_EQ(numbers->find(path)->deviation, deviation) << path;
  }
}

/// What was measured with a rule or a balance, or read from a handbook, is none.
TEST(UncertainNumbers, DoNotContainWhatIsKnown) {
  Uncertain const v450(tests::v450());
  for (auto const* path : {"joint.front_seat.area", "bar.shaft.outer_diameter", "bar.shaft.length", "bearing.front.oil",
                           "bearing.front.count", "bearing.front.pitch_diameter", "material.casting.expansion",
                           "temperature_sensor.T1.lag", "film.test_bar.diameter"})
    EXPECT_FALSE(v450.find(path)) << path;
}

/// Without drawings: a weight of nothing may become anything, in proportion.
TEST(UncertainNumbers, OfASegmentWithoutAWeightIsTheWeight) {
  Value document = tests::v450();
  auto& channel = std::get<Value::List>(document.find("displacement")->content)[0];
  auto& segment = std::get<Value::List>(channel.find("segment")->content)[0];
  auto& keys = std::get<Value::Table>(segment.content);
  std::erase_if(keys, [](auto const& entry) { return entry.key == "weight"; });
  keys.push_back({"weight", segment.where, {segment.where, std::int64_t{0}}});
  std::string const name = std::get<std::string>(channel.find("name")->content);
  Uncertain const machine(document);
  auto const* weight = machine.find("displacement." + name + ".segment.0.weight");
  ASSERT_TRUE(weight);
  EXPECT_FALSE(machine.find("displacement." + name + ".segment.0.growth_factor"));
  EXPECT_EQ(weight->value(0.0), 0.0);
  EXPECT_EQ(weight->value(-0.4), -0.4);
  EXPECT_EQ(weight->slope(-0.4), 1.0);
  EXPECT_EQ(weight->deviation, 1.0);
  EXPECT_FALSE(machine.find("bearing.front.viscous_exponent"));
  auto const* mass = machine.find("lump.column_rear.mass");
  ASSERT_TRUE(mass);
  EXPECT_DOUBLE_EQ(mass->value(0.2), 230.0 * std::exp(0.2));
  EXPECT_DOUBLE_EQ(mass->slope(0.2), mass->value(0.2));
  auto const d = differentiate(machine.document, weight->path);
  EXPECT_TRUE(std::any_of(d.displacements.begin(), d.displacements.end(),
                          [](auto const& weights) { return !weights.empty(); }));
}

/// What its author knows to a range only, of whatever kind: even within it, nowhere else.
TEST(UncertainNumbers, OfAStatedRangeStayWithinIt) {
  Value document = tests::v450();
  auto const where = document.where;
  auto const text = [&](char const* key, char const* value) {
    return Value::Entry{key, where, {where, std::string(value)}};
  };
  Value::List ranges;
  ranges.push_back(
      {where, Value::Table{text("name", "joint.guide.conductance"), text("from", "9 W/K"), text("to", "36 W/K")}});
  ranges.push_back(
      {where, Value::Table{text("name", "bar.shaft.outer_diameter"), text("from", "64 mm"), text("to", "74 mm")}});
  std::get<Value::Table>(document.content).push_back({"uncertain", where, {where, ranges}});
  Uncertain const v450(document);
  auto const* guide = v450.find("joint.guide.conductance");
  ASSERT_TRUE(guide);
  EXPECT_NEAR(guide->value(guide->lower), 9.0, 1e-9);
  EXPECT_NEAR(guide->value(guide->upper), 36.0, 1e-9);
  EXPECT_NEAR(guide->deviation, std::log(4.0) / std::sqrt(12.0), 1e-12);
  auto const* shaft = v450.find("bar.shaft.outer_diameter");
  ASSERT_TRUE(shaft);
  EXPECT_EQ(shaft->unit, "mm");
  EXPECT_NEAR(shaft->value(shaft->upper), 0.074, 1e-12);
  EXPECT_EQ(v450.numbers.size(), Uncertain(tests::v450()).numbers.size() + 1);
}

/// A sensor's stem is neither heat nor growth.
TEST(UncertainNumbers, OfAStatedRangeMayActOnReadingsAlone) {
  Value const document = tests::with_table(tests::v450(), R"(
[[sensor_contact]]
name = "stem"
sensor = "T3"
air_share = 0.03
[[uncertain]]
name = "sensor_contact.stem.air_share"
from = "0.0"
to = "0.2"
)");
  Uncertain const machine(document);
  auto const* share = machine.find("sensor_contact.stem.air_share");
  ASSERT_TRUE(share);
  NumberDerivatives const derivatives(machine.document, machine.numbers);
  for (std::size_t i = 0; i < machine.numbers.size(); ++i)
    EXPECT_EQ(derivatives.is_read_directly(i), machine.numbers[i].path == share->path) << machine.numbers[i].path;
  Value truth = document;
  set_parameter(truth, "sensor_contact.stem.air_share", "0.1");
  auto run = tests::measured(truth, tests::two_speeds());
  tests::add_noise(run, 0.02, 0.05e-6, 7);
  std::vector<BinnedRun> const data = {bin(run, 300.0)};
  auto const calibration = calibrate(document, data);
  auto const& numbers = calibration.numbers;
  auto const found = std::find_if(numbers.begin(), numbers.end(),
                                  [&](auto const& estimate) { return estimate.number.path == share->path; });
  ASSERT_NE(found, numbers.end());
  EXPECT_TRUE(found->identified);
  EXPECT_NEAR(found->estimate(), 0.1, 0.03);
}

class UncertainNumbersOf : public testing::TestWithParam<char const*> {};

TEST_P(UncertainNumbersOf, StandInTheFileOnceAndCanBeSet) {
  Uncertain const machine(read_toml(machine_file(GetParam())));
  EXPECT_GT(machine.numbers.size(), 2U);
  std::set<std::string> paths;
  Value changed = machine.document;
  for (auto const& number : machine.numbers) {
    EXPECT_TRUE(paths.insert(number.path).second) << number.path << " twice";
    auto const parameter = find_number(machine.document, number.path);
    EXPECT_EQ(parameter.value, number.nominal) << number.path;
    EXPECT_EQ(parameter.dimension, number.dimension) << number.path;
    EXPECT_TRUE(number.nominal > 0.0 || number.of_either_sign) << number.path;
    EXPECT_GT(number.deviation, 0.0) << number.path;
    set_number(changed, parameter, 1.1 * number.nominal);
    EXPECT_NEAR(find_number(changed, number.path).value, 1.1 * number.nominal, 1e-9 * number.nominal) << number.path;
  }
  EXPECT_NO_THROW((void)Machine::build(changed));
}

/// dy/dt of every node, warm as a made-up day leaves it [K/s].
std::vector<double> rates(Machine const& machine) {
  auto const& network = machine.network();
  std::vector<double> input, state, rate(std::size_t(network.nodes()));
  for (auto const& name : network.channel_names())
    input.push_back(name.find("temperature") != std::string::npos ? 295.0 : name.ends_with(".speed") ? 200.0 : 0.7);
  for (int i = 0; i < network.nodes(); ++i) state.push_back(network.state_of_temperature(i, 300.0 + i % 7));
  thermal::Evaluation(network).rate(state.data(), input.data(), rate.data());
  return rate;
}

/// Neither does making it ready change the machine.
TEST_P(UncertainNumbersOf, LeaveTheMachineAsItIs) {
  Value const before = read_toml(machine_file(GetParam()));
  Uncertain const machine(before);
  auto const was = Machine::build(before), is = Machine::build(machine.document);
  EXPECT_EQ(was.network().capacity(), is.network().capacity());
  EXPECT_THAT(rates(is), testing::Pointwise(testing::DoubleNear(1e-15), rates(was)));
  ASSERT_EQ(was.displacements.size(), is.displacements.size());
  for (std::size_t d = 0; d < was.displacements.size(); ++d)
    EXPECT_EQ(was.displacements[d].weights, is.displacements[d].weights);
}

/// Everyone deserves its place: it changes heat, or what moves the tool.
TEST_P(UncertainNumbersOf, DoSomething) {
  Uncertain const machine(read_toml(machine_file(GetParam())));
  for (auto const& number : machine.numbers) {
    auto const d = differentiate(machine.document, number.path);
    bool const tool = std::any_of(d.displacements.begin(), d.displacements.end(), [](auto const& weights) {
      return std::any_of(weights.begin(), weights.end(), [](auto const& w) { return w.second != 0.0; });
    });
    EXPECT_TRUE(changes_heat(d.network) || tool) << number.path;
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, UncertainNumbersOf, testing::Values("v450", "vmc850", "g200", "tclab"),
                         [](auto const& info) { return std::string(info.param); });

}  // namespace
}  // namespace thermotwin::twin
