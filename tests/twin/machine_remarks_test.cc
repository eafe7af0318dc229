#include "twin/machine_remarks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "tests/twin/checked_files.h"
#include "twin/file_check.h"
#include "twin/machine.h"

/// What `thermotwin check` finds odd about a machine.
namespace thermotwin::twin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::SizeIs;
using thermotwin::tests::contents;
using thermotwin::tests::machine_changed;
using thermotwin::tests::machine_with;
using thermotwin::tests::put;
using thermotwin::tests::TemporaryDirectory;

TEST(MachineRemarks, WarnsOfWhatIsNotPlausible) {
  TemporaryDirectory const folder;
  put(folder / "machine.toml", machine_changed("v450", "grease_factor = 0.55", "grease_factor = 55"));
  auto const check = check_files({folder / "machine.toml"})[0];
  EXPECT_EQ(check.mistake, "");
  EXPECT_THAT(check.warnings,
              ElementsAre(MatchesRegex(
                  ".*machine.toml:[0-9]+:[0-9]+: 'grease_factor' is 55; outside what is plausible: 0.2 to 8")));
}

TEST(MachineRemarks, WarnsOfUnitsThatSlipped) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& from, std::string const& to) {
    put(folder / "mine.toml", machine_changed("v450", from, to));
    auto const check = check_files({folder / "mine.toml"})[0];
    EXPECT_EQ(check.mistake, "") << to;
    return check.warnings;
  };
  EXPECT_THAT(warnings("maximum_speed = \"6000 rpm\"", "maximum_speed = \"18 rpm\""),
              ElementsAre(HasSubstr("'maximum_speed' is \"18 rpm\"; outside what is plausible: 50 rpm to ")));
  EXPECT_THAT(warnings("expansion = \"11.8e-6 1/K\"", "expansion = \"11.8 1/K\""),
              ElementsAre(HasSubstr("outside what is plausible: -10 um/(m K) to 300 um/(m K)")));
  EXPECT_THAT(warnings("conductivity = \"42 W/(m K)\"", "conductivity = \"42 kW/(m K)\""),
              ElementsAre(HasSubstr("'conductivity' is \"42 kW/(m K)\"; outside")));
  EXPECT_THAT(
      warnings("conductance = \"18 W/K\"", "conductance = \"18 W/mK\""),
      ElementsAre(HasSubstr("'conductance' is \"18 W/mK\"; outside what is plausible: 0.01 W/K to 10000 W/K; mK "
                            "is a millikelvin: per metre and kelvin is \"18 W/(m K)\"")));
  EXPECT_THAT(warnings("lead = \"12 mm\"", "lead = \"12 m\""), ElementsAre(HasSubstr("'lead' is \"12 m\"; outside")));
  EXPECT_THAT(
      warnings(
          "[spindle]",
          "[[foundation]]\nname = \"soil\"\nat = \"bed\"\ntemperature = \"15 K\"\nconductance = \"20 W/K\"\n[spindle]"),
      ElementsAre(HasSubstr("'temperature' is \"15 K\"; outside what is plausible: -60 degC to 150 degC")));
}

TEST(MachineRemarks, WarnsOfAnInputThatNearlyHasAKnownName) {
  TemporaryDirectory const folder;
  put(folder / "machine.toml", machine_changed("vmc850", "speed = \"z.speed\"", "speed = \"zspeed\""));
  auto const check = check_files({folder / "machine.toml"})[0];
  EXPECT_EQ(check.mistake, "");
  EXPECT_THAT(check.warnings,
              ElementsAre(MatchesRegex(".*machine.toml:294:[0-9]+: input 'zspeed': did you mean 'z.speed'\\?")));
}

/// A screw stands still most of the time, and is measured then.
TEST(MachineRemarks, WarnsOfSensorsThatTurnWithTheSpindle) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& machine, std::string const& places) {
    put(folder / "mine.toml",
        contents(machine_file(machine)) + "[[temperature_sensor]]\nname = \"more\"\nat = " + places);
    return check_files({folder / "mine.toml"})[0].warnings;
  };
  EXPECT_THAT(warnings("v450", "[\"front_ring\", \"shaft[100 mm]\"]\n"),
              ElementsAre(MatchesRegex(
                  ".*mine.toml:[0-9]+:21: sensor 'more' sits on 'shaft', which turns; its signal needs a way out")));
  EXPECT_THAT(warnings("v450", "\"test_bar[50 mm]\"\n"), ElementsAre(HasSubstr("sits on 'test_bar', which turns")));
  EXPECT_THAT(warnings("v450", "\"bed\"\n"), ElementsAre());
  EXPECT_THAT(warnings("vmc850", "\"screw[100 mm]\"\n"), ElementsAre());
}

TEST(MachineRemarks, WarnsOfMassesThatDoNotFitTheirBox) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& mass, std::string const& size) {
    put(folder / "mine.toml",
        machine_with("[[lump]]\nname = \"case\"\nmaterial = \"GJL-300\"\nmass = \"" + mass + "\"\n" + size +
                     "[[joint]]\nname = \"case\"\nfrom = \"case\"\nto = \"bed\"\n" + "conductance = \"5 W/K\"\n"));
    return check_files({folder / "mine.toml"})[0].warnings;
  };
  std::string const box = "size = [\"300 mm\", \"250 mm\", \"300 mm\"]\n";
  EXPECT_THAT(warnings("45 kg", box), ElementsAre());
  EXPECT_THAT(warnings("2 kg", box), ElementsAre());
  EXPECT_THAT(
      warnings("45 g", box),
      ElementsAre(MatchesRegex(".*mine.toml:[0-9]+:8: 'mass' is \"45 g\"; full of GJL-300, the box of its 'size' "
                               "has 163 kg")));
  EXPECT_THAT(warnings("450 kg", box), ElementsAre(HasSubstr("'mass' is \"450 kg\"; full of GJL-300")));
  EXPECT_THAT(warnings("45 g", ""), ElementsAre());
}

TEST(MachineRemarks, DoubtsANutWithAnotherLeadThanItsAxis) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& lead) {
    auto text = contents(machine_file("mill200"));
    std::string const nut = "lead = \"5 mm\"";
    text.replace(text.rfind(nut), nut.size(), "lead = \"" + lead + "\"");
    put(folder / "mine.toml", text);
    return check_files({folder / "mine.toml"})[0].warnings;
  };
  EXPECT_THAT(warnings("5 mm"), SizeIs(0));
  EXPECT_THAT(warnings("10 mm"), ElementsAre(MatchesRegex(".*mine.toml:[0-9]+:[0-9]+: 'lead' is \"10 mm\"; axis 'x', "
                                                          "whose screw it runs on, has a lead of \"5 mm\"")));
}

TEST(MachineRemarks, CountsInWholeNumbers) {
  TemporaryDirectory const folder;
  put(folder / "machine.toml", machine_changed("v450", "count = 2", "count = 2.5"));
  EXPECT_THAT(check_files({folder / "machine.toml"})[0].mistake,
              MatchesRegex(".*machine.toml:[0-9]+:[0-9]+: 'count' is 2.5; a whole number is due"));
}

}  // namespace
}  // namespace thermotwin::twin
