#include "twin/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"
#include "twin/experiment_file.h"
#include "twin/machine.h"
#include "twin/run.h"

/// A data set holds all that it was made from.
namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;
using testing::ThrowsMessage;
using tests::contents;
using tests::put;
using tests::TemporaryDirectory;

/// As `thermotwin run` does it.
void make_run(fs::path const& machine, fs::path const& experiment, fs::path const& dataset) {
  Value const document = read_toml(machine);
  auto const programme = read_experiment(read_toml(experiment), experiment);
  RunOptions options;
  options.dataset = dataset;
  options.provenance = origin(machine, document, experiment, "", programme);
  static_cast<void>(run(Machine::build(document), programme, options));
}

TEST(Replay, NeedsNoneOfTheFilesNotEvenTheWeightsOfANeighbour) {
  TemporaryDirectory const directory;
  auto const shipped = machine_file("v450_fine");
  fs::create_directory(directory / "gone");
  put(directory / "gone/mine.toml", contents(shipped));
  put(directory / "gone/v450_fine.weights", contents(fs::path(shipped).replace_extension(".weights")));
  put(directory / "gone/experiment.toml", "machine = \"mine.toml\"\nduration = \"2 min\"\n");
  make_run(directory / "gone/mine.toml", directory / "gone/experiment.toml", directory / "run.h5");
  fs::remove_all(directory / "gone");
  auto const again = replay(directory / "run.h5", {}, {}, nullptr);
  EXPECT_TRUE(again.same_bytes) << again.text;
}

/// What is kept on disk is what was measured, with the truth of each probe of a nest.
TEST(Replay, OfANestHasTheTruthOfItsProbes) {
  TemporaryDirectory const directory;
  put(directory / "nest.toml", contents(machine_file("v450")) + "\n[five_probe_nest]\nbar_points_to = \"-z\"\n");
  put(directory / "experiment.toml", "machine = \"nest.toml\"\nduration = \"2 min\"\n");
  make_run(directory / "nest.toml", directory / "experiment.toml", directory / "run.h5");
  auto const kept = output::read(directory / "run.h5");
  ASSERT_EQ(kept.truth_displacements.size(), kept.displacements.size());
  for (std::size_t c = 0; c < kept.displacements.size(); ++c)
    EXPECT_EQ(kept.truth_displacements[c].name, kept.displacements[c].name);
  auto const again = replay(directory / "run.h5", {}, {}, nullptr);
  EXPECT_TRUE(again.same_bytes) << again.text;
}

TEST(Replay, DoesNotMakeAReducedRunAnew) {
  TemporaryDirectory const directory;
  output::Dataset reduced;
  reduced.title = "warm-up";
  reduced.time_s = Eigen::VectorXd::LinSpaced(3, 0.0, 120.0);
  reduced.provenance = {{"model", "reduced"}, {"machine.file", ""}, {"experiment.file", ""}, {"settings", ""}};
  output::write(reduced, directory / "run.h5");
  EXPECT_THAT([&] { static_cast<void>(replay(directory / "run.h5", {}, {}, nullptr)); },
              ThrowsMessage<thermal::InputError>(
                  HasSubstr("run.h5' is of a reduced model (run --reduced), which is not made anew; the same run "
                            "without --reduced can be")));
}

}  // namespace
}  // namespace thermotwin::twin
