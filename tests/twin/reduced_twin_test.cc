#include "twin/reduced_twin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"
#include "twin/live_twin.h"
#include "twin/reduced_summary.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

/// A head with a spindle in it, as 348 cells.
std::string const machine_text = R"(
name = "small"
title = "head and spindle"
[spindle]
maximum_speed = "6000 rpm"
[[block]]
name = "head"
material = "GJL-300"
corner = ["-150 mm", "-150 mm", "0 mm"]
size = ["300 mm", "300 mm", "300 mm"]
cells = [6, 6, 6]
solidity = 0.4
[[hollow_cylinder]]
name = "ring"
material = "100Cr6"
origin = ["0 mm", "0 mm", "20 mm"]
length = "40 mm"
outer_diameter = "110 mm"
inner_diameter = "98 mm"
axial_cells = 4
radial_cells = 1
carried_by = "head"
[[hollow_cylinder]]
name = "shaft"
material = "42CrMo4"
origin = ["0 mm", "0 mm", "-40 mm"]
length = "320 mm"
outer_diameter = "70 mm"
inner_diameter = "20 mm"
axial_cells = 32
radial_cells = 4
carried_by = "head"
[[joint]]
name = "seat"
from = "ring.outer"
to = "head[100 mm .. 200 mm, 100 mm .. 200 mm, 0 mm .. 100 mm]"
conductance = "30 W/K"
[[bearing]]
name = "front"
inner = "shaft.outer[60 mm .. 100 mm]"
outer = "ring.inner"
count = 2
grease_factor = 0.55
oil = 22
pitch_diameter = "90 mm"
torque_load = "1008 N"
conductance = "9 W/K"
[[film]]
name = "head"
on = ["head.x_min", "head.x_max", "head.y_min", "head.y_max", "head.z_max"]
correlation = "room"
[[film]]
name = "nose"
on = "shaft.outer[0 mm .. 40 mm]"
correlation = "rotating_cylinder"
diameter = "70 mm"
[[displacement]]
name = "E_Z"
title = "nose against the head"
direction = "-z"
segment = [{ of = "shaft[0 mm .. 80 mm]" }]
[[temperature_sensor]]
name = "T1"
title = "ring"
at = "ring"
[[temperature_sensor]]
name = "T2"
title = "head"
at = "head.x_max[150 mm, 150 mm]"
[[temperature_sensor]]
name = "air"
title = "air"
at = "ambient"
)";

Machine const& small_machine() {
  static Machine const machine = Machine::build(parse_toml(machine_text, "small.toml"));
  return machine;
}

ReducedTwin const& small_twin() {
  static ReducedTwin const twin(small_machine());
  return twin;
}

scenarios::Experiment random_experiment(int seed) {
  scenarios::Experiment experiment;
  experiment.title = "fresh";
  experiment.duration = 5 * 3600.0;
  experiment.seed = seed;
  experiment.ambient.mean = 288.15 + 3.0 * seed;
  experiment.ambient.stratification = 0.2 * seed;
  experiment.spindle.emplace().random = scenarios::RandomSpectrum{4 * 3600.0, 300.0, 1800.0, 0.0, 1.0, 100 + seed};
  return experiment;
}

void expect_within(std::vector<output::Channel> const& full, std::vector<output::Channel> const& reduced,
                   std::vector<double> const& bound, double tolerance) {
  ASSERT_EQ(full.size(), reduced.size());
  for (std::size_t c = 0; c < full.size(); ++c) {
    double const gap = (full[c].values - reduced[c].values).cwiseAbs().maxCoeff();
    EXPECT_LE(gap, bound[c] + 1e-9) << full[c].name;
    EXPECT_LE(gap, tolerance) << full[c].name;
  }
}

TEST(ReducedTwin, StaysWithinItsBoundOnSpectraThatItHasNotSeen) {
  auto const& twin = small_twin();
  for (int seed = 1; seed <= 5; ++seed) {
    auto const experiment = random_experiment(seed);
    auto const full = run(small_machine(), experiment, {});
    auto const reduced = twin.run(experiment);
    expect_within(full.dataset.truth_readings, reduced.dataset.truth_readings, reduced.bound.readings, 0.01);
    auto const& d = reduced.bound.displacements;
    expect_within(full.dataset.truth_displacements, reduced.dataset.truth_displacements, {d.begin(), d.end()}, 0.1);
    EXPECT_LT(reduced.bound.largest_reading(), 0.1);
    ASSERT_EQ(full.dataset.inputs.size(), reduced.dataset.inputs.size());
    for (std::size_t i = 0; i < full.dataset.inputs.size(); ++i)
      EXPECT_EQ(full.dataset.inputs[i].values, reduced.dataset.inputs[i].values) << full.dataset.inputs[i].name;
  }
}

TEST(ReducedTwin, IsSmallerThanTheMachine) {
  EXPECT_LT(small_twin().network().size(), small_machine().network().nodes() / 3);
  EXPECT_LT(small_twin().coarse_network().size(), small_twin().network().size());
}

TEST(ReducedTwin, TableKeepsItsColumnsBesideLongTitles) {
  auto result = small_twin().run(random_experiment(1));
  result.dataset.truth_readings[1].long_name = "head, on the side of the operator and below the second cover";
  std::istringstream lines(reduced_table(small_twin(), result));
  std::set<std::size_t> columns;
  std::size_t rows = 0;
  for (std::string line; std::getline(lines, line);) {
    auto const column = std::min(line.find("± "), line.find("against the full model"));
    if (column == std::string::npos) continue;
    columns.insert(column);
    ++rows;
  }
  EXPECT_EQ(rows, 1U + 3U + 1U);  // the head, sensors, displacement
  EXPECT_EQ(columns.size(), 1U);
}

TEST(ReducedTwin, GivesTheSameBytesWhetherItWasMadeOrReadFromDisk) {
  tests::TemporaryDirectory const folder;
  std::vector<std::string> told;
  auto const tell = [&](std::string const& what) { told.push_back(what); };
  ReducedTwin const made(small_machine(), {}, folder.path(), tell);
  ASSERT_THAT(folder.files(), testing::Contains(testing::EndsWith(".reduction")));
  ReducedTwin const read(small_machine(), {}, folder.path(), tell);
  EXPECT_THAT(told, testing::ElementsAre("finding the shapes of small, once for this machine"));
  auto const experiment = random_experiment(1);
  auto const without = output::to_hdf5(small_twin().run(experiment).dataset);
  EXPECT_EQ(output::to_hdf5(made.run(experiment).dataset), without);
  EXPECT_EQ(output::to_hdf5(read.run(experiment).dataset), without);
}

TEST(ReducedTwin, RefusesAnInputOutsideItsRange) {
  auto experiment = random_experiment(1);
  experiment.ambient.mean = 273.15 + 60.0;
  try {
    (void)small_twin().run(experiment);
    FAIL();
  } catch (thermal::InputError const& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'ambient.floor_temperature' is 59.8 degC"));
    EXPECT_THAT(error.what(), testing::HasSubstr("was made for 9.5 to 34 degC"));
  }
}

TEST(ReducedTwin, RefusesAStartOutsideItsRange) {
  auto experiment = random_experiment(1);
  experiment.initial_temperature = 400.0;
  EXPECT_THROW((void)small_twin().run(experiment), thermal::InputError);
}

TEST(ReducedTwin, EndsWhereNothingIsSolid) {
  auto const hot = Machine::build(
      parse_toml(machine_text + "[[heat]]\nname = \"hot\"\nat = \"head\"\npower = \"100 kW\"\n", "hot.toml"));
  EXPECT_THAT([&] { (void)ReducedTwin(hot).run(random_experiment(1)); },
              testing::ThrowsMessage<thermal::InputError>(testing::HasSubstr("a temperature leaves 0 to 2000 K")));
}

/// Inputs of the machine's network at full speed, or at rest, in air of 20 °C.
std::vector<double> input_at(double speed) {
  std::vector<double> input;
  for (auto const& name : small_machine().network().channel_names())
    input.push_back(name == "spindle.speed"               ? speed
                    : name == "spindle.running"           ? (speed > 0.0 ? 1.0 : 0.0)
                    : name == "ambient.floor_temperature" ? 293.15
                                                          : 0.0);
  return input;
}

TEST(LiveTwin, StepByStepIsTheRun) {
  scenarios::Experiment experiment;
  experiment.duration = 3600.0;
  experiment.ambient.mean = 293.15;
  experiment.spindle.emplace().blocks = {{3600.0, std::nullopt, 0.5}};
  auto const expected = small_twin().run(experiment).dataset;
  LiveTwin live(small_twin(), 293.15);
  auto const input = input_at(0.5 * small_machine().limits.max_spindle_speed);
  for (int second = 0; second < 3599; ++second) live.advance(input);
  for (int s = 0; s < 2; ++s) {
    auto const& course = expected.truth_readings[std::size_t(s)].values;
    EXPECT_NEAR(live.readings()[s] - 273.15, course[course.size() - 1], 0.02);
  }
  auto const& grown = expected.truth_displacements[0].values;
  EXPECT_NEAR(live.displacements()[0] * 1e6, grown[grown.size() - 1], 0.1);
}

TEST(LiveTwin, ReadingsCorrectAWrongStart) {
  LiveTwin truth(small_twin(), 293.15), with(small_twin(), 298.15), without(small_twin(), 298.15);
  auto const input = input_at(0.0);
  for (int second = 0; second < 3600; ++second) {
    truth.advance(input);
    with.advance(input);
    without.advance(input);
    with.correct(truth.readings());
  }
  double const left = (with.readings() - truth.readings()).cwiseAbs().maxCoeff();
  double const uncorrected = (without.readings() - truth.readings()).cwiseAbs().maxCoeff();
  EXPECT_GT(uncorrected, 2.0);
  EXPECT_LT(left, 0.2 * uncorrected);
}

TEST(LiveTwin, AMissingReadingCorrectsNothing) {
  LiveTwin live(small_twin(), 293.15);
  Eigen::VectorXd const before = live.state();
  live.correct(Eigen::VectorXd::Constant(live.readings().size(), std::nan("")));
  EXPECT_EQ(live.state(), before);
}

TEST(LiveTwin, RefusesAnInputOutsideItsRange) {
  LiveTwin live(small_twin(), 293.15);
  EXPECT_THROW(live.advance(input_at(2.0 * small_machine().limits.max_spindle_speed)), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
