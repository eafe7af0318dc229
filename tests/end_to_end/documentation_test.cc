#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/end_to_end/broker_process.h"
#include "tests/end_to_end/chapter.h"
#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"

/// The documentation is what its readers type.
namespace thermotwin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::TemporaryDirectory;

fs::path const root = THERMOTWIN_SOURCE_DIR;

std::vector<std::string> chapters() {
  std::vector<std::string> names = {"README.md"};
  for (auto const& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") names.push_back("docs/" + entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

fs::path measured_data() {
  char const* given = std::getenv("THERMOTWIN_MEASURED_DATA");
  return given ? fs::path(given) : root.parent_path() / "shared" / "data";
}

/// What stays of a page for bash: its blocks that are run, each after what it is given and as its notes change it.
std::string script_of(std::string const& chapter, TemporaryDirectory const& folder) {
  std::string script = "set -ex\ntrap 'kill $(jobs -p) 2>/dev/null || true' EXIT\n";
  int number = 0;
  for (auto const& block : tests::command_blocks(root / chapter)) {
    if (block.not_run) continue;
    auto const name = fmt::format("block_{}", ++number);
    tests::put(folder / name, block.text);
    tests::put(folder / (name + ".sed"), block.with);
    auto const changed = tests::answer(fmt::format("sed -E -f '{0}.sed' '{0}'", (folder / name).string()));
    EXPECT_TRUE(block.with.empty() || changed != block.text) << chapter << ":" << block.line << ": nothing is changed";
    script += block.given + changed;
  }
  return script;
}

/// The program as the pages call it. `view` serves until it is told to end; half a second is enough for its address.
void put_program(TemporaryDirectory const& folder) {
  fs::create_directories(folder / "build");
  tests::put(folder / "build/thermotwin", fmt::format(R"(#!/bin/sh
if [ "$1" != view ]; then exec '{0}' "$@"; fi
timeout --signal=INT 0.5 '{0}' "$@"
[ $? -eq 124 ]
)",
                                                      THERMOTWIN_PROGRAM));
  fs::permissions(folder / "build/thermotwin", fs::perms::owner_all);
  for (char const* name : {"scenarios", "twin", "output", "script"})
    fs::create_directory_symlink(root / name, folder / name);
}

/// What a page's commands print, run one after the other in a folder that looks like the repository.
std::string answer_of(std::string const& chapter, TemporaryDirectory const& folder) {
  put_program(folder);
  auto const script =
      std::regex_replace(script_of(chapter, folder), std::regex("1883"), std::to_string(tests::free_port()));
  tests::put(folder / "page.sh", script);
  return tests::answer("cd '" + folder.path().string() + "' && THERMOTWIN='" + root.string() +
                       "' THERMOTWIN_MEASURED_DATA='" + measured_data().string() + "' PATH='" +
                       (folder / "build").string() + "':\"$PATH:/usr/sbin\" bash page.sh");
}

TEST(Tutorial, EveryCommandDoesWhatItSays) {
  TemporaryDirectory const folder;
  auto const text = answer_of("docs/tutorial.md", folder);
  EXPECT_THAT(text, HasSubstr("[[hot_neighbour]]"));  // at first; then it is excluded
  std::smatch found;
  auto const last = text.substr(text.rfind("Missing: 1 effect"));
  ASSERT_TRUE(std::regex_search(last, found, std::regex("at column_rear: power = ([0-9.]+) W"))) << last;
  EXPECT_NEAR(std::stod(found[1]), 60.0, 10.0);
  EXPECT_THAT(tests::contents(folder / "tutorial" / "amended.toml"), HasSubstr("[[heat]]\nname = \"diagnosed_1\""));
  for (char const* made : {"expected.html", "monday.html", "found/report.html", "tuesday.html", "gap.svg"})
    EXPECT_TRUE(fs::exists(folder / "tutorial" / made)) << made;
  auto const fonts = tests::answer("pdffonts '" + (folder / "tutorial" / "growth.pdf").string() + "'");
  EXPECT_THAT(fonts, HasSubstr("DejaVuSans"));
  EXPECT_THAT(fonts, HasSubstr(" yes yes "));  // embedded, a subset
  EXPECT_THAT(fonts, testing::Not(HasSubstr(" no  ")));
}

TEST(Documentation, DescribesAMachineThatRuns) {
  TemporaryDirectory const folder;
  auto const text = answer_of("docs/machine.md", folder);
  EXPECT_THAT(text, HasSubstr("the machine press: 11 nodes"));
  EXPECT_THAT(text, HasSubstr("could be taken for each other"));
  EXPECT_TRUE(fs::exists(folder / "machine" / "day.html"));
}

TEST(Documentation, MeasuresAndCalibrates) {
  TemporaryDirectory const folder;
  auto const text = answer_of("docs/measuring.md", folder);
  EXPECT_THAT(text, HasSubstr("bearing.front.grease_factor"));
  EXPECT_TRUE(fs::exists(folder / "calibrated.toml"));
}

/// Chapters whose commands no test above runs.
class Chapter : public testing::TestWithParam<std::string> {
 public:
  static std::vector<std::string> others() {
    std::vector<std::string> names;
    for (auto const& name : chapters()) {
      bool const above = name == "docs/tutorial.md" || name == "docs/machine.md" || name == "docs/measuring.md";
      auto const blocks = tests::command_blocks(root / name);
      bool const runs = std::any_of(blocks.begin(), blocks.end(), [](auto const& block) { return !block.not_run; });
      if (runs && !above) names.push_back(name);
    }
    return names;
  }
};

TEST_P(Chapter, CommandsRun) {
  if (GetParam() == "docs/measured_data.md" && !fs::exists(measured_data()))
    GTEST_SKIP() << "there are no measured data";
  TemporaryDirectory const folder;
  EXPECT_THAT(answer_of(GetParam(), folder), HasSubstr("thermotwin"));
}

INSTANTIATE_TEST_SUITE_P(Of, Chapter, testing::ValuesIn(Chapter::others()),
                         [](auto const& chapter) { return fs::path(chapter.param).stem().string(); });

/// What is not run is known by name, and there is no other.
TEST(Documentation, LeavesOutOnlyWhatATestCannotRun) {
  std::vector<std::string> left_out;
  std::size_t run = 0;
  for (auto const& name : chapters())
    for (auto const& block : tests::command_blocks(root / name)) {
      if (block.not_run)
        left_out.push_back(name + ": " + block.text.substr(0, block.text.find_first_of(" \n")));
      else
        ++run;
    }
  EXPECT_THAT(left_out,
              testing::UnorderedElementsAre("README.md: script/demo",             // installs and builds
                                            "docs/tutorial.md: script/build",     // the same
                                            "docs/campaign.md: sbatch",           // script/slurm runs it
                                            "docs/compensation.md: thermotwin",   // placeholders of what follows there
                                            "docs/performance.md: script/bench",  // hours
                                            "docs/reduced_model.md: build/thermotwin_bench",  // ten minutes
                                            "docs/report.md: thermotwin"));                   // runs of minutes
  EXPECT_GT(run, 30U);
}

/// No line that looks like a command stands outside the blocks that are run or left out.
TEST(Documentation, HidesNoCommandFromItsTest) {
  std::regex const command(R"(^\s*(xvfb-run -a )?(build/)?thermotwin [a-z].*)");
  int seen = 0;
  for (auto const& name : chapters()) {
    std::string known;
    for (auto const& block : tests::command_blocks(root / name)) known += block.given + block.text;
    std::istringstream lines(tests::contents(root / name));
    for (std::string line; std::getline(lines, line);) {
      if (!std::regex_match(line, command)) continue;
      ++seen;
      auto const text = line.substr(line.find_first_not_of(' '));
      EXPECT_THAT(known, HasSubstr(text.substr(0, text.find(" -->")))) << name;
    }
  }
  EXPECT_GT(seen, 60);
}

/// Commands that pages show exist, with the options that they show.
TEST(Documentation, NamesCommandsAndOptionsThatThereAre) {
  std::string const program = THERMOTWIN_PROGRAM;
  std::map<std::string, std::string> help;
  int seen = 0;
  for (auto const& page : chapters()) {
    std::istringstream lines(tests::contents(root / page));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line.substr(0, line.find(" #")));
      std::string word, command;
      words >> word;
      if (word == "xvfb-run") words >> word >> word;  // -a
      if (word != "thermotwin" && word != "build/thermotwin") continue;
      words >> command;
      if (command.starts_with('-') || !std::isalpha(static_cast<unsigned char>(command[0]))) continue;
      if (!help.contains(command)) help[command] = tests::answer(program + " " + command + " --help");
      ++seen;
      while (words >> word) {
        if (!word.starts_with("--")) continue;
        EXPECT_THAT(help[command], HasSubstr(word.substr(0, word.find('=')))) << page << ": " << line;
      }
    }
  }
  EXPECT_GT(seen, 50);
}

}  // namespace
}  // namespace thermotwin
