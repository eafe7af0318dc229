#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
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

/// What a page's commands print, run one after the other in a folder that looks like the repository; what the page
/// quotes stands in it.
std::string answer_of(std::string const& chapter, TemporaryDirectory const& folder) {
  put_program(folder);
  auto const script =
      std::regex_replace(script_of(chapter, folder), std::regex("1883"), std::to_string(tests::free_port()));
  tests::put(folder / "page.sh", script);
  auto const text = tests::answer("cd '" + folder.path().string() + "' && THERMOTWIN='" + root.string() +
                                  "' THERMOTWIN_MEASURED_DATA='" + measured_data().string() + "' PATH='" +
                                  (folder / "build").string() + "':\"$PATH:/usr/sbin\" bash page.sh");
  for (auto const& quote : tests::quotes(root / chapter))
    EXPECT_TRUE(tests::is_said(quote, text)) << chapter << ": nothing said so: " << quote;
  return text;
}

TEST(Tutorial, EveryCommandDoesWhatItSays) {
  TemporaryDirectory const folder;
  auto const text = answer_of("docs/tutorial.md", folder);
  std::smatch found;
  auto const last = text.substr(text.rfind("Missing: 1 effect"));
  ASSERT_TRUE(std::regex_search(last, found, std::regex("at head_rear: power = ([0-9.]+) W"))) << last;
  EXPECT_NEAR(std::stod(found[1]), 100.0, 15.0);
  ASSERT_TRUE(std::regex_search(last, found, std::regex(R"(\n  A +urad +([0-9.]+) +([0-9.]+) )"))) << last;
  EXPECT_NEAR(std::stod(found[1]), 4.1, 0.2);
  EXPECT_LT(std::stod(found[2]), 0.01 * std::stod(found[1]));
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
  EXPECT_THAT(text, HasSubstr("Every effect that is seen can be told from every other."));
  EXPECT_TRUE(fs::exists(folder / "machine" / "day.html"));
}

TEST(Documentation, MeasuresAndCalibrates) {
  TemporaryDirectory const folder;
  auto const text = answer_of("docs/measuring.md", folder);
  EXPECT_THAT(text, HasSubstr("bearing.front.grease_factor"));
  EXPECT_TRUE(fs::exists(folder / "calibrated.toml"));
}

TEST(Documentation, QuotesWhatTheProgramSays) {
  std::string const said = "Missing: 1 effect.\n\n  heat at bed: power = 59.6 W ± 21 W\n";
  EXPECT_TRUE(tests::is_said("Missing: 1 effect. heat at bed: power = 60.2 W ± 23 W", said));
  EXPECT_FALSE(tests::is_said("heat at bed: power = 90 W ± 21 W", said));
  EXPECT_FALSE(tests::is_said("heat at head: power = 59.6 W ± 21 W", said));
  EXPECT_GE(tests::quotes(root / "docs/tutorial.md").size(), 2U);
  EXPECT_GE(tests::quotes(root / "README.md").size(), 1U);
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

/// Names of options, short and long, in a text of help or of a script.
std::set<std::string> options_in(std::string const& text) {
  static std::regex const option(R"((?:^|[\s,'"([|])(--?[A-Za-z][A-Za-z-]*))");
  std::set<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match)
    found.insert((*match)[1]);
  return found;
}

/// The options of every subcommand.
std::map<std::string, std::set<std::string>> options_of_program() {
  std::string const program = THERMOTWIN_PROGRAM;
  auto const help = tests::answer(program + " --help");
  std::map<std::string, std::set<std::string>> options;
  std::regex const subcommand("\n  ([a-z]+) ");
  for (std::sregex_iterator match(help.begin() + std::ptrdiff_t(help.find("Subcommands:")), help.end(), subcommand),
       end;
       match != end; ++match) {
    std::string const name = (*match)[1];
    std::istringstream lines(tests::answer(program + " " + name + " --help"));
    for (std::string line; std::getline(lines, line);) {
      auto const head = line.substr(std::min(line.size(), line.find_first_not_of(' ')));
      if (head.starts_with("-")) options[name].merge(options_in(head.substr(0, head.find_first_of(" =["))));
    }
  }
  return options;
}

/// What pages show as typed: lines of blocks, and what stands between backticks, with its page.
std::vector<std::pair<std::string, std::string>> shown_commands() {
  std::vector<std::pair<std::string, std::string>> shown;
  for (auto const& page : chapters()) {
    std::istringstream lines(tests::contents(root / page));
    for (std::string line; std::getline(lines, line);)
      if (tests::is_typed(line.substr(std::min(line.size(), line.find_first_not_of(' ')))))
        shown.emplace_back(page, line.substr(0, line.find(" #")));
    for (auto const& span : tests::code_spans(tests::sentences(root / page))) shown.emplace_back(page, span);
  }
  return shown;
}

/// Commands exist with the options that pages show: in blocks, and in sentences also where they are cut to
/// `diagnose --json` or `--hold-out`.
TEST(Documentation, NamesCommandsAndOptionsThatThereAre) {
  auto const program = options_of_program();
  ASSERT_GT(program.size(), 15U);
  std::set<std::string> any;
  for (auto const& [name, options] : program) any.insert(options.begin(), options.end());
  int seen = 0;
  for (auto const& [page, text] : shown_commands()) {
    std::istringstream words(text);
    std::vector<std::string> const all{std::istream_iterator<std::string>(words), {}};
    std::set<std::string> const* known = !all.empty() && all[0].starts_with("-") ? &any : nullptr;
    std::set<std::string> of_script;
    for (std::size_t i = 0; i < all.size(); ++i) {
      bool const program_itself = all[i] == "thermotwin" || all[i] == "build/thermotwin";
      if (program_itself && i + 1 < all.size() && std::isalpha(static_cast<unsigned char>(all[i + 1][0]))) {
        ASSERT_TRUE(program.contains(all[i + 1])) << page << ": " << text;
        known = &program.at(all[++i]);
      } else if (i == 0 && all.size() > 1 && program.contains(all[0])) {
        known = &program.at(all[0]);
      } else if (all[i].starts_with("script/")) {
        ASSERT_TRUE(fs::exists(root / all[i])) << page << ": " << text;
        of_script = options_in(tests::contents(root / all[i]));
        known = &of_script;
      }
      auto const option = options_in(all[i].substr(0, all[i].find('=')));
      if (!known || option.empty() || all[i].find("test_") != all[i].npos) continue;
      ++seen;
      EXPECT_TRUE(known->contains(*option.begin())) << page << ": " << text << "\n" << *option.begin();
    }
  }
  EXPECT_GT(seen, 250);
}

/// Words of letters, digits and underscores.
std::set<std::string> names_in(std::string const& text) {
  std::set<std::string> names;
  std::string name;
  for (char const c : text + " ") {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_')
      name += c;
    else if (!name.empty())
      names.insert(std::exchange(name, {}));
  }
  return names;
}

/// All of them in the sources, files' names included.
std::set<std::string> names_of_tree() {
  std::set<std::string> names;
  for (char const* folder : {"thermal", "models", "scenarios", "output", "twin", "tests", "script"})
    for (auto entry = fs::recursive_directory_iterator(root / folder); entry != end(entry); ++entry) {
      if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
      if (!entry->is_regular_file() || entry->path().extension() == ".csv") continue;
      names.merge(names_in(entry->path().filename()));
      names.merge(names_in(tests::contents(entry->path())));
    }
  return names;
}

/// Machines, experiments, effects, keys, methods, tests: a name with a digit or an underscore between backticks is one
/// that the sources know, and a path into them leads to a file.
TEST(Documentation, NamesWhatThereIs) {
  auto known = names_of_tree();
  known.insert({"autosave_interval", "max_queued_messages"});  // of mosquitto's file
  std::regex const name(R"([A-Za-z][a-z0-9_]*[0-9_][A-Za-z0-9_]*)"),
      path(R"((thermal|models|scenarios|output|twin|tests|script|docs)/[\w/.]*)");
  int names = 0, paths = 0;
  for (auto const& page : chapters())
    for (auto const& span : tests::code_spans(tests::sentences(root / page))) {
      std::istringstream words(span);
      for (std::string word; words >> word;) {
        bool const is_name = std::regex_match(word, name), is_path = std::regex_match(word, path);
        names += is_name;
        paths += is_path;
        EXPECT_TRUE(!is_name || known.contains(word)) << page << ": " << span;
        EXPECT_TRUE(!is_path || fs::exists(root / word)) << page << ": " << span;
      }
    }
  EXPECT_GT(names, 250);
  EXPECT_GT(paths, 30);
}

/// `build/twin_test --gtest_filter=…` and the like choose something.
TEST(Documentation, NamesTestsAndBenchmarksThatThereAre) {
  std::regex const command(R"(build/(\w+) --(gtest|benchmark)_filter=(\S+).*)");
  fs::path const build = fs::path(THERMOTWIN_PROGRAM).parent_path();
  std::smatch found;
  int seen = 0;
  for (auto const& [page, text] : shown_commands()) {
    if (!std::regex_match(text, found, command)) continue;
    ++seen;
    if (!fs::exists(build / found[1].str())) GTEST_SKIP() << found[1] << " has not been built";
    auto const list = found[2] == "gtest" ? "--gtest_list_tests" : "--benchmark_list_tests";
    auto const chosen = tests::answer(fmt::format("cd '{}' && ./{} {} --{}_filter={}", build.string(), found[1].str(),
                                                  list, found[2].str(), found[3].str()));
    if (found[2] == "gtest")
      EXPECT_THAT(chosen, HasSubstr("\n  ")) << page << ": " << text;
    else
      EXPECT_THAT(chosen, testing::Not(HasSubstr("Failed to match"))) << page << ": " << text;
  }
  EXPECT_GT(seen, 8);
}

}  // namespace
}  // namespace thermotwin
