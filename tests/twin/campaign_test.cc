#include "twin/campaign/campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <omp.h>
#include <set>

#include "output/campaign_file.h"
#include "output/error.h"
#include "output/locked_file.h"
#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "thermal/error.h"
#include "twin/campaign/latin_hypercube.h"
#include "twin/campaign/run_campaign.h"
#include "twin/experiment_file.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using tests::contents;
using tests::TemporaryDirectory;

/// 3 x 2 values, 2 cases, 2 experiments, 2 repetitions: 48 runs of two hours.
std::string const example = R"toml(
title = "example"
experiments = ["golden_b_2000", "golden_b_6000"]
machine = "v450"
repetitions = 2
seed = 100
tolerance = 1e-3
set = ["experiment.duration=2 h"]
keep = ["readings", "summary"]
part = 7

[[grid]]
path = "bearing.front.grease_factor"
values = [0.4, 0.5, 0.6]

[[grid]]
path = "experiment.ambient.mean"
from = "18 degC"
to = "26 degC"
count = 2

[[case]]
set = ["bearing.rear.grease_factor=0.5"]

[[case]]
set = ["bearing.rear.grease_factor=0.7", "experiment.ambient.drift=0.1 K/h"]
)toml";

Campaign read(TemporaryDirectory const& directory, std::string const& text) {
  tests::put(directory / "campaign.toml", text);
  return Campaign::read(directory / "campaign.toml");
}

std::string refusal(std::string const& text) {
  TemporaryDirectory const directory;
  try {
    static_cast<void>(read(directory, text));
  } catch (thermal::InputError const& error) {
    std::string const what = error.what();
    return what.substr(what.find("campaign.toml"));
  }
  return "no complaint";
}

std::string changed(std::string const& from, std::string const& to) {
  auto text = example;
  return text.replace(text.find(from), from.size(), to);
}

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

TEST(LatinHypercube, HoldsOneSampleInEachStripOfEachDimension) {
  for (std::int64_t count : {1, 2, 3, 5, 16, 17, 1000})
    for (auto const* name : {"a", "b"}) {
      std::set<std::int64_t> strips;
      for (std::int64_t k = 0; k < count; ++k) {
        double const x = latin_hypercube(k, count, 3, name);
        ASSERT_TRUE(x >= 0.0 && x < 1.0);
        strips.insert(std::int64_t(x * double(count)));
      }
      EXPECT_EQ(std::int64_t(strips.size()), count);
    }
}

/// Uncorrelated: the sample correlation of two dimensions of n samples has deviation 1/sqrt(n).
TEST(LatinHypercube, DimensionsAndSeedsHaveNothingInCommon) {
  constexpr std::int64_t count = 4000;
  auto const correlation = [](auto const& a, auto const& b) {
    double sum = 0.0;
    for (std::int64_t k = 0; k < count; ++k) sum += (a(k) - 0.5) * (b(k) - 0.5);
    return 12.0 * sum / double(count);
  };
  auto const x = [](std::int64_t k) { return latin_hypercube(k, count, 1, "x"); };
  EXPECT_NEAR(correlation(x, x), 1.0, 0.01);
  EXPECT_NEAR(correlation(x, [](auto k) { return latin_hypercube(k, count, 1, "y"); }), 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(correlation(x, [](auto k) { return latin_hypercube(k, count, 2, "x"); }), 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(correlation(x, [&](auto k) { return x((k + 1) % count); }), 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(correlation(x, [](auto k) { return double(k) / count; }), 0.0, 4.0 / std::sqrt(count));
}

TEST(Campaign, EveryCombinationOnceAndNeighboursShareAMachine) {
  TemporaryDirectory const directory;
  auto const campaign = read(directory, example);
  ASSERT_EQ(campaign.runs(), 3 * 2 * 2 * 2 * 2);
  ASSERT_EQ(campaign.parts(), 7);
  std::set<std::string> all;
  int changes = 0;
  std::string last;
  for (std::int64_t i = 0; i < campaign.runs(); ++i) {
    auto const run = campaign.run(i);
    EXPECT_EQ(run.seed, 100 + i);
    std::string machine;
    for (auto const& setting : run.settings)
      if (!setting.of_experiment()) machine += text_of(setting) + " ";
    if (machine != last) ++changes;
    last = machine;
    all.insert(campaign.command(run));
  }
  EXPECT_EQ(all.size(), 48u);
  EXPECT_EQ(changes, 3 * 2);
  auto const run = campaign.run(47);
  EXPECT_EQ(run.positions, (std::vector<double>{0.6, 26.0, 0.7, 0.1}));
  EXPECT_EQ(run.experiment, 1u);
  EXPECT_EQ(campaign.experiment(run).ambient.mean, 299.15);
  EXPECT_EQ(campaign.experiment(run).duration, 7200.0);
}

/// What a case leaves alone is missing; of several settings of a path the last one counts.
TEST(Campaign, RunsSayWhatTheirCaseSets) {
  TemporaryDirectory const directory;
  auto const campaign = read(directory, R"toml(
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

TEST(Campaign, NoGridVariesWhatACaseSets) {
  EXPECT_EQ(refusal(example + "[[case]]\nset = [\"experiment.ambient.mean=20 degC\"]\n"),
            "campaign.toml:17:8: 'experiment.ambient.mean' is varied twice");
}

/// 295 K are 21.85 °C and 68 °F are 20 °C; of another dimension or words, all are words.
TEST(Campaign, ValuesAreNumbersInTheUnitOfTheFirst) {
  auto const stored = [](std::string const& path, std::string const& values) {
    TemporaryDirectory const directory;
    auto const campaign = read(directory, "experiments = [\"golden_b_2000\"]\nmachine = \"v450\"\n[[grid]]\npath = \"" +
                                              path + "\"\nvalues = [" + values + "]\n");
    std::string text;
    for (std::int64_t i = 0; i < campaign.runs(); ++i) text += fmt::format("{} ", campaign.run(i).positions[0]);
    return text + campaign.grid[0].unit;
  };
  EXPECT_EQ(stored("experiment.ambient.mean", R"("20 degC", "295 K", "68 degF")"), "20 21.85 20 degC");
  EXPECT_EQ(stored("experiment.ambient.mean", R"("20 degC", "22 °C")"), "20 22 degC");
  EXPECT_EQ(stored("experiment.ambient.mean", R"("22 °C", "20.1 degC")"), "22 20.1 degC");
  EXPECT_EQ(stored("motor_loss.stator.eddy", R"("80 W", "0.12 kW", "80W")"), "80 120 80 W");
  EXPECT_EQ(stored("bearing.front.grease_factor", R"(0.5, "60 %")"), "0.5 0.6 ");
  EXPECT_EQ(stored("lump.head_front.material", R"("C45", "GJL-250", "C45")"), "0 1 2 ");
}

TEST(Campaign, WholeNumbersKeepTheirDigits) {
  CampaignParameter parameter;
  parameter.path = "experiment.seed";
  parameter.from = 1.0;
  parameter.to = 1e6;
  parameter.count = 1'000'000;
  EXPECT_EQ(parameter.value(99'999).value, "100000");
  EXPECT_EQ(parameter.value(999'999).value, "1000000");
  parameter.to = 1.5;
  parameter.count = 3;
  EXPECT_EQ(parameter.value(1).value, "1.25");
}

TEST(Campaign, AMillionRunsAreAFunctionOfTheirNumber) {
  TemporaryDirectory const directory;
  auto const campaign = read(directory, R"toml(
experiments = ["spindle_random"]
machine = "v450"
[latin_hypercube]
count = 1000000
[[latin_hypercube.vary]]
path = "bearing.front.grease_factor"
from = 0.1
to = 10
scale = "log"
[[latin_hypercube.vary]]
path = "experiment.ambient.mean"
from = "18 degC"
to = "26 degC"
)toml");
  EXPECT_EQ(campaign.runs(), 1'000'000);
  EXPECT_EQ(campaign.runs_per_part(), 1000);
  double below_one = 0.0;
  for (std::int64_t i = 0; i < 1000; ++i) {
    auto const run = campaign.run(999 * i);
    EXPECT_TRUE(run.positions[0] >= 0.1 && run.positions[0] <= 10.0 && run.positions[1] >= 18.0);
    below_one += run.positions[0] < 1.0 ? 1e-3 : 0.0;
  }
  EXPECT_NEAR(below_one, 0.5, 0.06);
  EXPECT_EQ(campaign.command(campaign.run(123'456)), campaign.command(campaign.run(123'456)));
}

TEST(Campaign, SameBytesWhateverThreadsSharesAndRestarts) {
  TemporaryDirectory const directory;
  auto const campaign = read(directory, example);
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

TEST(Campaign, TakesNothingElseForItsIndex) {
  TemporaryDirectory const directory;
  auto const campaign = read(directory, example);
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
TEST(Campaign, StoppedItGoesOnWithNothingTwice) {
  TemporaryDirectory const directory;
  auto const campaign = read(directory, example);
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

TEST(Campaign, AFailedRunIsRecordedAndTheOthersGoOn) {
  TemporaryDirectory const directory;
  std::string values;
  for (int k = 0; k < 21; ++k) values += "\"4000 rpm\", ";  // beyond those that are tried beforehand
  auto const campaign = read(directory, R"toml(
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
TEST(Campaign, ATemperatureThatRunsAwayIsAFailedRun) {
  for (std::string const model : {"full", "modes"}) {
    TemporaryDirectory const directory;
    auto const campaign = read(directory, "experiments = [\"golden_b_4000\"]\nmachine = \"v450\"\nmodel = \"" + model +
                                              "\"\nkeep = [\"summary\"]\n[[grid]]\n"
                                              "path = \"motor_loss.stator.constant\"\nvalues = [\"20 W\", \"1 MW\"]\n");
    auto const files = made(campaign, directory / "out", 1);
    EXPECT_EQ(failed_runs(directory / "out"), 1) << model;
    EXPECT_NE(files.at("failures.csv").find("a temperature leaves 0 to 2000 K"), std::string::npos)
        << files.at("failures.csv");
  }
}

/// By BDF to 1e-8, and in modes: twelve machines, six speeds in two hours, without the instruments' errors.
TEST(Campaign, InModesTheRunsAreThoseOfTheFullModel) {
  TemporaryDirectory const directory;
  auto const text = [](std::string const& model, std::string const& tolerance) {
    return "experiments = [\"spindle_random\"]\nmachine = \"v450\"\nkeep = [\"truth\"]\npart = 12\nmodel = \"" + model +
           "\"\ntolerance = " + tolerance +
           "\nset = [\"experiment.duration=2 h\", \"experiment.spindle.random.run=2 h\"]\n"
           "[[grid]]\npath = \"bearing.front.grease_factor\"\nfrom = 0.4\nto = 0.8\ncount = 12\n";
  };
  auto const runs = [&](std::string const& model, std::string const& tolerance) {
    auto const folder = directory / model;
    static_cast<void>(made(read(directory, text(model, tolerance)), folder, 2));
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

TEST(Campaign, AMachineWithoutModesIsRefusedBeforeAnythingIsWritten) {
  TemporaryDirectory const directory;
  auto const campaign = read(directory, "experiments = [\"feed_12000\"]\nmachine = \"vmc850\"\nmodel = \"modes\"\n");
  EXPECT_THROW(run_campaign(campaign, {directory / "out", {}, {}, nullptr}), thermal::InputError);
  EXPECT_FALSE(fs::exists(directory / "out"));
}

TEST(Campaign, AFolderOfAnotherCampaignIsRefused) {
  TemporaryDirectory const directory;
  auto const campaign = read(directory, changed("part = 7", "part = 24"));
  static_cast<void>(run_campaign(campaign, {directory / "out", {1, 2}, {}, nullptr}));
  auto const other = read(directory, changed("[0.4,", "[0.3,"));
  EXPECT_THROW(run_campaign(other, {directory / "out", {}, {}, nullptr}), thermal::InputError);
  output::LockedFile const busy(directory / "out/parts/000000.journal", output::LockedFile::Busy::refuse);
  EXPECT_THROW(run_campaign(campaign, {directory / "out", {}, {}, nullptr}), output::OutputError);
}

TEST(Campaign, APartThatIsNoneIsRefusedAndLeftAsItIs) {
  TemporaryDirectory const directory;
  auto const campaign = read(directory, example);
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

TEST(Campaign, AFolderWithOtherFilesIsRefusedAndLeftAsItIs) {
  TemporaryDirectory const directory;
  auto const campaign = read(directory, example);  // its file is in the folder
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
TEST(Campaign, AChangedExperimentIsAnotherCampaignWhateverItsName) {
  TemporaryDirectory const directory;
  auto const day = contents(experiment_file("golden_b_2000"));
  for (std::string const folder : {"a", "b"}) {
    fs::create_directory(directory / folder);
    tests::put(directory / folder / "warm.toml", day);
  }
  std::string const text =
      "experiments = [\"a/warm.toml\", \"b/warm.toml\"]\nmachine = \"v450\"\nset = [\"experiment.duration=2 h\"]\n";
  CampaignOptions const nothing{directory / "out", {99, 100}, {}, nullptr};
  EXPECT_EQ(run_campaign(read(directory, text), nothing).made, 0);
  EXPECT_NO_THROW(static_cast<void>(run_campaign(read(directory, text), nothing)));
  tests::put(directory / "a/warm.toml", day + "\n# warmer\n");
  EXPECT_THROW(static_cast<void>(run_campaign(read(directory, text), nothing)), thermal::InputError);
}

TEST(Campaign, NothingIsMadeBesideTheManifestOfSomethingElse) {
  TemporaryDirectory const directory;
  fs::create_directory(directory / "site");
  tests::put(directory / "site/manifest.json", R"({"name": "a web page"})");
  auto const campaign = read(directory, example);
  EXPECT_THROW(static_cast<void>(run_campaign(campaign, {directory / "site", {}, {}, nullptr})), thermal::InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory / "site"), {}), 1);
}

TEST(Campaign, TheCommandOfARunIsWordsForAShell) {
  TemporaryDirectory const directory;
  auto const folder = directory / "Monday's $runs & more";
  fs::create_directory(folder);
  tests::put(folder / "it's.toml", contents(experiment_file("golden_b_2000")));
  tests::put(folder / "campaign.toml",
             "experiments = [\"it's.toml\"]\nmachine = \"v450\"\n"
             "set = [\"experiment.duration=2 h\"]\n");
  auto const campaign = Campaign::read(folder / "campaign.toml");
  auto const command = campaign.command(campaign.run(0));
  ASSERT_EQ(command.find("thermotwin run "), 0U);
  auto const words = thermotwin::tests::answer("printf '<%s>' " + command.substr(15));
  EXPECT_EQ(words.find("<" + (folder / "it's.toml").string() + "><-m><"), 0U) << words;
  EXPECT_NE(words.find("<--set><experiment.duration=2 h>"), std::string::npos) << words;
}

TEST(Campaign, MistakesAreToldWithTheirPlace) {
  EXPECT_EQ(refusal(changed("grease_factor\"\nvalues", "greese_factor\"\nvalues")),
            "campaign.toml:13:8: parameter bearing.front.greese_factor: unknown key 'greese_factor'; did you mean "
            "'grease_factor'?");
  EXPECT_EQ(refusal(changed("bearing.front", "bearing.frnt")),
            "campaign.toml:13:8: parameter 'bearing.frnt.grease_factor': there is no bearing named 'frnt'; did you "
            "mean 'front'?");
  EXPECT_EQ(refusal(changed("\"26 degC\"", "\"299 K\"")),
            "campaign.toml:19:6: 'to' is in 'K' and 'from' in 'degC'; one unit is due");
  EXPECT_EQ(refusal(changed("golden_b_6000", "golden_b_600")).substr(0, 38), "campaign.toml:3:16: there is no experi");
  EXPECT_EQ(refusal(changed("\"summary\"", "\"sumary\"")),
            "campaign.toml:9:21: there is no 'sumary' to keep; did you mean 'summary'?");
  EXPECT_NE(refusal(changed("path = \"experiment.ambient.mean\"", "path = \"experiment.duration\"")).find("time axis"),
            std::string::npos);
  EXPECT_NE(refusal(changed("path = \"experiment.ambient.mean\"", "path = \"bearing.front.grease_factor\""))
                .find("varied twice"),
            std::string::npos);
  EXPECT_NE(refusal(changed("golden_b_6000", "etve")).find("give 'every'"), std::string::npos);
  EXPECT_NE(refusal(changed("count = 2", "count = 1000000000")).find("at most"), std::string::npos);
  EXPECT_NE(refusal(changed("part = 7", "prt = 7")).find("unknown key 'prt'; did you mean 'part'?"), std::string::npos);
}

/// Ends that are whole say nothing of what lies between.
TEST(Campaign, AKeyThatWantsAWholeNumberGetsOne) {
  std::string const head = "experiments = [\"spindle_random\"]\nmachine = \"v450\"\n";
  auto const grid = [&](std::string const& rest) {
    return refusal(head + "[[grid]]\npath = \"experiment.spindle.random.seed\"\nfrom = 1\n" + rest + "\n");
  };
  std::string const place = "parameter experiment.spindle.random.seed: 'seed' is ";
  EXPECT_EQ(grid("to = 10\ncount = 4"), "no complaint");
  EXPECT_EQ(grid("to = 10\ncount = 1"), "no complaint");
  EXPECT_EQ(grid("to = 10\ncount = 19"),
            "campaign.toml:4:8: " + place + "1.5 (a number); a whole number without unit is due");
  EXPECT_EQ(grid("to = 16\ncount = 5\nscale = \"log\""), "no complaint");
  EXPECT_THAT(grid("to = 10\ncount = 3\nscale = \"log\""), testing::StartsWith("campaign.toml:4:8: " + place + "3.16"));
  EXPECT_THAT(refusal(head + "[latin_hypercube]\ncount = 50\nvary = [{path = \"experiment.spindle.random.seed\", "
                             "from = 1, to = 10}]\n"),
              testing::AllOf(testing::StartsWith("campaign.toml:5:17: " + place),
                             testing::EndsWith("a whole number without unit is due")));
}

/// It would have no runs, and its file none either.
TEST(Campaign, ALatinHypercubeHasACount) {
  std::string const text =
      "experiments = [\"golden_b_2000\"]\nmachine = \"v450\"\n[latin_hypercube]\nvary = [{path = "
      "\"bearing.rear.grease_factor\", from = 1, to = 2}]\n";
  EXPECT_EQ(refusal(text), "campaign.toml:3:1: [latin_hypercube] needs 'count', how many samples, from 1 on");
}

/// The file of a campaign names them beside its numbers.
TEST(Campaign, WordsFitIntoAnAttribute) {
  std::string words;
  for (int i = 0; i < 3000; ++i) words += fmt::format("{}\"a word of the number {}\"", i > 0 ? ", " : "", i);
  EXPECT_THAT(refusal("experiments = [\"golden_b_2000\"]\nmachine = \"v450\"\n[[grid]]\npath = "
                      "\"experiment.ambient.mean\"\nvalues = [" +
                      words + "]\n"),
              testing::HasSubstr("campaign.toml:5:11: values that are words may have 50000 letters, not"));
}

TEST(Campaign, CallsABlockAsASettingDoes) {
  auto const said = [](std::string const& path) {
    TemporaryDirectory const directory;
    tests::put(directory / "day.toml",
               "machine = \"v450\"\nduration = \"2 h\"\n[spindle]\nblocks = [{duration = \"2 h\", speed = \"900 "
               "rpm\"}]\n");
    auto const what = tests::refusal([&] {
      static_cast<void>(read(directory, "experiments = [\"day.toml\"]\n[[grid]]\npath = \"" + path +
                                            "\"\nvalues = [\"900 rpm\", \"9000 rpm\"]\n"));
    });
    return what.substr(what.find("campaign.toml"));
  };
  EXPECT_EQ(said("experiment.spindle.blocks.0.speed"),
            "campaign.toml:3:8: experiment.spindle.blocks.0.speed: 9000 rpm is above the machine's maximum, 6000 rpm");
  EXPECT_EQ(said("experiment.spindle.blocks[0].speed"),
            "campaign.toml:3:8: parameter 'experiment.spindle.blocks[0].speed': there is no 'blocks[0]'; did you mean "
            "'experiment.spindle.blocks.0.speed'?");
}

/// Of long lists the first twenty are tried, but each keeps to the time axis.
TEST(Campaign, NoCaseHasATimeAxisOfItsOwn) {
  std::string text = "experiments = [\"golden_b_2000\"]\nmachine = \"v450\"\n";
  for (int c = 0; c < 20; ++c) text += "[[case]]\nset = [\"experiment.ambient.mean=20 degC\"]\n";
  EXPECT_EQ(refusal(text), "no complaint");
  EXPECT_EQ(refusal(text + "[[case]]\nset = [\"experiment.sampling=120 s\"]\n"),
            "campaign.toml:43:1: 'experiment.sampling' cannot be varied: all runs share one time axis; see 'every'");
  EXPECT_EQ(refusal(text + "[[case]]\nset = [\"experiment.duration=2 h\"]\n"),
            "campaign.toml:43:1: 'experiment.duration' cannot be varied: all runs share one time axis; see 'every'");
}

TEST(Campaign, AReducedModelIsOfOneMachine) {
  std::string const head = "experiments = [\"golden_b_2000\"]\nmachine = \"v450\"\nmodel = \"reduced\"\n";
  auto const grid = [](std::string const& path) { return "[[grid]]\npath = \"" + path + "\"\nvalues = [0.4, 0.5]\n"; };
  std::string const reason =
      " cannot be varied: a reduced model is of one machine, with model = \"reduced\" only "
      "experiments may vary";
  EXPECT_EQ(refusal(head + "[[grid]]\npath = \"experiment.ambient.mean\"\nvalues = [\"18 degC\", \"20 degC\"]\n"),
            "no complaint");
  EXPECT_EQ(refusal(head + grid("bearing.front.grease_factor")),
            "campaign.toml:5:8: 'bearing.front.grease_factor'" + reason);
  EXPECT_EQ(refusal(head + "[[case]]\nset = [\"bearing.front.grease_factor=0.5\"]\n"),
            "campaign.toml:4:1: 'bearing.front.grease_factor'" + reason);
}

TEST(Campaign, VariesNoProgrammeThatARecordingReplaces) {
  TemporaryDirectory const directory;
  tests::put(directory / "air.csv", "time_s,room\n0,20\n3600,21\n7200,22\n");
  tests::put(directory / "day.toml",
             "machine = \"v450\"\nduration = \"2 h\"\n[[recorded]]\nfile = \"air.csv\"\nmax_gap = \"1 h\"\n"
             "columns = [{column = \"room\", channel = \"ambient.temperature\", unit = \"degC\"}]\n");
  auto const with = [&](std::string const& path, std::string const& values) {
    try {
      auto const grid = "[[grid]]\npath = \"experiment.ambient." + path + "\"\nvalues = " + values + "\n";
      return std::to_string(read(directory, "experiments = [\"day.toml\"]\n" + grid).runs()) + " runs";
    } catch (thermal::InputError const& error) {
      std::string const what = error.what();
      return what.substr(what.find("campaign.toml"));
    }
  };
  EXPECT_EQ(with("mean", "[\"18 degC\", \"24 degC\"]"),
            "campaign.toml:3:8: parameter 'experiment.ambient.mean' would change nothing: 'ambient.temperature' is "
            "recorded in 'air.csv'");
  EXPECT_EQ(with("stratification", "[\"0 K/m\", \"1 K/m\"]"), "2 runs");
}

}  // namespace
}  // namespace thermotwin::twin
