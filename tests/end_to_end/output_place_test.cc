#include <filesystem>
#include <gtest/gtest.h>
#include <map>

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

}  // namespace
}  // namespace thermotwin
