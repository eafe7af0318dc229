#include "twin/file_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "twin/machine.h"

/// `thermotwin check`: each file by itself, and experiments with their machine.
namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::SizeIs;
using thermotwin::tests::contents;
using thermotwin::tests::put;
using thermotwin::tests::TemporaryDirectory;

constexpr char const* experiment = "machine = \"v450\"\nduration = \"1 h\"\n";

/// The lumped machine with one thing more.
std::string machine_with(std::string const& table) { return contents(machine_file("v450")) + table; }

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

TEST(FileCheck, WarnsOfWhatIsNotPlausible) {
  TemporaryDirectory const folder;
  auto text = contents(machine_file("v450"));
  std::string const factor = "grease_factor = 0.55";
  text.replace(text.find(factor), factor.size(), "grease_factor = 55");
  put(folder / "machine.toml", text);
  put(folder / "experiment.toml", std::string(experiment) + "ambient.daily_cycle.amplitude = \"12 K\"\n");
  auto const checks = check_files({folder / "machine.toml", folder / "experiment.toml"});
  EXPECT_EQ(checks[0].mistake, "");
  EXPECT_THAT(checks[0].warnings,
              ElementsAre(MatchesRegex(
                  ".*machine.toml:[0-9]+:[0-9]+: 'grease_factor' is 55; outside what is plausible: 0.2 to 8")));
  EXPECT_THAT(checks[1].warnings, ElementsAre(HasSubstr("'amplitude' is \"12 K\"; outside what is plausible")));
}

TEST(FileCheck, CountsInWholeNumbers) {
  TemporaryDirectory const folder;
  auto text = contents(machine_file("v450"));
  text.replace(text.find("count = 2"), 9, "count = 2.5");
  put(folder / "machine.toml", text);
  EXPECT_THAT(check_files({folder / "machine.toml"})[0].mistake,
              MatchesRegex(".*machine.toml:[0-9]+:[0-9]+: 'count' is 2.5; a whole number is due"));
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
                   folder / "sites.toml", folder / "model.toml", folder / "run.csv", folder / "run.toml"});
  for (auto const& check : checks) EXPECT_EQ(check.mistake, "");
  EXPECT_EQ(checks[0].text, "a study of 1 world, 8 selections and 11 models");
  EXPECT_EQ(checks[1].text, "a campaign of 200 runs on v450");
  EXPECT_THAT(checks[2].text, HasSubstr("candidates of a placement: 1 site; name a machine"));
  EXPECT_EQ(checks[3].text, "an error model: linear of E_X [um] on 1 input, fitted to nobody knows what");
  EXPECT_EQ(checks[4].text, "a record of 0.33 h: 3 rows, 0 inputs, 2 sensors, 1 displacement channel");
  EXPECT_THAT(checks[4].warnings, ElementsAre(HasSubstr("run.csv: 'T2' is dead: it never moves")));
  EXPECT_EQ(checks[5].text, "a record of 0.33 h: 3 rows, 0 inputs, 1 sensor, 0 displacement channels");
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

}  // namespace
}  // namespace thermotwin::twin
