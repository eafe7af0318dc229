#include "twin/diagnosis/diagnosis.h"

#include <gtest/gtest.h>

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

/// Two at once on one displacement are likelier one thing that the catalogue does not have. It is no heat.
TEST(Diagnosis, KnowsNoneWhereItTakesTwoToMoveADisplacement) {
  auto const diagnosis = diagnosed(growth + left_on);
  EXPECT_EQ(name_of(diagnosis.verdict), "none_known");
  EXPECT_GE(diagnosis.effects.size(), 2);
  EXPECT_FALSE(diagnosis.unknown_heat);
}

}  // namespace
}  // namespace thermotwin::twin
