#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <sstream>

#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"

/// The documentation is what its readers type.
namespace thermotwin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::TemporaryDirectory;

/// The blocks ```sh of a page, one after the other.
std::string script_of(fs::path const& page) {
  std::istringstream lines(tests::contents(page));
  std::string script;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      inside = line == "```sh";
    else if (inside)
      script += line + "\n";
  }
  return script;
}

/// What a page's blocks print, run one after the other in an empty folder.
std::string answer_of(std::string const& page, TemporaryDirectory const& folder) {
  fs::path const root = THERMOTWIN_SOURCE_DIR;
  tests::put(folder / "page.sh", "set -ex\n" + script_of(root / "docs" / page));
  return tests::answer("cd '" + folder.path().string() + "' && THERMOTWIN='" + root.string() + "' PATH='" +
                       fs::path(THERMOTWIN_PROGRAM).parent_path().string() + "':\"$PATH\" bash page.sh");
}

TEST(Tutorial, EveryCommandDoesWhatItSays) {
  TemporaryDirectory const folder;
  auto const text = answer_of("tutorial.md", folder);
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
  auto const text = answer_of("machine.md", folder);
  EXPECT_THAT(text, HasSubstr("the machine press: 11 nodes"));
  EXPECT_THAT(text, HasSubstr("could be taken for each other"));
  EXPECT_TRUE(fs::exists(folder / "machine" / "day.html"));
}

TEST(Documentation, MeasuresAndCalibrates) {
  TemporaryDirectory const folder;
  auto const text = answer_of("measuring.md", folder);
  EXPECT_THAT(text, HasSubstr("bearing.front.grease_factor"));
  EXPECT_TRUE(fs::exists(folder / "calibrated.toml"));
}

/// Commands that pages show exist, with the options that they show.
TEST(Documentation, NamesCommandsAndOptionsThatThereAre) {
  fs::path const root = THERMOTWIN_SOURCE_DIR;
  std::string const program = THERMOTWIN_PROGRAM;
  std::map<std::string, std::string> help;
  std::vector<fs::path> pages = {root / "README.md"};
  for (auto const& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  int seen = 0;
  for (auto const& page : pages) {
    std::istringstream lines(tests::contents(page));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line.substr(0, line.find(" #")));
      std::string word, command;
      words >> word;
      if (word == "xvfb-run") words >> word;
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
