#include "twin/experiment_remarks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "tests/twin/checked_files.h"
#include "twin/file_check.h"

/// What `thermotwin check` finds odd about an experiment.
namespace thermotwin::twin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using thermotwin::tests::air;
using thermotwin::tests::experiment;
using thermotwin::tests::machine_with;
using thermotwin::tests::put;
using thermotwin::tests::recorded;
using thermotwin::tests::TemporaryDirectory;

TEST(ExperimentRemarks, WarnsOfNumbersThatAreNotPlausible) {
  TemporaryDirectory const folder;
  put(folder / "experiment.toml",
      std::string(experiment) + "[ambient]\nstratification = \"70 K/m\"\n" + "daily_cycle.amplitude = \"12 K\"\n");
  EXPECT_THAT(check_files({folder / "experiment.toml"})[0].warnings,
              testing::UnorderedElementsAre(
                  HasSubstr("'stratification' is \"70 K/m\"; outside what is plausible: -5 K/m to 10 K/m"),
                  HasSubstr("'amplitude' is \"12 K\"; outside what is plausible")));
}

TEST(ExperimentRemarks, WarnsOfInputsThatNothingReads) {
  TemporaryDirectory const folder;
  put(folder / "air.csv", air);
  put(folder / "good.toml", experiment + recorded("ambient.temperature"));
  put(folder / "typo.toml", experiment + recorded("ambient.temp"));
  put(folder / "oil.toml",
      std::string(experiment) +
          "inputs = [{channel = \"oil.flow\", blocks = [{duration = \"1 h\", value = \"80 %\"}]}]\n");
  put(folder / "mine.toml", machine_with("[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 W\"\n"
                                         "while_on = \"oil.flow\"\n"));
  auto const checks = check_files({folder / "good.toml", folder / "typo.toml", folder / "oil.toml"});
  EXPECT_THAT(checks[0].warnings, SizeIs(0));
  EXPECT_THAT(checks[1].warnings,
              ElementsAre(HasSubstr("typo.toml:5:40: recorded[0].columns[0].channel: nothing on 'v450' reads "
                                    "'ambient.temp'; did you mean 'ambient.temperature'?")));
  EXPECT_THAT(checks[2].warnings, ElementsAre(HasSubstr("oil.toml:3:22: inputs[0].channel: nothing on 'v450' reads "
                                                        "'oil.flow'; known: ")));
  EXPECT_THAT(check_files({folder / "oil.toml", folder / "mine.toml"})[0].warnings, SizeIs(0));
  for (auto const& check : checks) EXPECT_EQ(check.mistake, "");
}

/// Not of switches that go to and fro: so one looks for what the machine's file lacks.
TEST(ExperimentRemarks, WarnsOfTablesThatNothingReads) {
  TemporaryDirectory const folder;
  put(folder / "press.toml",
      "name = \"press\"\n[spindle]\nmaximum_speed = \"6000 rpm\"\n[[axis]]\nname = \"x\"\nrapid_feed = \"20 m/min\"\n"
      "lead = \"10 mm\"\nstroke_to = \"500 mm\"\n[[lump]]\nname = \"motor\"\nheat_capacity = \"9 kJ/K\"\n"
      "[[film]]\nname = \"motor\"\non = \"motor\"\narea = \"0.3 m2\"\n");
  auto const warnings = [&](std::string const& table) {
    put(folder / "day.toml", "machine = \"press.toml\"\nduration = \"1 h\"\n" + table);
    auto const check = check_files({folder / "day.toml"})[0];
    EXPECT_EQ(check.mistake, "") << table;
    return check.warnings;
  };
  struct Row {
    std::string table, warning;
  };
  for (auto const& [table, warning] :
       {Row{"[coolant]\non = true\n", "day.toml:4:6: coolant.on: nothing on 'press' reads 'coolant.on'; it changes"},
        Row{"[coolant]\ntemperature = \"18 degC\"\n", "coolant.temperature: nothing on 'press' reads"},
        Row{"[chiller]\noffset = \"2 K\"\n", "chiller.offset: nothing on 'press' reads 'chiller.offset'"},
        Row{"[chiller]\non = false\n", "chiller.on: nothing on 'press' reads"},
        Row{"[power]\non = false\n", "power.on: nothing on 'press' reads 'machine.on'"},
        Row{"[servo]\non = false\n", "day.toml:4:6: servo.on: nothing on 'press' reads 'servo.on'"},
        Row{"[spindle]\nblocks = [{duration = \"1 h\", speed = \"900 rpm\"}]\n",
            "spindle: nothing on 'press' reads 'spindle.…'"},
        Row{"[[axes]]\naxis = \"x\"\nblocks = [{duration = \"1 h\", feed = \"8 m/min\"}]\n",
            "day.toml:4:8: axes[0].axis: nothing on 'press' reads 'x.…'"}})
    EXPECT_THAT(warnings(table), ElementsAre(HasSubstr(warning)));
  EXPECT_THAT(warnings("[coolant]\non = false\n[chiller]\non = true\n[servo]\non = true\n"), SizeIs(0));
  EXPECT_THAT(warnings("[coolant]\ntemperature = \"18 degC\"\nblocks = [{duration = \"30 min\", on = true}]\n"),
              SizeIs(0));
}

/// The stroke of the axis goes from 120 to 720 mm of a screw of 840 mm.
TEST(ExperimentRemarks, WarnsOfWhatIsBeyondStrokeAndRun) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& more) {
    put(folder / "experiment.toml", "machine = \"vmc850\"\nduration = \"1 h\"\n" + more);
    return check_files({folder / "experiment.toml"})[0].warnings;
  };
  EXPECT_THAT(warnings("laser.to = \"600 mm\"\n"), SizeIs(0));
  EXPECT_THAT(warnings("laser.to = \"700 mm\"\n"),
              ElementsAre(HasSubstr("experiment.toml:3:12: laser.to: the target 700 mm is outside the stroke of axis "
                                    "'z', 0 mm to 600 mm")));
  EXPECT_THAT(warnings("laser.from = \"-50 mm\"\n"),
              ElementsAre(HasSubstr("experiment.toml:3:14: laser.from: the target -50 mm is outside")));
  EXPECT_THAT(warnings("[ambient]\ndoor_openings = [{time = \"50 min\"}, {time = \"2 h\"}]\n"),
              ElementsAre(HasSubstr("ambient.door_openings[1].time: it opens at 2 h, and the run ends at 1 h")));
}

TEST(ExperimentRemarks, WarnsOfSpectraLongerThanTheRun) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& spindle) {
    put(folder / "experiment.toml", experiment + spindle);
    return check_files({folder / "experiment.toml"})[0].warnings;
  };
  std::string const blocks =
      "[spindle]\nblocks = [{duration = \"20 min\", speed = \"900 rpm\"}, {duration = \"10 min\"}]\n";
  EXPECT_THAT(warnings(blocks + "cycles = 2\n"), SizeIs(0));
  EXPECT_THAT(warnings(blocks + "cycles = 3\n"),
              ElementsAre(HasSubstr("experiment.toml:4:10: spindle.blocks: they last 90 min in all, and the run 1 h; "
                                    "what comes later is left out")));
}

/// A record of rows 10 min apart, the last at 60 min, stands for 10 min more.
TEST(ExperimentRemarks, WarnsOfARecordThatEndsBeforeTheRun) {
  TemporaryDirectory const folder;
  put(folder / "air.csv", air);
  auto const warnings = [&](std::string const& duration) {
    put(folder / "experiment.toml", "machine = \"v450\"\nduration = \"" + duration + "\"\n" +
                                        recorded("ambient.temperature") + "max_gap = \"1 h\"\n");
    return check_files({folder / "experiment.toml"})[0].warnings;
  };
  EXPECT_THAT(warnings("1 h"), SizeIs(0));
  EXPECT_THAT(warnings("70 min"), SizeIs(0));
  EXPECT_THAT(warnings("90 min"),
              ElementsAre(HasSubstr("experiment.toml:4:8: recorded[0].file: it ends at 1 h, and the run at 90 min; "
                                    "until then its last values hold")));
}

/// 33 s of a minute at one speed: each row of the data would show it.
TEST(ExperimentRemarks, WarnsOfChangesBetweenTwoRows) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& text) {
    put(folder / "experiment.toml", text);
    return check_files({folder / "experiment.toml"})[0].warnings;
  };
  std::string const spindle =
      "machine = \"v450\"\nduration = \"2 h\"\n[spindle]\n"
      "blocks = [{duration = \"33 s\", speed = \"3000 rpm\"}, {duration = \"27 s\"}]\ncycles = 120\n";
  EXPECT_THAT(warnings(spindle),
              ElementsAre(HasSubstr("spindle: 119 of 239 changes are followed by another one before the next row, and "
                                    "the inputs in the data lack them; a `sampling` of 27 s or less shows what was "
                                    "given")));
  EXPECT_THAT(warnings("sampling = \"25 s\"\n" + spindle), SizeIs(0));
  EXPECT_THAT(warnings("machine = \"vmc850\"\nduration = \"1 h\"\n[[axes]]\ncycles = 10\n"
                       "blocks = [{duration = \"20 s\", feed = \"8 m/min\"}, {duration = \"20 s\"}]\n"),
              ElementsAre(HasSubstr("axes[0].blocks: 12 of 19 changes are followed by another one before the next row, "
                                    "and the inputs in the data lack them; a `sampling` of 20 s or less, or one block "
                                    "with a `duty`, shows what was given")));
}

TEST(ExperimentRemarks, WarnsOfAnEndOfTheRunWithoutARow) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& sampling) {
    put(folder / "experiment.toml", "machine = \"v450\"\nduration = \"4 h\"\nsampling = \"" + sampling + "\"\n");
    return check_files({folder / "experiment.toml"})[0].warnings;
  };
  EXPECT_THAT(warnings("8 min"), SizeIs(0));
  EXPECT_THAT(warnings("7 min"),
              ElementsAre(HasSubstr("experiment.toml:3:12: sampling: the last row is at 238 min, and "
                                    "the run ends at 4 h; what comes later is left out")));
}

}  // namespace
}  // namespace thermotwin::twin
