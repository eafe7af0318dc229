#include <filesystem>
#include <gtest/gtest.h>
#include <map>

#include "tests/end_to_end/earlier_run.h"
#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"

/// What a command puts in no other file's place, and says so before its work.
namespace thermotwin {
namespace {

namespace fs = std::filesystem;

std::string const program = THERMOTWIN_PROGRAM;

TEST(OutputPlace, OfAnotherKindIsKept) {
  tests::TemporaryDirectory const directory;
  fs::path const source = THERMOTWIN_SOURCE_DIR;
  std::map<std::string, std::string> const files = {
      {"machine.toml", tests::contents(source / "twin/machines/v450.toml")},
      {"experiment.toml", tests::contents(source / "scenarios/catalogue/golden_b_2000.toml")}};
  for (auto const& [name, text] : files) tests::put(directory / name, text);
  for (std::string const arguments :
       {"fit none.h5 --error E_Z -o machine.toml", "fit none.h5 --error E_Z -o experiment.toml",
        "calibrate v450 none.h5 -o experiment.toml", "diagnose v450 none.h5 -o experiment.toml",
        "place v450 -k 2 -o experiment.toml", "place v450 -k 2 -o machine.toml"}) {
    auto const said = tests::answer("cd " + directory.path().string() + " && " + program + " " + arguments, 2);
    EXPECT_NE(said.find("name another output"), std::string::npos) << arguments << "\n" << said;
    for (auto const& [name, text] : files) EXPECT_TRUE(tests::contents(directory / name) == text) << arguments;
  }
  auto const said = tests::answer(
      "cd " + directory.path().string() + " && " + program + " calibrate v450 none.h5 -o machine.toml", 2);
  EXPECT_NE(said.find("none.h5"), std::string::npos) << said;  // it went on to its data
}

TEST(OutputPlace, OfARunIsTakenByAnother) {
  tests::TemporaryDirectory const directory;
  auto const run = (directory / "run.h5").string();
  tests::answer(program + " run golden_b_2000 -q -o " + run);
  fs::copy_file(run, directory / "again.h5");
  for (std::string const command : {"run golden_b_2000 -q", "run golden_b_2000 -q --reduced", "replay again.h5"})
    tests::answer("cd " + directory.path().string() + " && " + program + " " + command + " -o run.h5");
}

TEST(OutputPlace, OfOtherDataIsKept) {
  tests::TemporaryDirectory const directory;
  auto const run = (directory / "run.h5").string();
  tests::put_earlier_run(run);
  output::Dataset record;
  record.title = "Compensation of X";
  record.time_s = Eigen::Vector2d(0.0, 10.0);
  output::write(record, directory / "live.h5");
  output::write(record, directory / "killed.h5.partial");
  tests::put(directory / "foreign.h5", "what another program wrote");
  for (std::string const name : {"live.h5", "killed.h5", "foreign.h5"}) {
    auto const path = (directory / name).string(), there = name == "killed.h5" ? path + ".partial" : path;
    auto const before = tests::contents(there);
    for (auto const& command :
         {std::string("run golden_b_2000"), std::string("run golden_b_2000 --reduced"), "replay " + run}) {
      auto const said = tests::answer(program + " " + command + " -o " + path, 2);
      EXPECT_NE(said.find(there + ": is no run, whose place one does not take"), std::string::npos) << command << said;
      EXPECT_TRUE(tests::contents(there) == before) << command;
    }
  }
}

}  // namespace
}  // namespace thermotwin
