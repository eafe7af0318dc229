#include "twin/campaign/campaign.h"

#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "tests/twin/campaign/example_campaign.h"
#include "thermal/error.h"
#include "twin/experiment_file.h"
#include "twin/setting.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using tests::contents;
using tests::TemporaryDirectory;

std::string refusal(std::string const& text) {
  TemporaryDirectory const directory;
  try {
    static_cast<void>(read_campaign(directory, text));
  } catch (thermal::InputError const& error) {
    std::string const what = error.what();
    return what.substr(what.find("campaign.toml"));
  }
  return "no complaint";
}

TEST(Campaign, EveryCombinationOnceAndNeighboursShareAMachine) {
  TemporaryDirectory const directory;
  auto const campaign = read_campaign(directory, example_campaign);
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

TEST(Campaign, NoGridVariesWhatACaseSets) {
  EXPECT_EQ(refusal(example_campaign + "[[case]]\nset = [\"experiment.ambient.mean=20 degC\"]\n"),
            "campaign.toml:17:8: 'experiment.ambient.mean' is varied twice");
}

/// 295 K are 21.85 °C and 68 °F are 20 °C; of another dimension or words, all are words.
TEST(Campaign, ValuesAreNumbersInTheUnitOfTheFirst) {
  auto const stored = [](std::string const& path, std::string const& values) {
    TemporaryDirectory const directory;
    auto const campaign =
        read_campaign(directory, "experiments = [\"golden_b_2000\"]\nmachine = \"v450\"\n[[grid]]\npath = \"" + path +
                                     "\"\nvalues = [" + values + "]\n");
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
  auto const campaign = read_campaign(directory, R"toml(
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
  EXPECT_EQ(refusal(changed_example("grease_factor\"\nvalues", "greese_factor\"\nvalues")),
            "campaign.toml:13:8: parameter bearing.front.greese_factor: unknown key 'greese_factor'; did you mean "
            "'grease_factor'?");
  EXPECT_EQ(refusal(changed_example("bearing.front", "bearing.frnt")),
            "campaign.toml:13:8: parameter 'bearing.frnt.grease_factor': there is no bearing named 'frnt'; did you "
            "mean 'front'?");
  EXPECT_EQ(refusal(changed_example("\"26 degC\"", "\"299 K\"")),
            "campaign.toml:19:6: 'to' is in 'K' and 'from' in 'degC'; one unit is due");
  EXPECT_EQ(refusal(changed_example("golden_b_6000", "golden_b_600")).substr(0, 38),
            "campaign.toml:3:16: there is no experi");
  EXPECT_EQ(refusal(changed_example("\"summary\"", "\"sumary\"")),
            "campaign.toml:9:21: there is no 'sumary' to keep; did you mean 'summary'?");
  EXPECT_NE(refusal(changed_example("path = \"experiment.ambient.mean\"", "path = \"experiment.duration\""))
                .find("time axis"),
            std::string::npos);
  EXPECT_NE(refusal(changed_example("path = \"experiment.ambient.mean\"", "path = \"bearing.front.grease_factor\""))
                .find("varied twice"),
            std::string::npos);
  EXPECT_NE(refusal(changed_example("golden_b_6000", "etve")).find("give 'every'"), std::string::npos);
  EXPECT_NE(refusal(changed_example("count = 2", "count = 1000000000")).find("at most"), std::string::npos);
  EXPECT_NE(refusal(changed_example("part = 7", "prt = 7")).find("unknown key 'prt'; did you mean 'part'?"),
            std::string::npos);
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
      static_cast<void>(read_campaign(directory, "experiments = [\"day.toml\"]\n[[grid]]\npath = \"" + path +
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
      return std::to_string(read_campaign(directory, "experiments = [\"day.toml\"]\n" + grid).runs()) + " runs";
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
