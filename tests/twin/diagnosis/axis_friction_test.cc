#include "twin/diagnosis/axis_friction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/calibration.h"
#include "twin/diagnosis/diagnosis.h"
#include "twin/machine.h"

namespace thermotwin::twin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Value vmc850(std::string const& friction_at) {
  Value document = read_toml(machine_file("vmc850"));
  set_parameter(document, "axis.z.friction_at", friction_at);
  return document;
}

/// What that machine shows of an axis that rests a while at each end of its stroke.
MeasuredRun run_of(Value const& truth, std::string const& dwell, unsigned seed = 3) {
  auto run = tests::measured(truth, tests::experiment(R"(
    duration = "9 h"
    ambient.mean = "21 degC"
    ambient.daily_cycle.amplitude = "1 K"
    [[axes]]
    axis = "z"
    dwell = ")" + dwell + R"("
    blocks = [{duration = "2 h", feed = "16000 mm/min"}, {duration = "2 h", feed = "4000 mm/min"},
              {duration = "1 h", feed = "0 mm/min"}, {duration = "3 h", feed = "10000 mm/min"}])"));
  tests::add_noise(run, 0.02, 0.05e-6, seed);
  return run;
}

std::optional<FrictionWhileMoving> friction(Value const& file, MeasuredRun const& run) {
  return friction_while_moving(file, {bin(run, 300.0)}, DiagnosisOptions().threshold, {});
}

/// 4 s at the ends: in motion 0.36 of the time at 16 m/min, 0.69 at 4 m/min.
TEST(FrictionWhileMoving, IsToldWhereTheMachineHasItAndTheFileDoesNot) {
  auto const run = run_of(vmc850("moving speed"), "4 s");
  auto const file = vmc850("mean speed");
  auto const calibration = calibrate(file, {bin(run, 300.0)});
  ASSERT_TRUE(calibration.friction);
  EXPECT_THAT(calibration.friction->axes, ElementsAre("z"));
  EXPECT_FALSE(calibration.falls_short());
  auto const diagnosis = diagnose(file, {bin(run, 300.0)}, {});
  EXPECT_EQ(name_of(diagnosis.verdict), "nothing");
  ASSERT_TRUE(diagnosis.friction);
  EXPECT_THAT(diagnosis.friction->remark(), HasSubstr("friction of axis z is that of its speed while it moves"));
  std::string const text = "[[axis]]\nname = \"z\"\nfriction_at = \"mean speed\"\n";
  EXPECT_THAT(with_values(text, diagnosis.friction->changes()),
              HasSubstr("friction_at = \"moving speed\"  # was mean speed; 2 ln "));
}

TEST(FrictionWhileMoving, IsNotToldWhereTheFileIsRightOrTheAxisNeverRests) {
  EXPECT_FALSE(friction(vmc850("mean speed"), run_of(vmc850("mean speed"), "4 s")));
  EXPECT_FALSE(friction(vmc850("moving speed"), run_of(vmc850("moving speed"), "4 s")));
  EXPECT_FALSE(friction(vmc850("mean speed"), run_of(vmc850("moving speed"), "0 s")));
}

/// Neither is what hides in a machine whose file is right.
TEST(FrictionWhileMoving, IsNoNameForAnEffect) {
  auto const hidden = tests::with_table(vmc850("mean speed"), R"(
    [[seal]]
    name = "hidden"
    shaft = "screw[0 mm .. 40 mm]"
    housing = "upper_ring"
    torque = "0.4 N m"
    speed = "z.speed")");
  auto const diagnosis = diagnose(vmc850("mean speed"), {bin(run_of(hidden, "4 s"), 300.0)}, {});
  EXPECT_FALSE(diagnosis.friction);
  ASSERT_FALSE(diagnosis.explanations.empty());
}

}  // namespace
}  // namespace thermotwin::twin
