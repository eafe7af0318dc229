#include "twin/campaign/run_campaign.h"

#include <atomic>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <omp.h>
#include <string>
#include <vector>

#include "output/campaign_file.h"
#include "output/error.h"
#include "output/locked_file.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "tests/twin/campaign/example_campaign.h"
#include "thermal/error.h"
#include "twin/experiment_file.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using tests::contents;
using tests::TemporaryDirectory;

/// Every file below a folder, by its path.
std::map<std::string, std::string> files_in(fs::path const& folder) {
  std::map<std::string, std::string> files;
  for (auto const& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = contents(entry.path());
  return files;
}

std::map<std::string, std::string> made(Campaign const& campaign, fs::path const& folder, int threads) {
  int const before = omp_get_max_threads();
  omp_set_num_threads(threads);
  static_cast<void>(run_campaign(campaign, {folder, {}, {}, nullptr}));
  omp_set_num_threads(before);
  EXPECT_TRUE(finish_campaign(campaign, folder));
  return files_in(folder);
}

/// What a case leaves alone is missing; of several settings of a path the last one counts.
TEST(RunCampaign, RunsSayWhatTheirCaseSets) {
  TemporaryDirectory const directory;
  auto const campaign = read_campaign(directory, R"toml(
experiments = ["golden_b_2000"]
machine = "v450"
tolerance = 1e-3
set = ["experiment.duration=2 h"]
keep = ["summary"]
[[case]]
set = ["bearing.front.grease_factor=0.5", "experiment.ambient.drift=0.1 K/h"]
[[case]]
set = ["bearing.front.grease_factor=0.7", "bearing.front.grease_factor=1.0", "lump.head_front.material=C45"]
[[case]]
set = ["lump.head_front.material=GJL-250"]
)toml");
  static_cast<void>(made(campaign, directory / "out", 2));
  auto const written = [&](std::string const& path) {
    std::string text;
    for (int run = 0; run < 3; ++run) {
      auto const part = output::read_runs(directory / fmt::format("out/parts/{:06}.h5", run), {"parameters"});
      text += fmt::format("{} ", (*part.find("parameters/" + path))(0));
      for (auto const& variable : part.variables)
        if (run == 2 && variable.name == "parameters/" + path)
          text += fmt::format("[{}] {}", variable.unit, variable.long_name);
    }
    return text;
  };
  std::string const missing = " (missing where a case leaves it as it is)";
  EXPECT_EQ(written("bearing.front.grease_factor"), "0.5 1 nan [1] bearing.front.grease_factor" + missing);
  EXPECT_EQ(written("experiment.ambient.drift"), "0.1 nan nan [K/h] experiment.ambient.drift" + missing);
  EXPECT_EQ(written("lump.head_front.material"), "nan 0 1 [1] lump.head_front.material; 0: C45, 1: GJL-250" + missing);
}

TEST(RunCampaign, SameBytesWhateverThreadsSharesAndRestarts) {
  TemporaryDirectory const directory;
  auto const campaign = read_campaign(directory, example_campaign);
  auto const expected = made(campaign, directory / "one", 1);
  EXPECT_EQ(expected.size(), 7 + 4u);  // parts, campaign.h5, failures.csv, manifest.json, lock
  EXPECT_TRUE(made(campaign, directory / "three", 3) == expected);
  EXPECT_TRUE(made(campaign, directory / "three", 1) == expected);
  for (int share : {2, 0, 1}) {
    EXPECT_FALSE(finish_campaign(campaign, directory / "shares"));
    static_cast<void>(run_campaign(campaign, {directory / "shares", {share, 3}, {}, nullptr}));
  }
  EXPECT_TRUE(finish_campaign(campaign, directory / "shares"));
  EXPECT_TRUE(files_in(directory / "shares") == expected);
  EXPECT_EQ(failed_runs(directory / "one"), 0);
}

TEST(RunCampaign, TakesNothingElseForItsIndex) {
  TemporaryDirectory const directory;
  auto const campaign = read_campaign(directory, example_campaign);
  auto const expected = made(campaign, directory / "many", 2);
  auto const index = directory / "many" / "campaign.h5";
  tests::put(index, "somebody else's");
  auto const said = testing::HasSubstr(index.string() + "' is not what this campaign makes of its runs");
  EXPECT_THAT(tests::refusal([&] { run_campaign(campaign, {directory / "many", {}, {}, nullptr}); }), said);
  EXPECT_THAT(tests::refusal([&] { finish_campaign(campaign, directory / "many"); }), said);
  EXPECT_EQ(contents(index), "somebody else's");
  fs::remove(index);
  EXPECT_TRUE(made(campaign, directory / "many", 2) == expected);
}

/// Stopped again and again: each time a few runs further.
TEST(RunCampaign, StoppedItGoesOnWithNothingTwice) {
  TemporaryDirectory const directory;
  auto const campaign = read_campaign(directory, example_campaign);
  auto const expected = made(campaign, directory / "whole", 2);
  std::int64_t sum = 0;
  int stops = 0;
  for (;;) {
    std::atomic<bool> stop = false;
    double first = -1.0;
    CampaignOptions options{directory / "stopped", {}, {}, &stop};
    options.progress = [&](double share) {
      if (first < 0.0) first = share;
      stop = share >= first + 0.1;
    };
    try {
      sum += run_campaign(campaign, options).made;
      break;
    } catch (Interrupted const&) {
      ++stops;
    }
  }
  EXPECT_GE(stops, 3);
  EXPECT_TRUE(finish_campaign(campaign, directory / "stopped"));
  EXPECT_TRUE(files_in(directory / "stopped") == expected);
  EXPECT_LT(sum, 48 - 10);
}

TEST(RunCampaign, AFailedRunIsRecordedAndTheOthersGoOn) {
  TemporaryDirectory const directory;
  std::string values;
  for (int k = 0; k < 21; ++k) values += "\"4000 rpm\", ";  // beyond those that are tried beforehand
  auto const campaign = read_campaign(directory, R"toml(
experiments = ["golden_b_4000"]
machine = "v450"
tolerance = 1e-3
keep = ["summary"]
[[grid]]
path = "spindle.maximum_speed"
values = [)toml" + values + "\"1000 rpm\", \"4000 rpm\"]\n");
  auto const files = made(campaign, directory / "out", 2);
  EXPECT_EQ(failed_runs(directory / "out"), 1);
  EXPECT_EQ(files.at("failures.csv").find("run,reason\n21,\""), 0u) << files.at("failures.csv");
  EXPECT_NE(files.at("failures.csv").find("1000 rpm"), std::string::npos) << files.at("failures.csv");
}

/// A motor of 20 W, and of 1 MW.
TEST(RunCampaign, ATemperatureThatRunsAwayIsAFailedRun) {
  for (std::string const model : {"full", "modes"}) {
    TemporaryDirectory const directory;
    auto const campaign =
        read_campaign(directory, "experiments = [\"golden_b_4000\"]\nmachine = \"v450\"\nmodel = \"" + model +
                                     "\"\nkeep = [\"summary\"]\n[[grid]]\n"
                                     "path = \"motor_loss.stator.constant\"\nvalues = [\"20 W\", \"1 MW\"]\n");
    auto const files = made(campaign, directory / "out", 1);
    EXPECT_EQ(failed_runs(directory / "out"), 1) << model;
    EXPECT_NE(files.at("failures.csv").find("a temperature leaves 0 to 2000 K"), std::string::npos)
        << files.at("failures.csv");
  }
}

/// By BDF to 1e-8, and in modes: twelve machines, six speeds in two hours, without the instruments' errors.
TEST(RunCampaign, InModesTheRunsAreThoseOfTheFullModel) {
  TemporaryDirectory const directory;
  auto const text = [](std::string const& model, std::string const& tolerance) {
    return "experiments = [\"spindle_random\"]\nmachine = \"v450\"\nkeep = [\"truth\"]\npart = 12\nmodel = \"" + model +
           "\"\ntolerance = " + tolerance +
           "\nset = [\"experiment.duration=2 h\", \"experiment.spindle.random.run=2 h\"]\n"
           "[[grid]]\npath = \"bearing.front.grease_factor\"\nfrom = 0.4\nto = 0.8\ncount = 12\n";
  };
  auto const runs = [&](std::string const& model, std::string const& tolerance) {
    auto const folder = directory / model;
    static_cast<void>(made(read_campaign(directory, text(model, tolerance)), folder, 2));
    return output::read_runs(folder / "parts/000000.h5", {"truth"});
  };
  auto const full = runs("full", "1e-8"), modes = runs("modes", "1e-5");
  ASSERT_EQ(full.run.size(), 12U);
  for (std::string const name : {"truth/readings", "truth/displacements"}) {
    Eigen::MatrixXd const& exact = *full.find(name);
    double const gap = (*modes.find(name) - exact).cwiseAbs().maxCoeff();
    EXPECT_LT(gap, 1e-3) << name;  // K, um
    EXPECT_GT(gap, 0.0) << name;
    EXPECT_GT((exact.row(11) - exact.row(0)).cwiseAbs().maxCoeff(), 1.0) << name;
  }
}

TEST(RunCampaign, AMachineWithoutModesIsRefusedBeforeAnythingIsWritten) {
  TemporaryDirectory const directory;
  auto const campaign =
      read_campaign(directory, "experiments = [\"feed_12000\"]\nmachine = \"vmc850\"\nmodel = \"modes\"\n");
  EXPECT_THROW(run_campaign(campaign, {directory / "out", {}, {}, nullptr}), thermal::InputError);
  EXPECT_FALSE(fs::exists(directory / "out"));
}

TEST(RunCampaign, AFolderOfAnotherCampaignIsRefused) {
  TemporaryDirectory const directory;
  auto const campaign = read_campaign(directory, changed_example("part = 7", "part = 24"));
  static_cast<void>(run_campaign(campaign, {directory / "out", {1, 2}, {}, nullptr}));
  auto const other = read_campaign(directory, changed_example("[0.4,", "[0.3,"));
  EXPECT_THROW(run_campaign(other, {directory / "out", {}, {}, nullptr}), thermal::InputError);
  output::LockedFile const busy(directory / "out/parts/000000.journal", output::LockedFile::Busy::refuse);
  EXPECT_THROW(run_campaign(campaign, {directory / "out", {}, {}, nullptr}), output::OutputError);
}

TEST(RunCampaign, APartThatIsNoneIsRefusedAndLeftAsItIs) {
  TemporaryDirectory const directory;
  auto const campaign = read_campaign(directory, example_campaign);
  static_cast<void>(made(campaign, directory / "out", 2));
  auto const part = directory / "out/parts/000003.h5";
  auto const whole = contents(part);
  for (auto const& other :
       {std::string("junk"), whole.substr(0, whole.size() / 2), contents(directory / "out/parts/000004.h5")}) {
    tests::put(part, other);
    auto const what = tests::refusal([&] {
      static_cast<void>(run_campaign(campaign, {directory / "out", {}, {}, nullptr}));
    });
    EXPECT_NE(what.find("000003.h5' is no whole part of this campaign: "), std::string::npos) << what;
    EXPECT_NE(what.find("; delete the file, and its runs are made again"), std::string::npos) << what;
    EXPECT_TRUE(contents(part) == other);
  }
  fs::remove(part);
  EXPECT_EQ(run_campaign(campaign, {directory / "out", {}, {}, nullptr}).made, 7);
  EXPECT_TRUE(contents(part) == whole);
}

TEST(RunCampaign, AFolderWithOtherFilesIsRefusedAndLeftAsItIs) {
  TemporaryDirectory const directory;
  auto const campaign = read_campaign(directory, example_campaign);  // its file is in the folder
  try {
    static_cast<void>(run_campaign(campaign, {directory.path(), {}, {}, nullptr}));
    FAIL();
  } catch (output::OutputError const& error) {
    EXPECT_NE(std::string(error.what()).find("is not empty"), std::string::npos) << error.what();
  }
  EXPECT_EQ(directory.files(), std::vector<std::string>{"campaign.toml"});
  fs::create_directories(directory / "begun/parts");  // by another process, which has not named its campaign yet
  EXPECT_NO_THROW(static_cast<void>(run_campaign(campaign, {directory / "begun", {0, 100}, {}, nullptr})));
}

/// Two days of one name in two folders: the first one changes behind the campaign's back.
TEST(RunCampaign, AChangedExperimentIsAnotherCampaignWhateverItsName) {
  TemporaryDirectory const directory;
  auto const day = contents(experiment_file("golden_b_2000"));
  for (std::string const folder : {"a", "b"}) {
    fs::create_directory(directory / folder);
    tests::put(directory / folder / "warm.toml", day);
  }
  std::string const text =
      "experiments = [\"a/warm.toml\", \"b/warm.toml\"]\nmachine = \"v450\"\nset = [\"experiment.duration=2 h\"]\n";
  CampaignOptions const nothing{directory / "out", {99, 100}, {}, nullptr};
  EXPECT_EQ(run_campaign(read_campaign(directory, text), nothing).made, 0);
  EXPECT_NO_THROW(static_cast<void>(run_campaign(read_campaign(directory, text), nothing)));
  tests::put(directory / "a/warm.toml", day + "\n# warmer\n");
  EXPECT_THROW(static_cast<void>(run_campaign(read_campaign(directory, text), nothing)), thermal::InputError);
}

TEST(RunCampaign, NothingIsMadeBesideTheManifestOfSomethingElse) {
  TemporaryDirectory const directory;
  fs::create_directory(directory / "site");
  tests::put(directory / "site/manifest.json", R"({"name": "a web page"})");
  auto const campaign = read_campaign(directory, example_campaign);
  EXPECT_THROW(static_cast<void>(run_campaign(campaign, {directory / "site", {}, {}, nullptr})), thermal::InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory / "site"), {}), 1);
}

}  // namespace
}  // namespace thermotwin::twin
