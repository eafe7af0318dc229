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
