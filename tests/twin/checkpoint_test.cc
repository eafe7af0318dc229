#include "twin/checkpoint.h"

#include <gtest/gtest.h>
#include <numeric>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "thermal/error.h"
#include "twin/experiment_file.h"
#include "twin/file/text_file.h"
#include "twin/instruments/random_stream.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

struct Killed {};

struct Bench {
  Machine machine;
  scenarios::Experiment experiment;
};

/// A turning centre whose tank is cooled by a chiller that switches on and off, read every minute through noisy
/// instruments.
Bench const& bench() {
  static Bench const bench = [] {
    auto const chilled = text_of_file(machine_file("g200")) + R"toml(
[[chiller]]
name = "tank"
cools = "tank"
temperature = "22 degC"
power = "800 W"
hysteresis = "0.4 K"
)toml";
    auto const file = experiment_file("duty_003");
    Bench made{Machine::build(parse_toml(chilled, "chilled")), read_experiment(read_toml(file), file)};
    made.experiment.sampling = 60.0;
    return made;
  }();
  return bench;
}

/// `killed_after`: share of the run.
RunOptions options(std::filesystem::path const& checkpoint, double interval, double killed_after) {
  RunOptions options;
  options.integration.relative_tolerance = options.integration.absolute_tolerance = 1e-4;
  options.checkpoint_interval = interval;
  if (!checkpoint.empty()) options.checkpoint = checkpoint;
  options.progress = [killed_after](double share) {
    if (share >= killed_after) throw Killed{};
  };
  return options;
}

std::string undisturbed(double interval) {
  return output::to_hdf5(run(bench().machine, bench().experiment, options({}, interval, 2.0)).dataset);
}

TEST(Checkpoint, ARunTakenUpAtAHundredRandomBoundariesGivesTheSameBytes) {
  tests::TemporaryDirectory const directory;
  RandomStream random(7, "checkpoint");
  int taken_up = 0;
  for (int trial = 0; taken_up < 100; ++trial) {
    double const interval = 60.0 * std::floor(random.uniform(1.0, 40.0));
    auto const expected = undisturbed(interval);
    auto const path = directory / std::to_string(trial);
    for (double killed = random.uniform(0.0, 0.5); killed < 1.0; killed += random.uniform(0.0, 0.5)) {
      auto cut = options(path, interval, killed);
      cut.resume = true;
      EXPECT_THROW(static_cast<void>(run(bench().machine, bench().experiment, cut)), Killed);
      ++taken_up;
    }
    auto last = options(path, interval, 2.0);
    last.resume = true;
    EXPECT_TRUE(output::to_hdf5(run(bench().machine, bench().experiment, last).dataset) == expected) << trial;
    EXPECT_FALSE(std::filesystem::exists(path));
  }
}

TEST(Checkpoint, TheBenchSwitches) {
  EXPECT_GE(run(bench().machine, bench().experiment, options({}, 0.0, 2.0)).summary.relay_switches, 8);
}

TEST(Checkpoint, ATornFileLosesAStretchAndNoByte) {
  tests::TemporaryDirectory const directory;
  auto const path = directory / "checkpoint";
  EXPECT_THROW(static_cast<void>(run(bench().machine, bench().experiment, options(path, 600.0, 0.7))), Killed);
  auto const bytes = tests::contents(path);
  tests::put(path, bytes.substr(0, bytes.size() - 1));
  auto last = options(path, 600.0, 2.0);
  last.resume = true;
  EXPECT_TRUE(output::to_hdf5(run(bench().machine, bench().experiment, last).dataset) == undisturbed(600.0));
}

/// Starting anew costs accuracy of the order of the tolerance, no more.
TEST(Checkpoint, BoundariesDoNotBendTheRun) {
  auto const plain = run(bench().machine, bench().experiment, options({}, 0.0, 2.0)).dataset;
  auto const cut = run(bench().machine, bench().experiment, options({}, 300.0, 2.0)).dataset;
  for (std::size_t c = 0; c < plain.truth_readings.size(); ++c)
    EXPECT_LT((plain.truth_readings[c].values - cut.truth_readings[c].values).cwiseAbs().maxCoeff(), 0.02);
}

TEST(Checkpoint, OfAnotherRunOrUnasked) {
  tests::TemporaryDirectory const directory;
  auto const path = directory / "checkpoint";
  EXPECT_THROW(static_cast<void>(run(bench().machine, bench().experiment, options(path, 600.0, 0.7))), Killed);
  EXPECT_EQ(checkpoint_interval(path), 600.0);
  EXPECT_THROW(static_cast<void>(run(bench().machine, bench().experiment, options(path, 600.0, 2.0))),
               thermal::InputError);
  auto other = options(path, 300.0, 2.0);
  other.resume = true;
  EXPECT_EQ(tests::refusal([&] { static_cast<void>(run(bench().machine, bench().experiment, other)); }),
            "'" + path.string() +
                "' is of another run, with --checkpoint \"10 min\"; ask for the same, or delete it to begin anew");
  EXPECT_THROW(static_cast<void>(checkpoint_interval(directory / "none")), thermal::InputError);
}

/// What a user would have to type, not what the file calls it.
TEST(Checkpoint, SaysHowTheOtherRunWasAskedFor) {
  tests::TemporaryDirectory const directory;
  Checkpoint::Identity const run = {{"checkpoint_s", "90000"},
                                    {"experiment.file", "a"},
                                    {"machine.file", "b"},
                                    {"machine.weights", "c"},
                                    {"nodes", "no"},
                                    {"recorded.0", "d"},
                                    {"seed", "1"},
                                    {"settings", "x=1\ny=2"},
                                    {"version", "0.1.0"},
                                    {"tolerance.absolute_K", "1e-06"},
                                    {"tolerance.relative", "1e-06"}};
  Checkpoint(directory / "run", run, false);
  auto const said = [&](std::string const& key, std::string const& now) {
    auto other = run;
    if (now.empty())
      other.erase(key);
    else
      other[key] = now;
    auto const text = tests::refusal([&] { Checkpoint(directory / "run", other, true); });
    auto const begin = text.find(", with ") + 7;
    return text.substr(begin, text.find("; ask for") - begin);
  };
  EXPECT_EQ(said("checkpoint_s", "3600"), "--checkpoint \"25 h\"");
  EXPECT_EQ(said("experiment.file", "A"), "another experiment, or another text in its file");
  for (std::string const key : {"machine.file", "machine.weights"})
    EXPECT_EQ(said(key, "B"), "another machine, or another text in its file");
  EXPECT_EQ(said("nodes", "yes"), "no --nodes");
  for (auto const& [key, now] : {std::pair{"recorded.0", ""}, {"recorded.0", "D"}, {"recorded.1", "more"}})
    EXPECT_EQ(said(key, now), "other recorded tables");
  EXPECT_EQ(said("seed", "2"), "experiment.seed = 1");
  EXPECT_EQ(said("settings", "x=2"), "--set 'x=1' --set 'y=2'");
  EXPECT_EQ(said("tolerance.absolute_K", "1e-05"), "--tolerance 1e-06");
  EXPECT_EQ(said("version", "0.2.0"), "version 0.1.0 of the program");
  auto two = run;
  two["seed"] = two["machine.file"] = "2";
  EXPECT_NE(tests::refusal([&] {
              Checkpoint(directory / "run", two, true);
            }).find("with another machine, or another text in its file and experiment.seed = 1; ask"),
            std::string::npos);
}

TEST(Checkpoint, GoesWithTheRunThatTookItsPlace) {
  tests::TemporaryDirectory const directory;
  auto const dataset = directory / "run.h5", path = checkpoint_of(dataset);
  EXPECT_NO_THROW(remove_stale_checkpoint(dataset));
  {
    Checkpoint const running(path, {{"seed", "1"}}, false);
    remove_stale_checkpoint(dataset);
    EXPECT_TRUE(std::filesystem::exists(path));
  }
  remove_stale_checkpoint(dataset);
  EXPECT_FALSE(std::filesystem::exists(path));
  for (std::string const text : {"", "what the user wrote"}) {
    tests::put(path, text);
    remove_stale_checkpoint(dataset);
    EXPECT_EQ(tests::contents(path), text);
    EXPECT_TRUE(std::filesystem::exists(path));
  }
}

/// A recorded table stands in the identity as it is.
TEST(Checkpoint, TellsTablesInAnyEncodingApart) {
  tests::TemporaryDirectory const directory;
  std::string const latin_1 = "time_s,D\xfcse\n", another = "time_s,D\xf6se\n";
  EXPECT_NO_THROW(Checkpoint(directory / "run", {{"recorded.0", latin_1}}, false));
  EXPECT_NO_THROW(Checkpoint(directory / "run", {{"recorded.0", latin_1}}, true));
  EXPECT_THROW(Checkpoint(directory / "run", {{"recorded.0", another}}, true), thermal::InputError);
}

TEST(Checkpoint, LeavesAFileOfSomethingElseAlone) {
  tests::TemporaryDirectory const directory;
  tests::put(directory / "notes", "what the user wrote");
  EXPECT_THROW(static_cast<void>(checkpoint_interval(directory / "notes")), thermal::InputError);
  EXPECT_THROW(Checkpoint(directory / "notes", {}, true), thermal::InputError);
  EXPECT_EQ(tests::contents(directory / "notes"), "what the user wrote");
}

TEST(Checkpoint, StretchesEndAtTheFirstTimeAfterEachMultiple) {
  std::vector<double> times(11);
  std::iota(times.begin(), times.end(), 0.0);
  using Ends = std::vector<std::size_t>;
  EXPECT_EQ(stretches(times, 0.0), (Ends{11}));
  EXPECT_EQ(stretches(times, 5.0), (Ends{6, 11}));
  EXPECT_EQ(stretches(times, 2.5), (Ends{4, 6, 9, 11}));
  EXPECT_EQ(stretches(times, 0.1), (Ends{2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(stretches(times, 100.0), (Ends{11}));
}

}  // namespace
}  // namespace thermotwin::twin
