#include "twin/diagnosis/diagnosis.h"

#include <gtest/gtest.h>
#include <random>

#include "tests/twin/diagnosis/diagnosis_bench.h"

namespace thermotwin::twin {
namespace {

Diagnosis diagnosed(std::string const& hidden) {
  auto run = tests::measured(tests::with_table(tests::v450(), hidden), tests::two_speeds());
  tests::add_noise(run, 0.02, 0.05e-6, 7);
  DiagnosisOptions options;
  options.further_threshold = options.threshold;
  options.least_share = 0.0;
  return diagnose(tests::v450(), {bin(run, 300.0)}, options);
}

std::string const growth = R"(
  [[centrifugal_growth]]
  name = "hidden"
  displacement = "E_Z"
  growth = "-12 um")";

std::string const left_on = R"(
  [[compensation]]
  name = "hidden"
  displacement = "E_Z"
  at = "rear_ring"
  gain = "2 um/K")";

TEST(Diagnosis, NamesWhatMovesADisplacement) {
  auto const diagnosis = diagnosed(growth);
  EXPECT_EQ(name_of(diagnosis.verdict), "effect");
  ASSERT_EQ(diagnosis.effects.size(), 1);
  EXPECT_EQ(diagnosis.effects[0].effect->name, "centrifugal_growth");
}

/// In a room where nothing happens a sensor that lags reads a smooth version of a noisy record.
TEST(Diagnosis, TakesNoiseInTheRecordOfTheRoomForNoLagOfItsSensor) {
  Machine const machine = Machine::build(tests::v450());
  auto dataset = run(machine, tests::experiment(R"(
    duration = "24 h"
    ambient.mean = "22 degC"
    ambient.daily_cycle.amplitude = "1.5 K"
    [spindle]
    blocks = [{duration = "12 h", speed = "3000 rpm"}])"),
                     {})
                     .dataset;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (auto& input : dataset.inputs)
    if (input.name == "ambient.temperature")
      for (double& value : input.values) value += 0.1 * normal(random);
  auto measured = measured_run(dataset, machine, "quiet");
  tests::add_noise(measured, 0.02, 0.05e-6, 7);
  auto const diagnosis = diagnose(tests::v450(), {bin(measured, 300.0)}, {});
  EXPECT_EQ(name_of(diagnosis.verdict), "nothing");
}

/// Two at once on one displacement are likelier one thing that the catalogue does not have. It is no heat.
TEST(Diagnosis, KnowsNoneWhereItTakesTwoToMoveADisplacement) {
  auto const diagnosis = diagnosed(growth + left_on);
  EXPECT_EQ(name_of(diagnosis.verdict), "none_known");
  EXPECT_GE(diagnosis.effects.size(), 2);
  EXPECT_FALSE(diagnosis.unknown_heat);
}

}  // namespace
}  // namespace thermotwin::twin
