#include "twin/diagnosis/sensor_places.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/twin/diagnosis/diagnosis_bench.h"

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

}  // namespace
}  // namespace thermotwin::twin
