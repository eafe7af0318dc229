// What is demanded of a placement (docs/placement.md, "Measured"), on the machines that the benchmark draws. Each takes
// 3 to 60 s of one core: hundreds of machines are simulated, or one with a mesh of 200 sites.
#include <chrono>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/placement_bound.h"
#include "tests/twin/placement/drawn_machines.h"
#include "twin/placement/sensor_placement.h"

namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Ge;
using testing::Le;

TEST(DemandedPlacement, ReachesNinetyNinePercentOfTheOptimum) {
  for (int seed = 0; seed < 200; ++seed) {
    auto const problem = drawn_at_random(RandomMachine(std::uint64_t(seed)), 6, 0).problem();
    EXPECT_THAT(shares_of_optimum(problem), Each(AllOf(Ge(0.99), Le(1.0 + 1e-9)))) << "machine " << seed;
  }
}

TEST(DemandedPlacement, TrainedOnTheMachineIsBetterThanOtherMethods) {
  ErrorRatios ratios;
  for (int seed = 0; seed < 100; ++seed)
    ratios.add_trained(drawn_at_random(RandomMachine(std::uint64_t(seed)), 24, 12));
  EXPECT_GE(share_below(ratios.to_pivots, 0.8), 0.9);
  EXPECT_GE(share_below(ratios.to_groups, 0.6), 0.9);
}

/// 8 of 200 sites; on 8 members, where the benchmark draws 24.
TEST(DemandedPlacement, IsAtMostFivePercentAboveItsBoundWithinFiveSeconds) {
  auto const problem = drawn_as_shipped("v450_fine", 8, 0).problem();
  ASSERT_EQ(problem.sites(), 200);
  auto const start = std::chrono::steady_clock::now();
  double const found = models::place(problem, 8).variance, bound = models::placement_bound(problem, 8);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  EXPECT_GE(found, bound);
  EXPECT_LE(std::sqrt(found / bound), 1.05);
}

class DemandedPlacementOn : public testing::TestWithParam<char const*> {};

TEST_P(DemandedPlacementOn, OutlivesAnyTwoOfEightSensors) {
  auto const problem = drawn_as_shipped(GetParam(), 100, 0, 2).problem();
  auto const robust = models::place(problem, 8, 2);
  ASSERT_EQ(robust.sensors.size(), 8U);
  EXPECT_LE(worst_over_intact(problem, robust), 1.3);
}

TEST_P(DemandedPlacementOn, ForetellsTheVarianceOnMachinesThatTookNoPart) {
  auto const machines = drawn_as_shipped(GetParam(), 300, 300);
  for (auto const teacher : {Teacher::family, Teacher::machine})
    EXPECT_THAT(predicted_over_realised(machines, teacher), AllOf(Ge(0.9), Le(1.1)))
        << (teacher == Teacher::machine ? "trained" : "one estimate for all");
}

TEST_P(DemandedPlacementOn, DoublesTheSmallestAngleBetweenTwoEffects) {
  PlacementOptions options;
  options.distinguish = true;
  options.unseen_members = 1;
  for (int const sensors : {4, 6}) {
    options.sensors = sensors;
    auto const distinction = place_sensors(read_toml(machine_file(GetParam())), options).distinction.value();
    EXPECT_GE(distinction.recommended, 2.0 * distinction.for_displacement) << sensors << " sensors";
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, DemandedPlacementOn, testing::Values("v450", "vmc850", "g200"),
                         [](auto const& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace thermotwin::twin
