#include "twin/run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>

#include "tests/output/temporary_directory.h"
#include "twin/experiment_file.h"
#include "twin/file/text_file.h"

/// What a run leaves behind.
namespace thermotwin::twin {
namespace {

/// A ring behind a sensor that lags by a minute and a half, while the speed changes between the readings.
output::Dataset read_every(double sampling, bool in_modes) {
  auto const machine = Machine::build(parse_toml(text_of_file(machine_file("v450")) + R"(
[[temperature_sensor]]
name = "late"
at = "front_ring"
kind = "ideal"
lag = "90 s"
)",
                                                 "late"));
  auto experiment = read_experiment(parse_toml(R"(
    machine = "v450"
    duration = "2 h"
    [spindle]
    blocks = [{duration = "23.4 min", speed = "6000 rpm"}, {duration = "31.3 min", speed = "0 rpm"},
              {duration = "2 h", speed = "5000 rpm"}])",
                                               "two speeds"),
                                    "two speeds");
  experiment.sampling = sampling;
  RunOptions options;
  options.in_modes = in_modes;
  return run(machine, experiment, options).dataset;
}

TEST(Run, ALagShowsTheSameHoweverSeldomItIsRead) {
  for (bool const in_modes : {false, true}) {
    auto const often = read_every(10.0, in_modes), seldom = read_every(600.0, in_modes);
    auto const& late = seldom.readings.back();
    ASSERT_EQ(late.name, "late");
    double furthest = 0.0;
    for (Eigen::Index r = 0; r < late.values.size(); ++r) {
      EXPECT_NEAR(late.values[r], often.readings.back().values[60 * r], 0.01) << in_modes << " at " << r;
      furthest = std::max(furthest, std::abs(late.values[r] - seldom.truth_readings.back().values[r]));
    }
    EXPECT_GT(furthest, 0.3) << in_modes;
  }
}

/// Read at 0 s and 60 s of 100 s: a last picture is of the same frame.
TEST(Run, ShowsTheFieldOfTheLastReading) {
  tests::TemporaryDirectory const directory;
  auto const file = directory / "experiment.toml";
  tests::put(file, "machine = \"v450\"\nduration = \"100 s\"\n");
  RunOptions options;
  options.fields = directory / "fields";
  static_cast<void>(run(Machine::read(machine_file("v450")), read_experiment(read_toml(file), file), options));
  std::string series;
  for (auto const& entry : std::filesystem::directory_iterator(*options.fields))
    if (entry.path().extension() == ".pvd") series += tests::contents(entry.path());
  EXPECT_NE(series.find("timestep=\"60\""), std::string::npos) << series;
}

TEST(Run, RefusesALaserWithoutAScrewBeforeItBegins) {
  tests::TemporaryDirectory const directory;
  auto const file = directory / "experiment.toml";
  tests::put(file, "machine = \"v450\"\nduration = \"1000 h\"\n[laser]\naxis = \"z\"\n");
  RunOptions options;
  options.dataset = directory / "run.h5";
  EXPECT_THAT(
      [&] {
        static_cast<void>(run(Machine::read(machine_file("v450")), read_experiment(read_toml(file), file), options));
      },
      testing::ThrowsMessage<thermal::InputError>(testing::HasSubstr("the machine has no ball_screw on it")));
  auto const left = std::filesystem::directory_iterator(directory.path());
  EXPECT_EQ(std::distance(begin(left), end(left)), 1);  // no partial data set
}

TEST(Run, IsCalledByMachineAndExperiment) {
  auto const machine = Machine::read(machine_file("v450"));
  auto experiment = read_experiment(parse_toml("machine = \"v450\"\nduration = \"1 min\"\n", "short"), "short");
  EXPECT_EQ(run(machine, experiment, {}).dataset.title, "v450");
  experiment.title = "a minute";
  EXPECT_EQ(run(machine, experiment, {}).dataset.title, "v450: a minute");
}

/// 100 kW in 26 kg of motor: 8 K/s. Seen at 15 s · 1.4^7 + 2 · 60 s (sampling.h).
TEST(Run, StoppedSaysWhatThereIsOfIt) {
  tests::TemporaryDirectory const directory;
  auto const machine = Machine::read(machine_file("v450"));
  auto const experiment = read_experiment(parse_toml("machine = \"v450\"\nduration = \"100 s\"\n", "some"), "some");
  std::atomic<bool> const stop = true;
  RunOptions options;
  options.stop = &stop;
  auto const stopped = [&] { (void)run(machine, experiment, options); };
  EXPECT_THAT(stopped, testing::ThrowsMessage<Interrupted>("stopped; nothing was written"));
  options.dataset = directory / "run.h5";
  EXPECT_THAT(stopped, testing::ThrowsMessage<Interrupted>(testing::HasSubstr("run.h5.partial")));
}

TEST(Run, EndsWhereNothingIsSolid) {
  auto document = read_toml(machine_file("v450"));
  set_parameter(document, "motor_loss.stator.constant", "100 kW");
  auto const machine = Machine::build(document);
  auto const file = experiment_file("golden_b_4000");
  auto const experiment = read_experiment(read_toml(file), file);
  RunOptions options;
  for (bool const in_modes : {false, true}) {
    options.in_modes = in_modes;
    EXPECT_THAT([&] { static_cast<void>(run(machine, experiment, options)); },
                testing::ThrowsMessage<thermal::InputError>(testing::AllOf(
                    testing::StartsWith("'motor' is at "),
                    testing::HasSubstr(" °C at t = 278.12 s; a run ends where a temperature leaves 0 to 2000 K"))))
        << in_modes;
  }
}

/// 29 % of 8 kJ is told; 1e-8 of 3 J, which is rounding, is not.
TEST(Run, TellsOfAHeatBalanceThatDoesNotClose) {
  thermal::IntegrationSummary summary;
  auto const remark = [&](double supplied, double share) {
    summary.energy.supplied = supplied;
    summary.stored = (1.0 - share) * supplied;
    return balance_remark(summary);
  };
  EXPECT_THAT(remark(8000.0, 0.29), testing::StartsWith("the heat balance closes to 2.9e-01 only, where 1e-09 is due"));
  EXPECT_THAT(remark(8000.0, 1e-8), testing::StartsWith("the heat balance closes to 1.0e-08 only"));
  EXPECT_EQ(remark(8e6, 1e-10), "");
  EXPECT_EQ(remark(3.0, 1e-8), "");
  EXPECT_EQ(remark(0.0, 0.0), "");
}

}  // namespace
}  // namespace thermotwin::twin
