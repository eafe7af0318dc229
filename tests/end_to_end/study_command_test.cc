#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"

/// `thermotwin study` as its users meet it.
namespace thermotwin {
namespace {

using testing::HasSubstr;
using tests::answer;
using tests::TemporaryDirectory;

std::string const study = R"(
title = "Two batches"
selections = ["all", "fuzzy_c_means 2", "thermal_modes 2"]
models = ["linear", "genetic_back_propagation"]
[[world]]
name = "v450"
machine = "v450"
error = "E_Z"
sampling = "6 min"
train = ["batch_004_K01"]
test = ["batch_004_K05"]
)";

TEST(StudyCommand, GivesTheSameBytesWithOneThreadAndTwo) {
  TemporaryDirectory const directory;
  tests::put(directory / "study.toml", study);
  std::string const program = fmt::format("{} study {}", THERMOTWIN_PROGRAM, (directory / "study.toml").string());
  auto const text = answer("OMP_NUM_THREADS=1 " + program + " -o " + (directory / "one").string());
  answer("OMP_NUM_THREADS=2 " + program + " -o " + (directory / "two").string());
  EXPECT_THAT(text, HasSubstr("v450: least RMSE where no model had been: "));
  EXPECT_THAT(text, HasSubstr("all + genetic_back_propagation"));
  for (char const* file : {"table.csv", "study.json"}) {
    EXPECT_FALSE(tests::contents(directory / "one" / file).empty());
    EXPECT_EQ(tests::contents(directory / "one" / file), tests::contents(directory / "two" / file)) << file;
  }
}

TEST(StudyCommand, OverwritesNothing) {
  TemporaryDirectory const directory;
  tests::put(directory / "study.toml", study);
  auto const complaint = answer(fmt::format("{} study {} -o {}", THERMOTWIN_PROGRAM,
                                            (directory / "study.toml").string(), directory.path().string()),
                                2);
  EXPECT_THAT(complaint, HasSubstr("is not empty; what is there is not overwritten"));
  EXPECT_EQ(directory.files(), std::vector<std::string>{"study.toml"});
}

TEST(StudyCommand, KnowsTheShippedStudiesByName) {
  TemporaryDirectory const directory;
  EXPECT_THAT(answer(fmt::format("{} study paper_04 -o {}", THERMOTWIN_PROGRAM, (directory / "out").string()), 2),
              HasSubstr("there is no study 'paper_04'; did you mean 'paper_004'?"));
}

/// Before the runs, and where it stands.
TEST(StudyCommand, SaysWhereAWorldIsWrong) {
  TemporaryDirectory const directory;
  auto const refused = [&](std::string const& from, std::string const& to) {
    auto text = study;
    tests::put(directory / "study.toml", text.replace(text.find(from), from.size(), to));
    return answer(fmt::format("{} study {} -o {}", THERMOTWIN_PROGRAM, (directory / "study.toml").string(),
                              (directory / "out").string()),
                  2);
  };
  EXPECT_THAT(refused("\"E_Z\"", "\"E_Q\""),
              HasSubstr("study.toml:8:9: world 'v450': the machine has no displacement 'E_Q'"));
  EXPECT_THAT(refused("[\"batch_004_K01\"]", "[\"batch_004_K99\"]"),
              HasSubstr("study.toml:10:10: world 'v450': there is no experiment 'batch_004_K99'"));
  EXPECT_THAT(
      refused("sampling = \"6 min\"", "set = [\"bearing.front.grease_fctor=1\"]"),
      HasSubstr("study.toml:5:1: world 'v450': parameter bearing.front.grease_fctor: unknown key 'grease_fctor'"));
  EXPECT_THAT(refused("sampling = \"6 min\"", "add = \"[[fan_coolin]]\""), HasSubstr("study.toml:5:1: world 'v450': "));
  EXPECT_THAT(refused("test = [\"batch_004_K05\"]", "split = \"1 min\""),
              HasSubstr("study.toml:5:1: world 'v450': 'split' leaves 1 rows to train on"));
}

}  // namespace
}  // namespace thermotwin
