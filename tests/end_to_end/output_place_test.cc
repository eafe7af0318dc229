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

using tests::run_program;

fs::path const source = THERMOTWIN_SOURCE_DIR;
std::string const program = THERMOTWIN_PROGRAM;

TEST(OutputPlace, OfAnotherKindIsKept) {
  tests::TemporaryDirectory const directory;
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

TEST(OutputPlace, FilesThatAreReadAreNeverWritten) {
  tests::TemporaryDirectory const directory;
  std::map<std::string, std::string> const files = {
      {"machine.toml", tests::contents(source / "twin/machines/v450.toml")},
      {"experiment", tests::contents(source / "scenarios/catalogue/golden_b_2000.toml")},
      {"sites.toml", "budget = 3\n"},
      {"measurement.toml", "[[table]]\nfile = \"logged\"\n"},
      {"logged", "what a logger wrote"},
      {"monday.h5", "a day of measurements"},
      {"model", "an error model"}};
  for (auto const& [name, text] : files) tests::put(directory.path() / name, text);
  fs::create_symlink("monday.h5", directory.path() / "link.h5");
  fs::create_symlink("machine.toml", directory.path() / "link.toml");
  fs::create_symlink("machine.toml", directory.path() / "picture.png");
  for (std::string const arguments :
       {"run experiment -m machine.toml -o experiment", "run experiment -m machine.toml --picture picture.png",
        "volumetric machine.toml --picture picture.png", "export link.h5 -o monday.h5", "export monday -o monday",
        "fit monday.h5 --error E_Z -o ./monday.h5", "fit link.h5 monday -o monday", "play monday.h5 -o $PWD/monday.h5",
        "play monday -o monday", "replay link.h5 -o monday.h5", "place machine.toml -k 3 -o link.toml",
        "place machine.toml -k 3 --candidates sites.toml -o ./sites.toml", "predict model measurement.toml -o logged",
        "calibrate machine.toml measurement.toml -o logged", "compensate --model model --record ./model"}) {
    tests::put(directory.path() / "monday", "a day of measurements");
    auto const answer = tests::run_command("cd " + directory.path().string() + " && " +
                                           std::string(THERMOTWIN_PROGRAM) + " " + arguments + " 2>&1");
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_TRUE(answer.text.find("never overwritten") != std::string::npos ||
                answer.text.find("is written as .") != std::string::npos)
        << arguments << "\n"
        << answer.text;
    EXPECT_TRUE(tests::contents(directory.path() / "monday") == "a day of measurements") << arguments;
    for (auto const& [name, text] : files) EXPECT_TRUE(tests::contents(directory.path() / name) == text) << arguments;
  }
}

TEST(OutputPlace, OtherTablesAreNotReplaced) {
  tests::TemporaryDirectory const directory;
  std::string const measured = "time_s,T1_degC\n0,20\n", run = (directory / "run.h5").string();
  auto const victim = directory / "victim.csv";
  tests::put(victim, measured);
  tests::put(directory / "model.toml", "an error model");
  ASSERT_EQ(run_program("run -q golden_b_2000 -m v450 -o " + run).code, 0);
  for (auto const& [command, kind] : std::map<std::string, std::string>{
           {"predict " + (directory / "model.toml").string() + " monday.h5", "predictions"},
           {"play " + run, "`play`"},
           {"export " + run, "these channels"}}) {
    auto const answer = run_program(command + " -o " + victim.string());
    EXPECT_EQ(answer.code, 2) << command;
    EXPECT_NE(answer.text.find("victim.csv: is no table of " + kind), std::string::npos) << answer.text;
    EXPECT_EQ(tests::contents(victim), measured) << command;
  }
  fs::remove(victim);
  for (std::string const groups : {"", " --truth", ""})
    EXPECT_EQ(run_program("export " + run + groups + " -o " + victim.string()).code, 0) << "over its own";
}

TEST(OutputPlace, FoldersThatHoldSomethingAreNotWrittenInto) {
  tests::TemporaryDirectory const directory;
  tests::put(directory / "diagonals.csv", "of another day");
  std::string const folder = directory.path().string();
  for (std::string const& arguments : {"run golden_b_2000 -q --fields " + folder, "volumetric mill200 -o " + folder,
                                       "difference " + folder + "/a.h5 " + folder + "/b.h5 -o " + folder}) {
    auto const answer = run_program(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find("is not empty; what is there is not overwritten"), std::string::npos) << answer.text;
    EXPECT_EQ(directory.files(), std::vector<std::string>{"diagonals.csv"}) << arguments;
    EXPECT_EQ(tests::contents(directory / "diagonals.csv"), "of another day") << arguments;
  }
}

TEST(OutputPlace, SuffixesOfOtherFormats) {
  for (auto const& [arguments, message] :
       std::map<std::string, std::string>{{"run golden_b_2000 -o out.txt", "out.txt: a data set is written as .h5"},
                                          {"run golden_b_2000 --picture a.jpg", "a.jpg: a picture is written as .png"},
                                          {"export a.h5 -o a.xlsx", "a.xlsx: a table is written as .csv"},
                                          {"calibrate v450 a.h5 -o b.h5", "b.h5: a machine is written as .toml"},
                                          {"calibrate v450 a.h5 -o v450", "v450: a machine is written as .toml"},
                                          {"diagnose v450 a.h5 -o mine", "mine: a machine is written as .toml"},
                                          {"report a.h5 -o a.pdf", "a.pdf: a page is written as .html"}}) {
    auto const answer = run_program(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find(message), std::string::npos) << answer.text;
  }
}

TEST(OutputPlace, APictureWithoutADisplayIsRefusedBeforeTheWork) {
  tests::TemporaryDirectory const directory;
  for (std::string const arguments :
       {"run golden_b_2000 -o run.h5 --picture run.png", "place v450 -k 3 -o sensors.toml --picture map.png",
        "volumetric g200 -o tables --picture field.png"}) {
    auto const answer = tests::run_command("cd " + directory.path().string() + " && env -u DISPLAY " +
                                           std::string(THERMOTWIN_PROGRAM) + " " + arguments + " 2>&1");
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find("DISPLAY is not set; run under xvfb-run"), std::string::npos) << answer.text;
    EXPECT_TRUE(fs::is_empty(directory.path())) << arguments;
  }
}

TEST(OutputPlace, OutputsThatCannotBeWritten) {
  for (std::string const target : {"/nonexistent/run.h5", "/proc/run.h5"}) {
    auto const answer = run_program("run -q golden_b_2000 -m v450 -o " + target);
    EXPECT_EQ(answer.code, 2);
    EXPECT_NE(answer.text.find("cannot write '" + target), std::string::npos) << answer.text;
  }
}

/// Before any work: the data are not even looked for.
TEST(OutputPlace, OutputsInNoFolder) {
  for (std::string const command : {"diagnose v450 none.h5", "calibrate v450 none.h5", "fit none.h5", "place v450 -k 3",
                                    "run golden_b_2000 -m v450"}) {
    std::string const target = std::string("/nonexistent/x.") + (command.starts_with("run") ? "h5" : "toml");
    auto const answer = run_program(command + " -o " + target);
    EXPECT_EQ(answer.code, 2) << command;
    EXPECT_NE(answer.text.find("cannot write '" + target + "': there is no folder '/nonexistent'"), std::string::npos)
        << answer.text;
  }
}

}  // namespace
}  // namespace thermotwin
