#include "twin/diagnosis/sensor_places.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "tests/twin/only.h"
#include "twin/diagnosis/diagnosis.h"
#include "twin/diagnosis/gap.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

Machine const& machine() {
  static Machine const machine = Machine::build(tests::v450());
  return machine;
}

SensorPlace const& place(std::string const& name) {
  static auto const places = sensor_places(tests::v450(), machine());
  auto const it = std::find_if(places.begin(), places.end(), [&](auto const& p) { return p.name == name; });
  if (it == places.end()) throw std::runtime_error("no place '" + name + "'");
  return *it;
}

bool is_there(std::string const& name) {
  auto const places = sensor_places(tests::v450(), machine());
  return std::any_of(places.begin(), places.end(), [&](auto const& p) { return p.name == name; });
}

/// What the change shows of nodes at these temperatures.
double shown(NodeWeights const& change, std::vector<double> const& temperature) {
  double sum = 0.0;
  for (auto const& [node, weight] : change) sum += weight * temperature[std::size_t(node)];
  return sum;
}

TEST(SensorPlaces, ShowNothingOfWhatIsWarmAllOver) {
  std::vector<double> const warm(std::size_t(machine().network().nodes()), 310.0);
  auto const places = sensor_places(tests::v450(), machine());
  EXPECT_GT(places.size(), 10);
  for (auto const& p : places) EXPECT_NEAR(shown(p.change, warm), 0.0, 1e-10) << p.name;
}

/// T3 sits at 50 mm of a cartridge with cells of 20 mm, T1 at 10 mm, in the outermost one: 6 mm of 0.1 K/mm.
TEST(SensorPlaces, AlongABarFollowTheSlope) {
  std::vector<double> sloped(std::size_t(machine().network().nodes()), 300.0);
  auto const range = machine().network().range("cartridge");
  for (int i = 0; i < range.count; ++i) sloped[std::size_t(range.first + i)] += 100.0 * 0.02 * i;
  EXPECT_NEAR(shown(place("T3 along cartridge").change, sloped), 0.6, 1e-9);
  EXPECT_NEAR(shown(place("T1 along cartridge").change, sloped), 0.6, 1e-9);
}

/// T1 stands over the front bearings' seat, T5 in the middle of the cartridge does not; both touch the head.
TEST(SensorPlaces, AreNearToJointsThatAreNear) {
  std::vector<double> hot(std::size_t(machine().network().nodes()), 300.0);
  hot[std::size_t(machine().network().range("front_ring").first)] += 20.0;
  EXPECT_NEAR(shown(place("T1 near front_ring").change, hot), 2.0, 1e-9);
  EXPECT_FALSE(is_there("T5 near front_ring"));
  EXPECT_TRUE(is_there("T5 near head_front"));
  EXPECT_TRUE(is_there("T6 near cartridge"));
  EXPECT_FALSE(is_there("T6 along head_front"));
}

/// The sensor of a machine whose file says so, node by node.
std::map<int, double> weights_of(Value const& document, std::string const& sensor) {
  std::map<int, double> weights;
  for (auto const& own : Machine::build(document).sensors)
    if (own.description.name == sensor)
      for (auto const& [node, weight] : own.weights) weights[node] += weight;
  return weights;
}

/// The machine where its sensors sit there, as a file says it.
Value placed(std::map<std::string, double> const& amounts) {
  Value document = tests::v450();
  auto const places = sensor_places(document, machine());
  std::vector<double> x;
  for (auto const& p : places) x.push_back(amounts.contains(p.name) ? amounts.at(p.name) : 0.0);
  for (auto const& sensor : placed_sensors(document, places, x))
    for (auto* table : tables_of(document, "temperature_sensor"))
      if (name_in(*table) == sensor.name) put(*table, sensor);
  return document;
}

/// What is written for sensors that lean towards two joints is what the fit supposed of them.
TEST(SensorPlaces, AreWrittenAsSharesOfThePlacesBeyondTheJoints) {
  std::map<std::string, double> const amounts = {
      {"T6 near cartridge", 0.5}, {"T6 near head_rear", -0.3}, {"T4 near head_front", 0.4}};
  Value const document = placed(amounts);
  for (std::string const sensor : {"T4", "T6", "T7"}) {
    auto expected = weights_of(tests::v450(), sensor);
    for (auto const& [name, amount] : amounts)
      if (name.starts_with(sensor))
        for (auto const& [node, weight] : place(name).change) expected[node] += amount * weight;
    auto const written = weights_of(document, sensor);
    for (auto const& [node, weight] : expected)
      EXPECT_NEAR(written.contains(node) ? written.at(node) : 0.0, weight, 2e-4) << sensor << " at node " << node;
  }
}

TEST(SensorPlaces, CountByTheirShares) {
  Value document = tests::v450();
  for (auto* table : tables_of(document, "temperature_sensor"))
    if (name_in(*table) == "T6") {
      set_key(*table, "at", list_of({"head_front", "motor"}));
      set_key(*table, "shares", Value::List{{table->where, 1.25}, {table->where, -0.25}});
    }
  auto const& network = machine().network();
  auto const weights = weights_of(document, "T6");
  EXPECT_NEAR(weights.at(network.range("head_front").first), 1.25, 1e-12);
  EXPECT_NEAR(weights.at(network.range("motor").first), -0.25, 1e-12);
}

/// 6 mm further from the nose is 0.6 K of 0.1 K/mm; beyond the middle of the outermost cell there is no more to see.
TEST(SensorPlaces, AreWrittenAsPositionsAlongABar) {
  Value const document =
      placed({{"T3 along cartridge", 1.0}, {"T4 along cartridge", 1.0}, {"T1 along cartridge", -1.0}});
  std::map<std::string, std::vector<std::string>> at;
  Value copy = document;
  for (auto const* table : tables_of(copy, "temperature_sensor")) at[name_in(*table)] = texts_of(*table, "at");
  EXPECT_THAT(at.at("T3"), testing::ElementsAre("cartridge[56 mm]"));
  EXPECT_THAT(at.at("T4"), testing::ElementsAre("front_ring", "cartridge[16 mm]"));
  EXPECT_THAT(at.at("T1"), testing::ElementsAre("cartridge[10 mm]"));
  EXPECT_THAT(at.at("T5"), testing::ElementsAre("cartridge[130 mm]"));
}

/// What lies on a stretch may be seen elsewhere, but no file can say so.
TEST(SensorPlaces, AStretchStaysWhereItIs) {
  Value document = tests::v450();
  set_parameter(document, "temperature_sensor.T3.at", "cartridge[40 mm .. 60 mm]");
  auto const places = sensor_places(document, Machine::build(document));
  std::vector<double> x;
  for (auto const& p : places) {
    x.push_back(p.name == "T3 along cartridge" ? 1.0 : 0.0);
    EXPECT_EQ(p.can_be_written, p.name != "T3 along cartridge") << p.name;
  }
  EXPECT_TRUE(placed_sensors(document, places, x).empty());
}

/// T3 was glued at 35 mm, where its file says 50 mm: nothing is missing, and the file that is written says where it is,
/// as far as its prior lets it.
TEST(SensorPlaces, AreFoundAndWritten) {
  Value truth = tests::v450();
  set_parameter(truth, "temperature_sensor.T3.at", "cartridge[35 mm]");
  auto run = tests::measured(truth, tests::two_speeds());
  tests::add_noise(run, 0.02, 0.05e-6, 7);
  std::vector<BinnedRun> const data = {bin(run, 300.0)};
  auto diagnosis = diagnose(tests::v450(), data, {});
  EXPECT_EQ(name_of(diagnosis.verdict), "nothing");
  auto const* table = tests::only(tables_of(diagnosis.document, "temperature_sensor"),
                                  [](auto const* one) { return name_in(*one) == "T3"; });
  EXPECT_LT(std::stod(texts_of(*table, "at").at(0).substr(std::string("cartridge[").size())), 47.0);
  auto const left = gaps(Machine::build(tests::v450()), Machine::build(diagnosis.document), data, nullptr);
  auto const gap = tests::only(left, [](auto const& one) { return one.channel == "T3"; });
  EXPECT_LT(gap.after, 0.1 * gap.before);
}

}  // namespace
}  // namespace thermotwin::twin
