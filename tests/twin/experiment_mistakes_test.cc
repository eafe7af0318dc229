#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <utility>

#include "tests/output/temporary_directory.h"
#include "tests/twin/checked_files.h"
#include "twin/experiment_file.h"
#include "twin/file_check.h"
#include "twin/machine.h"

/// What `thermotwin check` refuses in an experiment, with its place.
namespace thermotwin::twin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using thermotwin::tests::experiment;
using thermotwin::tests::machine_with;
using thermotwin::tests::put;
using thermotwin::tests::TemporaryDirectory;

TEST(ExperimentMistakes, SaysOnceWhatIsWrongWithANumber) {
  TemporaryDirectory const folder;
  std::string const block = "[spindle]\nblocks = [{duration = \"1 h\", of_maximum = 1.5}]\n";
  put(folder / "experiment.toml", experiment + block + "[ambient]\ndaily_cycle.amplitude = \"12 K\"\n");
  auto const check = check_files({folder / "experiment.toml"})[0];
  EXPECT_THAT(check.mistake, HasSubstr("experiment.toml:4:43: spindle.blocks[0].of_maximum: 1.5 must be from 0 to 1"));
  EXPECT_THAT(check.warnings, ElementsAre(HasSubstr("'amplitude' is \"12 K\"")));
}

TEST(ExperimentMistakes, NamesThePlaceOfAQuantityThatIsNone) {
  TemporaryDirectory const folder;
  put(folder / "experiment.toml", "machine = \"v450\"\nduration = \"8 Stunden\"\n");
  EXPECT_THAT(check_files({folder / "experiment.toml"})[0].mistake,
              HasSubstr("experiment.toml:2:12: 'duration': '8 Stunden': unknown unit 'Stunden'"));
}

TEST(ExperimentMistakes, LeavesAComplaintThatNamesItsOwnFile) {
  TemporaryDirectory const folder;
  put(folder / "experiment.toml", std::string(experiment) + "[[recorded]]\nfile = \"air.csv\"\ncolumns = []\n");
  Value const document = read_toml(folder / "experiment.toml");
  for (std::string const complaint : {"air.csv: is empty", "folder/air.csv: is empty", "air.csv:3: column 'room'"})
    EXPECT_EQ(located_in(document, thermal::InputError(complaint)).what(), complaint);
  EXPECT_THAT(located_in(document, thermal::InputError("duration: 0 s must be above 0 s")).what(),
              HasSubstr("experiment.toml:2:12: duration: 0 s"));
}

/// The same of experiments; a laser's targets count from the start of the stroke.
TEST(ExperimentMistakes, RefusesAProgrammeBeyondTheScrew) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& more) {
    put(folder / "experiment.toml", "machine = \"vmc850\"\nduration = \"1 h\"\n" + more);
    return check_files({folder / "experiment.toml"})[0].mistake;
  };
  std::string const axes = "[[axes]]\nblocks = [{duration = \"1 h\", feed = \"8 m/min\"}]\n";
  EXPECT_EQ(mistake(axes + "stroke_to = \"840 mm\"\n"), "");
  EXPECT_THAT(mistake(axes + "stroke_to = \"1600 mm\"\n"),
              HasSubstr("experiment.toml:5:13: axes.z.stroke_to: 1.6 m is not on the screw of axis 'z', which reaches "
                        "from 0 mm to 840 mm"));
  EXPECT_THAT(mistake(axes + "stroke_from = \"-10 mm\"\n"),
              HasSubstr("experiment.toml:5:15: axes.z.stroke_from: -10 mm is not on the screw"));
  EXPECT_EQ(mistake("laser.to = \"700 mm\"\n"), "");
  EXPECT_THAT(mistake("laser.to = \"750 mm\"\n"),
              HasSubstr("experiment.toml:3:12: laser.to: 750 mm from the start of the stroke, 870 mm is not on the "
                        "screw of axis 'z'"));
}

/// A complaint about an axis names it by its name; the default is z.
TEST(ExperimentMistakes, AComplaintAboutAnAxisPointsToItsKey) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& axes) {
    put(folder / "experiment.toml", "machine = \"vmc850\"\nduration = \"1 h\"\n" + axes);
    return check_files({folder / "experiment.toml"})[0].mistake;
  };
  std::string const blocks = "blocks = [{duration = \"1 h\", feed = \"8 m/min\"}]\n";
  EXPECT_THAT(mistake("[[axes]]\n" + blocks + "duty = 2\n"),
              HasSubstr("experiment.toml:5:8: axes.z.duty: 2 must be above 0 and at most 1"));
  EXPECT_THAT(mistake("[[axes]]\naxis = \"z\"\nblocks = [{duration = \"10 min\"},\n  {duration = \"1 h\", feed = "
                      "\"80 m/min\"}]\n"),
              HasSubstr("experiment.toml:6:29: axes.z.blocks[1].feed: 80000 mm/min is above"));
  EXPECT_THAT(mistake("[[axes]]\n" + blocks + "stroke_to = \"100 mm\"\n"),
              HasSubstr("experiment.toml:5:13: axes.z.stroke_to: 100 mm must be beyond stroke_from, 120 mm"));
}

/// 314 rad/s would be 314 times the power.
TEST(ExperimentMistakes, RefusesAFlagThatIsNoShare) {
  TemporaryDirectory const folder;
  put(folder / "experiment.toml", experiment);
  for (auto const& [channel, unit] : {std::pair{"time_of_day", "s"}, {"ambient.temperature", "K"}}) {
    put(folder / "mine.toml", machine_with(std::string("[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 W\"\n") +
                                           "while_on = \"" + channel + "\"\n"));
    EXPECT_THAT(check_files({folder / "mine.toml", folder / "experiment.toml"})[1].mistake,
                HasSubstr(std::string("the machine takes the input '") + channel +
                          "' as a share between 0 and 1, and the experiment gives it in " + unit));
  }
}

TEST(ExperimentMistakes, RefusesTwoProgrammesOfOneChannel) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& machine, std::string const& table, std::string const& channel,
                           std::string const& value) {
    put(folder / "experiment.toml", "machine = \"" + machine + "\"\nduration = \"1 h\"\n" + table +
                                        "[[inputs]]\nchannel = \"" + channel +
                                        "\"\nblocks = [{duration = \"1 h\", value = \"" + value + "\"}]\n");
    return check_files({folder / "experiment.toml"})[0].mistake;
  };
  std::string const spindle = "[spindle]\nblocks = [{duration = \"1 h\", speed = \"100 rpm\"}]\n",
                    axis = "[[axes]]\nblocks = [{duration = \"1 h\", feed = \"8 m/min\"}]\n";
  EXPECT_THAT(mistake("v450", spindle, "spindle.speed", "1000 rpm"),
              HasSubstr("experiment.toml:6:11: inputs[0].channel: 'spindle.speed' would stand in place of "
                        "'spindle.blocks', which is written, too; leave out one of them"));
  EXPECT_THAT(mistake("v450", "power.on = false\n", "machine.on", "1"), HasSubstr("in place of 'power.on'"));
  EXPECT_THAT(mistake("v450", "coolant.on = true\n", "coolant.on", "0"), HasSubstr("in place of 'coolant.on'"));
  EXPECT_THAT(mistake("v450", "ambient.mean = \"25 degC\"\n", "ambient.temperature", "20 degC"),
              HasSubstr("in place of 'ambient.mean'"));
  EXPECT_THAT(mistake("vmc850", axis, "z.feed", "2 m/min"), HasSubstr("in place of 'axes.0.blocks'"));
  EXPECT_THAT(mistake("vmc850", axis, "z.speed", "200 rpm"), HasSubstr("in place of 'axes.0.blocks'"));
  EXPECT_EQ(mistake("vmc850", axis, "z.duty", "50 %"), "");
  EXPECT_EQ(mistake("v450", "", "spindle.speed", "1000 rpm"), "");
  EXPECT_EQ(mistake("v450", "ambient.door_openings = [{time = \"5 min\"}]\n", "ambient.temperature", "20 degC"), "");
  put(folder / "speed.csv", "time_s,n\n0,900\n3600,900\n");
  put(folder / "experiment.toml", experiment + spindle +
                                      "[[recorded]]\nfile = \"speed.csv\"\nmax_gap = \"2 h\"\ncolumns = [{column = "
                                      "\"n\", channel = \"spindle.speed\", unit = \"rpm\"}]\n");
  EXPECT_EQ(check_files({folder / "experiment.toml"})[0].mistake, "");  // as documented: in place of programmes
}

TEST(ExperimentMistakes, RefusesALaserOnAnAxisWithoutAScrew) {
  TemporaryDirectory const folder;
  put(folder / "experiment.toml", std::string(experiment) + "[laser]\naxis = \"z\"\n");
  EXPECT_THAT(
      check_files({folder / "experiment.toml", machine_file("v450")})[0].mistake,
      HasSubstr("experiment.toml:4:8: laser.axis: the laser measures axis 'z', but the machine has no ball_screw"));
}

}  // namespace
}  // namespace thermotwin::twin
