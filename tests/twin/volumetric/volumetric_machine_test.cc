#include "twin/volumetric/volumetric_machine.h"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tuple>

#include "twin/machine.h"

/// `[volumetric]` of a machine file, and what a run does to the elements.
namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string const axes = R"toml([volumetric]
chain = "XYFZ"
axis = [
  { name = "x", from = "0 mm", to = "200 mm", screw = "E_P", screw_from = "300 mm", screw_to = "100 mm" },
  { name = "y", from = "0 mm", to = "200 mm" },
  { name = "z", from = "0 mm", to = "120 mm" },
]
)toml";

VolumetricMachine machine(std::string const& text) { return read_volumetric(parse_toml(text, "mill.toml")); }

std::string complaint(std::string const& text) {
  try {
    (void)machine(text);
  } catch (FileError const& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(VolumetricMachine, ReadsElementsWithTheirUnits) {
  auto const read = machine(axes + R"toml(squareness_xz = "30 urad"
translation = [
  { name = "EXX", polynomial = ["1 um", "10 um"], harmonic = [{ amplitude = "2 um", period = "200 mm", phase = "90 deg" }] },
  { name = "EYX", positions = ["0 mm", "200 mm"], values = ["0 um", "4 um"] },
]
rotation = [{ name = "EBZ", polynomial = ["0 urad", "20 urad"] }]
)toml");
  EXPECT_NEAR(read.cold.at(0, 0.1).translation[0], 1e-6 + 5e-6 - 2e-6, 1e-15);
  EXPECT_NEAR(read.cold.at(0, 0.1).translation[1], 2e-6, 1e-15);
  EXPECT_NEAR(read.cold.at(2, 0.06).rotation[1], 10e-6, 1e-15);
  EXPECT_EQ(read.cold.squareness, Eigen::Vector3d(0.0, 30e-6, 0.0));
  EXPECT_EQ(read.cold.at(1, 0.1).translation, Eigen::Vector3d::Zero());
}

TEST(VolumetricMachine, GivenElementsTakeThePlaceOfDrawnOnes) {
  auto const drawn = machine(axes + "[volumetric.drawn]\nseed = 4\n");
  auto const given =
      machine(axes + "translation = [{ name = \"EXX\", polynomial = [\"7 um\"] }]\n[volumetric.drawn]\nseed = 4\n");
  EXPECT_DOUBLE_EQ(given.cold.at(0, 0.1).translation[0], 7e-6);
  EXPECT_EQ(given.cold.at(0, 0.1).rotation, drawn.cold.at(0, 0.1).rotation);
  EXPECT_EQ(given.cold.squareness, drawn.cold.squareness);
}

TEST(VolumetricMachine, MistakesAreToldWithTheirPlace) {
  EXPECT_THAT(complaint("name = \"a\"\n"), HasSubstr("no table [volumetric]"));
  EXPECT_THAT(complaint("[volumetric]\nchian = \"XYFZ\"\n"),
              AllOf(HasSubstr("mill.toml:2:"), HasSubstr("did you mean 'chain'?")));
  EXPECT_THAT(complaint("[volumetric]\nchain = \"XYZ\"\n"), AllOf(HasSubstr("mill.toml:2:"), HasSubstr("'XYZ'")));
  EXPECT_THAT(complaint("[volumetric]\naxis = [{ name = \"x\", from = \"0 mm\", to = \"1 m\" }]\n"),
              HasSubstr("needs an axis 'y'"));
  EXPECT_THAT(complaint("[volumetric]\naxis = [{ name = \"x\", from = \"2 m\", to = \"1 m\" }]\n"),
              AllOf(HasSubstr("mill.toml:2:"), HasSubstr("must be above")));
  EXPECT_THAT(complaint(axes + "translation = [{ name = \"EXW\" }]\n"),
              AllOf(HasSubstr("mill.toml:8:"), HasSubstr("unknown error element 'EXW'")));
  EXPECT_THAT(complaint(axes + "translation = [{ name = \"EAX\" }]\n"), HasSubstr("is an angle"));
  EXPECT_THAT(complaint(axes + "rotation = [{ name = \"EAX\", polynomial = [\"1 um\"] }]\n"),
              AllOf(HasSubstr("mill.toml:8:"), HasSubstr("is a length; an angle is due, for example \"15 urad\"")));
  EXPECT_THAT(complaint(axes + "translation = [{ name = \"EXX\", positions = [\"0 mm\"] }]\n"),
              HasSubstr("1 positions and 0 values"));
  EXPECT_THAT(complaint(axes + "growth = [{ channel = \"A\", element = \"EAW\" }]\n"), HasSubstr("EAW"));
}

/// What a run would be refused for, after it.
TEST(VolumetricMachine, GrowthHasTheUnitOfWhatItMoves) {
  auto const growth = [](std::string const& channel, std::string const& element) {
    return complaint(axes + "growth = [{ channel = \"" + channel + "\", element = \"" + element +
                     "\" }]\n[[displacement]]\nname = \"E_X\"\n[[rotation]]\nname = \"A\"\n");
  };
  EXPECT_THAT(growth("E_X", "EAZ"), AllOf(HasSubstr("mill.toml:8:"),
                                          HasSubstr("'E_X' is a length; an angle is due for 'EAZ', which it moves")));
  EXPECT_THAT(growth("E_X", "squareness_yz"), HasSubstr("an angle is due for 'squareness_yz'"));
  EXPECT_THAT(growth("A", "EXZ"), HasSubstr("'A' is an angle; a length is due for 'EXZ', which it moves"));
  EXPECT_EQ(growth("E_X", "EXZ"), "nothing was thrown");
  EXPECT_EQ(growth("A", "squareness_yz"), "nothing was thrown");
}

/// A run: the screw grows by 1 µm per 100 mm and hour, the head rises 5 µm and tilts 8 µrad in the hour.
output::Dataset run() {
  output::Dataset run;
  run.time_s = Eigen::Vector3d(0.0, 1800.0, 3600.0);
  auto const channel = [&](char const* name, char const* unit, double end) {
    run.displacements.push_back({name, unit, "", Eigen::Vector3d(0.0, 0.5 * end, end)});
  };
  channel("E_P_100mm", "um", 1.0);
  channel("E_P_300mm", "um", 3.0);
  channel("E_Z", "um", 5.0);
  channel("A", "urad", 8.0);
  return run;
}

std::string const growth =
    "growth = [{ channel = \"E_Z\", element = \"EZZ\", factor = -1 }, { channel = \"A\", element = \"squareness_yz\" "
    "}]\n";

TEST(WarmedErrors, ScrewAndStructureEnterTheElements) {
  auto const mill = machine(axes + growth);
  auto const errors = warmed(mill, run(), 3600.0);
  // The nut stands at 300 mm of the screw when x = 0, and runs against it: 3 µm along the screw are −3 µm along x.
  EXPECT_NEAR(errors.at(0, 0.0).translation[0], -3e-6, 1e-15);
  EXPECT_NEAR(errors.at(0, 0.2).translation[0], -1e-6, 1e-15);
  EXPECT_NEAR(errors.at(0, 0.1).translation[0], -2e-6, 1e-15);
  EXPECT_NEAR(errors.at(2, 0.03).translation[2], -5e-6, 1e-15);
  EXPECT_NEAR(errors.squareness[2], 8e-6, 1e-15);
  EXPECT_NEAR(warmed(mill, run(), 1800.0).squareness[2], 4e-6, 1e-15);
  EXPECT_NEAR(warmed(mill, run(), 0.0).at(0, 0.1).translation[0], 0.0, 1e-18);
}

/// What the tool does does not depend on whose motion an element is.
TEST(WarmedErrors, ScrewMovesTheToolAlikeUnderBothConventions) {
  Eigen::Vector3d const q(0.05, 0.1, 0.03);
  auto const relative = machine(axes), carriage = machine(axes + "convention = \"body-fixed\"\n");
  auto const error = [&](VolumetricMachine const& m) { return m.model(warmed(m, run(), 3600.0)).error(q); };
  EXPECT_LT((error(relative) - error(carriage)).norm(), 1e-18);
  EXPECT_NEAR(error(relative)[0], -2.5e-6, 1e-15);
}

TEST(WarmedErrors, LaserServesWhereTheScrewHasNoChannels) {
  auto data = run();
  data.displacements.erase(data.displacements.begin(), data.displacements.begin() + 2);
  auto const mill = machine(axes);
  EXPECT_THAT([&] { (void)warmed(mill, data, 0.0); },
              testing::ThrowsMessage<thermal::InputError>(HasSubstr("no error of position of axis 'x'")));
  Eigen::MatrixXd forward(2, 2);
  forward << 0.0, 0.0, 1.0, 3.0;
  data.positioning.push_back({"x", Eigen::Vector2d(0.0, 200.0), Eigen::Vector2d(0.0, 3600.0), forward, forward});
  EXPECT_NEAR(warmed(mill, data, 3600.0).at(0, 0.1).translation[0], -2e-6, 1e-15);
}

TEST(WarmedErrors, WhatTheRunLacksIsNamed) {
  auto const complains = [](std::string const& table, char const* what) {
    EXPECT_THAT([&] { (void)warmed(machine(axes + table), run(), 0.0); },
                testing::ThrowsMessage<thermal::InputError>(HasSubstr(what)));
  };
  complains("growth = [{ channel = \"E_ZZ\", element = \"EZZ\" }]\n", "did you mean 'E_Z'?");
  complains("growth = [{ channel = \"A\", element = \"EZZ\" }]\n", "um is due");
}

TEST(WarmedErrors, InstantIsWithinTheRun) {
  auto const mill = machine(axes + growth);
  for (double const time : {-3600.0, 360000.0})
    EXPECT_THAT([&] { (void)warmed(mill, run(), time); },
                testing::ThrowsMessage<thermal::InputError>(HasSubstr("is not within the run, which goes from 0 ")));
  EXPECT_NO_THROW((void)warmed(mill, run(), std::nextafter(3600.0, 3601.0)));
}

TEST(WarmedErrors, MachineFileKnowsItsScrewsAndChannels) {
  for (auto const& [from, to, what] :
       {std::tuple{"screw = \"E_PX\"", "screw = \"E_PY\"", "unknown ball_screw 'E_PY'"},
        std::tuple{"channel = \"E_Y\"", "channel = \"E_X\"", "unknown displacement 'E_X'"}}) {
    std::ifstream file(machine_file("mill200"));
    std::string text(std::istreambuf_iterator<char>(file), {});
    ASSERT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), std::string(from).size(), to);
    EXPECT_THAT([&] { (void)Machine::build(parse_toml(text, "mill.toml")); },
                testing::ThrowsMessage<FileError>(AllOf(HasSubstr("mill.toml:"), HasSubstr(what))));
  }
}

}  // namespace
}  // namespace thermotwin::twin
