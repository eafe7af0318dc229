#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "thermal/error.h"
#include "twin/experiment_file.h"
#include "twin/run.h"

/// Signatures of effects that change what an instrument shows, or the air that the room's sensor does not see: the same
/// run with and without them, with the same chance in all instruments.
namespace thermotwin::twin {
namespace {

scenarios::Experiment experiment(std::string const& more = "") {
  return read_experiment(parse_toml(R"(
    title = "standstill, one start and one stop"
    machine = "v450"
    duration = "7 h"
    sampling = "5 min"
    start_time_of_day = "0 h"
    spindle.blocks = [{duration = "1 h", speed = "0 rpm"}, {duration = "3 h", speed = "5000 rpm"}]
)" + more,
                                    "experiment.toml"),
                         "experiment.toml");
}

Value with(std::string const& effect, std::string const& machine = "v450") {
  Value document = read_toml(machine_file(machine));
  Value const added = parse_toml(effect, "added.toml");
  for (auto const& entry : std::get<Value::Table>(added.content))
    std::get<Value::Table>(document.content).push_back(entry);
  return document;
}

output::Dataset made(std::string const& effect, std::string const& more = "") {
  return run(Machine::build(with(effect)), experiment(more), {}).dataset;
}

Eigen::VectorXd const& values(std::vector<output::Channel> const& channels, std::string const& name) {
  for (auto const& channel : channels)
    if (channel.name == name) return channel.values;
  throw std::out_of_range(name);
}

/// What an effect adds to the readings and truths of a run.
struct Change {
  output::Dataset with, without;

  explicit Change(std::string const& effect, std::string const& more = "")
      : with(made(effect, more)), without(made("", more)) {}
  [[nodiscard]] Eigen::VectorXd reading(std::string const& name) const {
    return values(with.readings, name) - values(without.readings, name);
  }
  [[nodiscard]] Eigen::VectorXd displacement(std::string const& name) const {
    return values(with.displacements, name) - values(without.displacements, name);
  }
  [[nodiscard]] Eigen::VectorXd truth(std::string const& name) const {
    return values(with.truth_readings, name) - values(without.truth_readings, name);
  }
  /// The truth stays, and so do the readings of all other instruments.
  void expect_nothing_but(std::string const& name) const {
    for (auto const& channel : with.truth_readings) EXPECT_EQ(truth(channel.name).norm(), 0.0) << channel.name;
    for (auto const& channel : with.truth_displacements)
      EXPECT_EQ(channel.values, values(without.truth_displacements, channel.name)) << channel.name;
    for (auto const& channel : with.readings)
      if (channel.name != name) {
        EXPECT_EQ(reading(channel.name).norm(), 0.0) << channel.name;
      }
    for (auto const& channel : with.displacements)
      if (channel.name != name) {
        EXPECT_EQ(displacement(channel.name).norm(), 0.0) << channel.name;
      }
  }
};

constexpr double step = 0.064;  // of the readings [K]

TEST(SensorDrift, GrowsWithTimeInOneReadingOnly) {
  Change const change("[[sensor_drift]]\nname = \"fault\"\nsensor = \"T4\"\ndrift = \"-0.5 K/day\"");
  change.expect_nothing_but("T4");
  auto const drift = change.reading("T4");
  for (Eigen::Index i = 0; i < drift.size(); ++i)
    EXPECT_NEAR(drift[i], -0.5 * change.with.time_s[i] / 86400.0, step) << i;
}

TEST(SensorLag, HoldsBackTheSlopeAndForgetsIt) {
  Change const change("[[sensor_lag]]\nname = \"fault\"\nsensor = \"T4\"\nlag = \"10 min\"");
  change.expect_nothing_but("T4");
  auto const late = change.reading("T4"), body = values(change.with.truth_readings, "T4");
  EXPECT_NEAR(late[11], 0.0, step);                                     // before the start
  EXPECT_LT(late.segment(12, 12).minCoeff(), -0.1);                     // behind in the warm-up
  EXPECT_GT(late.segment(48, 12).maxCoeff(), 0.1);                      // ahead in the cool-down
  EXPECT_NEAR(late[84], -600.0 * (body[84] - body[82]) / 600.0, 0.07);  // −τ dT/dt once the start is forgotten
}

TEST(SensorContact, TakesAShareOfTheRiseOverTheAir) {
  Change const change("[[sensor_contact]]\nname = \"fault\"\nsensor = \"T4\"\nair_share = 0.2");
  change.expect_nothing_but("T4");
  auto const less = change.reading("T4"), body = values(change.with.truth_readings, "T4");
  for (Eigen::Index const i : {12, 47, 84}) EXPECT_NEAR(less[i], -0.2 * (body[i] - 20.0), 0.2) << i;
  EXPECT_LT(less[47], -1.0);
}

TEST(ProbeDrift, GrowsWithTimeAndWithTheAir) {
  Change const change(
      "[[probe_drift]]\nname = \"fixture\"\ndisplacement = \"E_Z\"\ndrift = \"0.3 um/h\"\nper_air = \"-2 um/K\"",
      "ambient.drift = \"1 K/h\"");
  change.expect_nothing_but("E_Z");
  EXPECT_NEAR(change.displacement("E_Z")[0], 0.0, 1e-9);
  EXPECT_NEAR(change.displacement("E_Z")[60], 5.0 * (0.3 - 2.0), 1e-6);
}

/// Of a screw at rest in a room that warms by 1 K/h.
output::Dataset in_a_warming_room(std::string const& effect) {
  auto const warming = read_experiment(parse_toml(R"(
    title = "at rest"
    machine = "vmc850"
    duration = "5 h"
    sampling = "10 min"
    ambient.drift = "1 K/h"
)",
                                                  "rest.toml"),
                                       "rest.toml");
  return run(Machine::build(with(effect, "vmc850")), warming, {}).dataset;
}

/// What an effect adds to a screw's errors at its three positions, row by row.
Eigen::MatrixXd added_to_screw(std::string const& effect, bool reading = false) {
  auto const changed = in_a_warming_room(effect), plain = in_a_warming_room("");
  Eigen::MatrixXd added(Eigen::Index(plain.time_s.size()), 3);
  for (Eigen::Index p = 0; p < 3; ++p) {
    auto const name = fmt::format("E_P_{}mm", 120 + 300 * p);
    added.col(p) = reading ? values(changed.displacements, name) - values(plain.displacements, name)
                           : values(changed.truth_displacements, name) - values(plain.truth_displacements, name);
    if (reading) {
      EXPECT_EQ(values(changed.truth_displacements, name), values(plain.truth_displacements, name));
    }
  }
  return added;
}

TEST(Scale, ShowsItsGrowthInProportionToThePosition) {
  auto const added =
      added_to_screw("[[scale]]\nname = \"glass\"\nscrew = \"E_P\"\nat = \"head\"\nexpansion = \"8e-6 1/K\"");
  auto const plain = in_a_warming_room("");
  Eigen::VectorXd const head = values(plain.truth_readings, "S12");
  double const warmer = head[head.size() - 1] - head[0];
  ASSERT_GT(warmer, 0.5);
  for (Eigen::Index p = 0; p < 3; ++p)
    EXPECT_NEAR(added(added.rows() - 1, p), -8.0 * (0.12 + 0.3 * double(p)) * warmer, 1e-9) << p;
}

TEST(Compensation, OfAScrewShiftsAllPositionsAlike) {
  auto const added =
      added_to_screw("[[compensation]]\nname = \"zero\"\ndisplacement = \"E_P\"\nat = \"head\"\ngain = \"2 um/K\"");
  auto const plain = in_a_warming_room("");
  Eigen::VectorXd const head = values(plain.truth_readings, "S12");
  for (Eigen::Index p = 0; p < 3; ++p)
    EXPECT_NEAR(added(added.rows() - 1, p), -2.0 * (head[head.size() - 1] - head[0]), 1e-9) << p;
}

TEST(LaserAir, IsReadInProportionToThePosition) {
  auto const added = added_to_screw("[[laser_air]]\nname = \"path\"\nscrew = \"E_P\"", true);
  for (Eigen::Index p = 0; p < 3; ++p)
    EXPECT_NEAR(added(added.rows() - 1, p), -5.0 * 0.955 * (0.12 + 0.3 * double(p)), 1e-9) << p;
}

TEST(ProbeDrift, OfAScrewIsReadAtAllItsPositions) {
  auto const added =
      added_to_screw("[[probe_drift]]\nname = \"laser\"\ndisplacement = \"E_P\"\ndrift = \"0.3 um/h\"", true);
  for (Eigen::Index p = 0; p < 3; ++p) EXPECT_NEAR(added(added.rows() - 1, p), 5.0 * 0.3, 1e-9) << p;
}

TEST(DisplacementStep, ComesAndGoesWithItsInput) {
  Change const change("[[displacement_step]]\nname = \"clamp\"\ndisplacement = \"E_Z\"\nstep = \"3 um\"");
  auto const moved = Eigen::VectorXd(values(change.with.truth_displacements, "E_Z") -
                                     values(change.without.truth_displacements, "E_Z"));
  EXPECT_NEAR(moved[6], 0.0, 1e-9);
  EXPECT_NEAR(moved[30], 3.0, 1e-9);
  EXPECT_NEAR(moved[80], 0.0, 1e-9);
}

TEST(DisplacementStep, FollowsNoInputThatTheExperimentDoesNotGive) {
  try {
    (void)made(
        "[[displacement_step]]\nname = \"clamp\"\ndisplacement = \"E_Z\"\nstep = \"3 um\"\n"
        "follows = \"spindle.runing\"");
    FAIL() << "it found one";
  } catch (thermal::InputError const& error) {
    std::string const message = error.what();
    EXPECT_NE(message.find("needs the input 'spindle.runing'"), std::string::npos) << message;
    EXPECT_NE(message.find("did you mean 'spindle.running'?"), std::string::npos) << message;
  }
}

TEST(Readings, OfAnUnknownInstrumentAreRefused) {
  auto const message = [](std::string const& effect) {
    try {
      (void)Machine::build(with(effect));
    } catch (FileError const& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(
      message("[[sensor_lag]]\nname = \"fault\"\nsensor = \"E_Z\"\nlag = \"10 min\"").find("unknown sensor 'E_Z'"),
      std::string::npos);
  EXPECT_NE(message("[[probe_drift]]\nname = \"fault\"\ndisplacement = \"T4\"").find("unknown displacement 'T4'"),
            std::string::npos);
}

std::string const layers = "[[stratification]]\nname = \"hall\"\ngradient = \"1 K/m\"";

/// T at a boundary that is named after its height: "air at 0.25 m".
double offset_at_height(thermal::Boundary const& boundary, double& height) {
  height = std::stod(boundary.name.substr(7));
  return boundary.offset;
}

TEST(Stratification, RaisesAllAirInProportionToItsHeightWhereverTheTableStands) {
  Value const last = with(layers);
  Value first = last;
  for (auto& entry : std::get<Value::Table>(first.content))
    if (entry.key == "stratification") std::get<Value::List>(entry.value.content)[0].where.line = -1;
  for (auto const& document : {last, first}) {
    Machine const machine = Machine::build(document);
    int airs = 0;
    for (auto const& boundary : machine.network().boundaries()) {
      if (!boundary.name.starts_with("air at")) continue;
      double height = 0.0;
      double const raised = offset_at_height(boundary, height);
      EXPECT_NEAR(raised, height - 1.0, 1e-5);
      ++airs;
    }
    EXPECT_GT(airs, 3);
  }
}

TEST(Stratification, LeavesTheSensorOfTheRoomAndTiltsTheMachineAtStandstill) {
  Change const change(layers);
  EXPECT_EQ(change.truth("T10").norm(), 0.0);
  auto const motor = change.truth("T8"), bed = change.truth("T9");
  EXPECT_GT(std::abs(motor[11] - bed[11]), 0.02);
}

TEST(AmbientCycle, MovesTheMachineLessThanTheAirAndNotTheSensorOfTheRoom) {
  Change const change("[[ambient_cycle]]\nname = \"hall\"\ncosine = \"-2 K\"");
  EXPECT_EQ(change.truth("T10").norm(), 0.0);
  EXPECT_LT(change.truth("T6")[6], 0.0);  // cold air at midnight
  EXPECT_GT(change.truth("T6").minCoeff(), -2.0);
}

}  // namespace
}  // namespace thermotwin::twin
