#include "twin/file_check.h"

#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "tests/twin/checked_files.h"
#include "twin/error_model_file.h"
#include "twin/machine.h"
#include "twin/study/judgement.h"

/// `thermotwin check`: each kind of file, and several together.
namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::SizeIs;
using thermotwin::tests::air;
using thermotwin::tests::experiment;
using thermotwin::tests::machine_with;
using thermotwin::tests::put;
using thermotwin::tests::recorded;
using thermotwin::tests::TemporaryDirectory;

TEST(FileCheck, FindsNothingInWhatIsShipped) {
  std::vector<fs::path> files;
  for (auto const* folder : {"twin/machines", "scenarios/catalogue"})
    for (auto const& entry : fs::directory_iterator(fs::path(THERMOTWIN_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
  auto const checks = check_files(files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_EQ(checks[i].mistake, "") << files[i];
    std::size_t const implausible = files[i].stem() == "tclab" ? 2 : 0;  // two transistors are no machine tool
    EXPECT_THAT(checks[i].warnings, SizeIs(implausible)) << files[i];
    EXPECT_NE(checks[i].text, "");
  }
}

TEST(FileCheck, KnowsTheNamesOfWhatIsShipped) {
  fs::path const source = THERMOTWIN_SOURCE_DIR;
  EXPECT_EQ(file_to_check("v450"), source / "twin/machines/v450.toml");
  EXPECT_EQ(file_to_check("golden_b_4000"), source / "scenarios/catalogue/golden_b_4000.toml");
  EXPECT_EQ(file_to_check("paper_004"), source / "scenarios/studies/paper_004.toml");
  EXPECT_EQ(file_to_check("v450_small"), source / "scenarios/campaigns/v450_small.toml");
  for (std::string const path : {"v450.toml", "some/v450", "v45"}) EXPECT_EQ(file_to_check(path), path);
  EXPECT_EQ(check_files({file_to_check("v45")})[0].mistake, "v45: there is no such file; did you mean 'v450'?");
  EXPECT_EQ(check_files({file_to_check("paper_04")})[0].mistake,
            "paper_04: there is no such file; did you mean 'paper_004'?");
}

TEST(FileCheck, AMistakeDoesNotHideTheNextFile) {
  TemporaryDirectory const folder;
  put(folder / "broken.toml", "name = ");
  put(folder / "experiment.toml", experiment);
  auto const checks = check_files({folder / "broken.toml", folder / "none.toml", folder / "experiment.toml"});
  EXPECT_THAT(checks[0].mistake, HasSubstr("broken.toml:1:"));
  EXPECT_THAT(checks[1].mistake, HasSubstr("none.toml: there is no such file"));
  EXPECT_EQ(checks[2].mistake, "");
  EXPECT_EQ(checks[2].text, "an experiment of 1.00 h on v450");
}

TEST(FileCheck, KnowsEveryKindOfFile) {
  fs::path const source = THERMOTWIN_SOURCE_DIR;
  TemporaryDirectory const folder;
  put(folder / "sites.toml", "[[site]]\nat = \"motor\"\n");
  put(folder / "model.toml",
      "[predicts]\nerror = \"E_X\"\n[model]\nmethod = \"linear\"\ninputs = [\"T2\"]\n[model.linear]\n"
      "intercept = 1\nlag = [{ samples = 0, coefficients = [1] }]\n");
  put(folder / "run.csv", "time_s,T1_degC,T2_degC,E_Z_um\n0,20,20,0\n600,21,20,3\n1200,22,20,5\n");
  put(folder / "run.toml",
      "[[table]]\nfile = \"run.csv\"\nreading = [{column = \"T1_degC\", sensor = \"T1\", unit = \"degC\"}]\n");
  auto const checks =
      check_files({source / "scenarios/studies/paper_004.toml", source / "scenarios/campaigns/v450_small.toml",
                   folder / "sites.toml", folder / "model.toml", folder / "run.csv", folder / "run.toml",
                   source / "scenarios/campaigns/v450_spectra.toml"});
  for (auto const& check : checks) EXPECT_EQ(check.mistake, "");
  EXPECT_EQ(checks[0].text, "a study of 1 world, 17 selections and 14 models");
  EXPECT_EQ(checks[1].text, "a campaign of 200 runs on v450");
  EXPECT_THAT(checks[2].text, HasSubstr("candidates of a placement: 1 site; name a machine"));
  EXPECT_EQ(checks[3].text, "an error model: linear of E_X [um] on 1 input, fitted to nobody knows what");
  EXPECT_EQ(checks[4].text, "a record of 0.33 h: 3 rows, 0 inputs, 2 sensors, 1 displacement channel");
  EXPECT_THAT(checks[4].warnings, ElementsAre(HasSubstr("run.csv: 'T2' is dead: it never moves")));
  EXPECT_EQ(checks[5].text, "a record of 0.33 h: 3 rows, 0 inputs, 1 sensor, 0 displacement channels");
  EXPECT_THAT(checks[6].text, HasSubstr("a campaign of "));
}

/// The twin is asked whether it has what it shall observe.
TEST(FileCheck, LooksAtAnObserverTogetherWithItsTwin) {
  TemporaryDirectory const folder;
  fs::copy_file(machine_file("v450"), folder / "mine.toml");
  SavedErrorModel saved;
  saved.error = "E_Z";
  saved.twin = twin_beside(folder / "mine.toml");
  auto const check = [&](std::vector<std::string> const& sensors, bool mean) {
    saved.parts = {observing_part(sensors, {})};
    if (mean) saved.parts.push_back({nothing_more(sensors), true, {}});
    write_error_model(folder / "model.toml", saved);
    return check_files({folder / "model.toml"})[0];
  };
  EXPECT_EQ(check({"T1", "T3"}, false).text,
            "an error model: twin observer of E_Z [um] on 2 inputs, fitted to nobody knows what");
  EXPECT_THAT(check({"T1", "T33"}, false).mistake,
              HasSubstr("model.toml:12:17: the twin has no sensor 'T33' on a body; did you mean 'T3'?"));
  EXPECT_THAT(check({"T1", "T33"}, true).mistake,
              HasSubstr("model.toml:12:17: the twin has no sensor 'T33' on a body"));
  saved.error = "E_W";
  EXPECT_THAT(check({"T1"}, false).mistake, HasSubstr("model.toml:10:1: the machine has no displacement 'E_W'"));
}

TEST(FileCheck, FindsTheMistakesOfEveryKind) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& text, std::string const& name = "file.toml") {
    put(folder / name, text);
    return check_files({folder / name})[0].mistake;
  };
  EXPECT_THAT(mistake("models = [\"linear\"]\nselections = [\"al\"]\n"),
              HasSubstr("file.toml:2:15: no selection method 'al'"));
  EXPECT_THAT(mistake("experiments = [\"etv\"]\n"), HasSubstr("file.toml:1:16: there is no experiment 'etv'"));
  EXPECT_THAT(mistake("experiments = [\"etve\"]\nmachine = \"v450\"\ntolerance = 0\n"),
              HasSubstr("file.toml:3:13: 'tolerance' is 0; allowed is 1e-12 to 0.01"));
  EXPECT_THAT(mistake("predicts = { error = \"E_X\" }\n"), HasSubstr("file.toml:1:1: no table [model]"));
  EXPECT_THAT(mistake("forbiden = []\nmost = 3\n"), HasSubstr("file.toml:1:1: unknown key 'forbiden'"));
  EXPECT_THAT(mistake("[[table]]\nfile = \"none.csv\"\n"), HasSubstr("none.csv"));
  EXPECT_THAT(mistake("time_s,T1_degC\n0,20\n60,warm\n", "run.csv"),
              HasSubstr("run.csv:3:4: column 'T1_degC': 'warm'"));
}

TEST(FileCheck, TellsAMistakeOfAMachineOnce) {
  TemporaryDirectory const folder;
  put(folder / "mine.toml", machine_with("[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 K\"\n"));
  put(folder / "experiment.toml", "machine = \"mine.toml\"\nduration = \"1 h\"\n");
  auto const checks = check_files({folder / "experiment.toml", folder / "mine.toml"});
  EXPECT_EQ(checks[0].mistake, "");
  EXPECT_EQ(checks[0].text, "an experiment of 1.00 h, not looked at together with 'mine.toml', which has a mistake");
  EXPECT_THAT(checks[1].mistake, HasSubstr("mine.toml:"));
  EXPECT_EQ(check_files({folder / "experiment.toml"})[0].mistake, checks[1].mistake);
}

TEST(FileCheck, LooksAtCandidatesAndMachineTogether) {
  TemporaryDirectory const folder;
  put(folder / "sites.toml", "forbidden = [\"rotr\"]\n");
  auto const checks = check_files({folder / "sites.toml", machine_file("v450")});
  EXPECT_THAT(checks[0].mistake, HasSubstr("sites.toml:1:14: unknown body 'rotr'; did you mean 'rotor'?"));
  EXPECT_EQ(checks[1].mistake, "");
}

TEST(FileCheck, LooksAtMachineAndExperimentTogether) {
  TemporaryDirectory const folder;
  put(folder / "mine.toml", machine_with("[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 W\"\n"
                                         "while_on = \"coolant.onn\"\n"));
  put(folder / "experiment.toml", experiment);
  EXPECT_EQ(check_files({folder / "mine.toml"})[0].mistake, "");
  auto const checks = check_files({folder / "mine.toml", folder / "experiment.toml"});
  EXPECT_EQ(checks[0].mistake, "");
  EXPECT_THAT(checks[1].mistake, MatchesRegex(".*mine.toml:[0-9]+:[0-9]+: the machine needs the input 'coolant.onn', "
                                              "which the experiment does not give; did you mean 'coolant.on'\\?"));
}

/// With `run -m` that is as it should be; whoever meant the other machine is told.
TEST(FileCheck, WarnsOfAnExperimentOfAnotherMachine) {
  TemporaryDirectory const folder;
  fs::copy_file(machine_file("v450"), folder / "mine.toml");
  fs::copy_file(machine_file("vmc850"), folder / "other.toml");
  auto const warnings = [&](std::string const& named, std::string const& machine) {
    put(folder / "day.toml", "machine = \"" + named + "\"\nduration = \"1 h\"\n");
    return check_files({folder / machine, folder / "day.toml"})[1].warnings;
  };
  EXPECT_THAT(warnings("v450", "other.toml"),
              Contains(HasSubstr("day.toml: it is an experiment of 'v450', the machine file is 'vmc850'")));
  EXPECT_THAT(warnings("v450.toml", "other.toml"),
              Contains(HasSubstr("day.toml: it is an experiment of 'v450.toml', the machine file is 'vmc850'")));
  for (auto const* named : {"v450", "v450_fine", "mine.toml", "v450.toml", "machines/v450.toml"})
    EXPECT_THAT(warnings(named, "mine.toml"), testing::Not(Contains(HasSubstr("it is an experiment of")))) << named;
}

TEST(FileCheck, LooksAtTheExperimentsOfAStudy) {
  TemporaryDirectory const folder;
  put(folder / "air.csv", air);
  put(folder / "short.toml", experiment + recorded("ambient.temperature"));
  put(folder / "long.toml", "machine = \"v450\"\nduration = \"5 h\"\n" + recorded("ambient.temperature"));
  auto const with = [&](std::string const& test, std::string const& more = "") {
    put(folder / "study.toml",
        "selections = [\"all\"]\nmodels = [\"linear\"]\n[[world]]\nname = \"shop\"\nmachine = \"v450\"\nerror = "
        "\"E_Z\"\ntrain = [\"short.toml\"]\ntest = [\"" +
            test + "\"]\n" + more);
    return check_files({folder / "study.toml"})[0].mistake;
  };
  EXPECT_EQ(with("golden_b_2000"), "");
  EXPECT_THAT(with("long.toml"), HasSubstr("study.toml:8:9: world 'shop': 'long.toml': "));
  EXPECT_THAT(with("long.toml"), HasSubstr("air.csv: covers 0 s to 3600 s of a run of 18000 s"));
  put(folder / "fast.toml",
      std::string(experiment) + "spindle.blocks = [{duration = \"1 h\", speed = \"7000 rpm\"}]\n");
  EXPECT_THAT(with("fast.toml"), HasSubstr("fast.toml:3:46: spindle.blocks[0].speed: 7000 rpm is above the machine's "
                                           "maximum, 6000 rpm"));
  EXPECT_EQ(with("fast.toml", "set = [\"spindle.maximum_speed=8000 rpm\"]\n"), "");
  EXPECT_THAT(with("fast.toml",
                   "add = '''\n[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 W\"\n"
                   "while_on = \"pump.on\"\n'''\nset = [\"spindle.maximum_speed=8000 rpm\"]\n"),
              HasSubstr("the machine needs the input 'pump.on', which the experiment does not give"));
}

TEST(FileCheck, DoubtsTheUnitOfTimeOfAShortRecord) {
  TemporaryDirectory const folder;
  std::string rows = "t,T1\n";
  for (int row = 0; row < 12; ++row) rows += fmt::format("{},{}\n", 3000 * row, 21 + 0.3 * row);
  put(folder / "run.csv", rows);
  auto const checks = [&](std::string const& unit, std::vector<fs::path> files) {
    put(folder / "run.toml", "[[table]]\nfile = \"run.csv\"\ntime_column = \"t\"\ntime_unit = \"" + unit +
                                 "\"\nreading = [{column = \"T1\", sensor = \"T1\", unit = \"degC\"}]\n");
    files.insert(files.begin(), folder / "run.toml");
    return check_files(files)[0];
  };
  auto const doubt = HasSubstr("run.toml: the record lasts 33 s in all; is its unit of time right?");
  EXPECT_THAT(checks("s", {}).warnings, testing::Not(Contains(doubt)));
  EXPECT_THAT(checks("ms", {}).warnings, ElementsAre(doubt));
  EXPECT_THAT(checks("ms", {machine_file("v450")}).warnings, Contains(doubt));
}

TEST(FileCheck, NamesTheFileOfAnImpossibleSensor) {
  TemporaryDirectory const folder;
  put(folder / "run.csv", "time_s,T1_mK\n0,32000\n60,32001\n120,32002\n");
  EXPECT_EQ(check_files({folder / "run.csv"})[0].mistake,
            (folder / "run.csv").string() + ": sensor 'T1' reads 32001.0 mK most of the time; is its unit right?");
}

TEST(FileCheck, LooksAtRecordAndMachineTogether) {
  TemporaryDirectory const folder;
  std::string rows = "time_s,n,room,T1\n";
  for (int row = 0; row < 12; ++row)
    rows += fmt::format("{},{},{},{}\n", 300 * row, row < 6 ? 3000 : 5000, 20 + 0.1 * row, 21 + 0.3 * row);
  put(folder / "run.csv", rows);
  auto const checks = [&](std::string const& speed) {
    put(folder / "run.toml",
        "[[table]]\nfile = \"run.csv\"\ninput = [{column = \"n\", channel = \"" + speed +
            "\", unit = \"1/min\"}, {column = \"room\", channel = \"ambient.temperature\", unit = \"degC\"}]\n"
            "reading = [{column = \"T1\", sensor = \"T1\", unit = \"degC\"}]\n");
    return check_files({folder / "run.toml", machine_file("v450")});
  };
  auto const right = checks("spindle.speed");
  EXPECT_EQ(right[0].mistake, "");
  EXPECT_EQ(right[0].text,
            "a record of 0.92 h: 12 rows, 2 inputs (spindle.speed changes 1 time), 1 sensor, 0 displacement channels, "
            "on v450");
  EXPECT_THAT(right[0].warnings, Contains(HasSubstr("run.toml: of the machine, but not in the data: T2")));
  auto const wrong = checks("spindel.speed");
  EXPECT_THAT(wrong[0].mistake,
              HasSubstr("run.toml:3:35: nothing on 'v450' reads 'spindel.speed'; did you mean 'spindle.speed'?"));
  EXPECT_EQ(wrong[1].mistake, "");
  auto const alone = check_files({folder / "run.toml"});
  EXPECT_EQ(alone[0].mistake, "");
  EXPECT_THAT(alone[0].warnings,
              Contains(HasSubstr("run.toml:3:35: input 'spindel.speed': did you mean 'spindle.speed'?")));
}

}  // namespace
}  // namespace thermotwin::twin
