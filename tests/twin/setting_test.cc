#include "twin/setting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/refusal.h"
#include "twin/experiment_file.h"
#include "twin/machine.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using thermotwin::tests::refusal;

Value plain_experiment() { return parse_toml("machine = \"v450\"\nduration = \"1 h\"\n", "experiment.toml"); }

/// The experiment after a setting.
scenarios::Experiment changed(std::string const& text) {
  Value experiment = plain_experiment(), machine{{}, Value::Table{}};
  apply(setting(text), machine, experiment);
  return read_experiment(experiment, "experiment.toml");
}

TEST(Setting, MakesTablesThatTheExperimentLacks) {
  EXPECT_FALSE(changed("experiment.duration=2 h").coolant.on);
  EXPECT_TRUE(changed("experiment.coolant.on=true").coolant.on);
  EXPECT_DOUBLE_EQ(changed("experiment.ambient.daily_cycle.amplitude=2 K").ambient.daily_cycle->amplitude, 2.0);
}

TEST(Setting, SaysItsWholePathInMessages) {
  EXPECT_EQ(refusal([] { (void)changed("experiment.duratoin=2 h"); }),
            "parameter experiment.duratoin: unknown key 'duratoin'; did you mean 'duration'?");
  EXPECT_EQ(refusal([] { (void)changed("experiment.coolant.onn=true"); }),
            "parameter experiment.coolant.onn: unknown key 'onn'; did you mean 'on'?");
  EXPECT_THAT(refusal([] { (void)changed("experiment.coolnt.on=true"); }),
              HasSubstr("parameter 'experiment.coolnt.on': there is no 'coolnt'"));
}

TEST(Setting, CountsTablesWithoutNames) {
  Value machine{{}, Value::Table{}};
  Value experiment =
      parse_toml("[spindle]\nblocks = [{duration = \"1 h\"}, {duration = \"2 h\"}]\n", "experiment.toml");
  apply(setting("experiment.spindle.blocks.1.duration=3 h"), machine, experiment);
  EXPECT_EQ(
      refusal([&] { apply(setting("experiment.spindle.blocks.9.duration=3 h"), machine, experiment); }),
      "parameter 'experiment.spindle.blocks.9.duration': there is no table '9' in 'blocks'; it has 2, counted from "
      "0");
}

TEST(Setting, OfAnExperimentIsNotLookedForInTheMachine) {
  EXPECT_EQ(refusal([] { (void)changed("ambient.mean=22 degC"); }),
            "parameter 'ambient.mean': a machine has no 'ambient'; did you mean 'experiment.ambient.mean'?");
  EXPECT_THAT(refusal([] { (void)changed("duration=2 h"); }), HasSubstr("did you mean 'experiment.duration'?"));
}

TEST(Setting, OfWhatAMachineMayHaveIsNoneOfTheExperiment) {
  EXPECT_EQ(refusal([] { (void)changed("title=mine"); }), "accepted");
  EXPECT_EQ(refusal([] { (void)changed("machine=v450"); }), "accepted");
  EXPECT_THAT(refusal([] { (void)changed("laser.resolution=1 um"); }),
              HasSubstr("parameter 'laser.resolution': there is no 'laser'"));
}

TEST(Setting, OfAProgrammeThatIsReplacedIsRefused) {
  Value const document = parse_toml(
      "machine = \"v450\"\nduration = \"1 h\"\n"
      "inputs = [{channel = \"coolant.on\", blocks = [{duration = \"1 h\", value = \"1\"}]}]\n"
      "[[recorded]]\nfile = \"air.csv\"\ncolumns = [{column = \"room\", channel = \"ambient.temperature\", unit = "
      "\"degC\"}]\n",
      "experiment.toml");
  auto const experiment = read_experiment(document, "experiment.toml");
  auto const answer = [&](std::string const& text) {
    return refusal([&] { refuse_replaced(setting(text), experiment); });
  };
  EXPECT_EQ(answer("experiment.ambient.mean=30 degC"),
            "parameter 'experiment.ambient.mean' would change nothing: 'ambient.temperature' is recorded in 'air.csv'");
  EXPECT_EQ(
      answer("experiment.coolant.on=true"),
      "parameter 'experiment.coolant.on' would change nothing: 'coolant.on' has a programme of its own in 'inputs'");
  for (auto const* text : {"experiment.ambient.stratification=1 K/m", "experiment.ambient.door_openings=0",
                           "experiment.duration=2 h", "experiment.spindle.cycles=2", "ambient.mean=3"})
    EXPECT_EQ(answer(text), "accepted") << text;
}

TEST(Setting, IsGivenOnce) {
  auto const answer = [](std::string const& lines) { return refusal([&] { refuse_repeated(settings_in(lines)); }); };
  EXPECT_EQ(answer("experiment.seed=1\nbearing.front.count=2\nexperiment.seed=1"),
            "parameter 'experiment.seed' is set twice; leave out one of the two");
  EXPECT_EQ(answer("experiment.seed=1\nbearing.front.count=2"), "accepted");
}

TEST(Setting, KnowsTheDimensionOfItsKey) {
  Value machine = read_toml(machine_file("v450")), experiment = plain_experiment();
  apply(setting("bearing.front.grease_factor=abc"), machine, experiment);
  EXPECT_THAT(refusal([&] { (void)Machine::build(machine); }),
              HasSubstr("'grease_factor': 'abc': a number is due, for example \"0.8\""));
}

}  // namespace
}  // namespace thermotwin::twin
