#include "twin/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>

#include "tests/output/temporary_directory.h"
#include "twin/experiment_file.h"

/// What a run leaves behind.
namespace thermotwin::twin {
namespace {

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

/// 100 kW in 26 kg of motor: 8 K/s, seen every 10 min.
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
                    testing::HasSubstr(" °C at t = 600 s; a run ends where a temperature leaves 0 to 2000 K"))))
        << in_modes;
  }
}

}  // namespace
}  // namespace thermotwin::twin
