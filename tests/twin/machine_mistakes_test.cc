#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "tests/twin/checked_files.h"
#include "twin/file_check.h"
#include "twin/machine.h"

/// What `thermotwin check` refuses in a machine file, with its place.
namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;
using thermotwin::tests::contents;
using thermotwin::tests::machine_changed;
using thermotwin::tests::machine_with;
using thermotwin::tests::put;
using thermotwin::tests::TemporaryDirectory;

/// What `run -o` would refuse after the run.
TEST(MachineMistakes, RefusesNamesThatNoChannelCanHave) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& table) {
    put(folder / "mine.toml", machine_with(table));
    return check_files({folder / "mine.toml"})[0].mistake;
  };
  for (std::string const name : {"head/top", "time", "."})
    EXPECT_THAT(mistake("[[temperature_sensor]]\nat = \"bed\"\nname = \"" + name + "\"\n"),
                MatchesRegex(".*mine.toml:[0-9]+:8: '" + name + "' cannot be the name of a channel: .*"));
  EXPECT_THAT(mistake("[[displacement]]\nname = \"E/Z\"\n"), HasSubstr("'E/Z' cannot be the name of a channel"));
  EXPECT_THAT(mistake("[[heat]]\nname = \"a/b\"\nat = \"bed\"\npower = \"60 W\"\n"),
              HasSubstr("'heat.a/b' cannot be the name of a channel"));
  EXPECT_THAT(mistake("[[rotation]]\nname = \"E_Z\"\n"), HasSubstr("the name 'E_Z' is taken by a [[rotation]]"));
}

/// A place that began with such a name would be another one, or none.
TEST(MachineMistakes, RefusesNamesThatNoPlaceCanBeginWith) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& kind, std::string const& keys, std::string const& name) {
    put(folder / "mine.toml", machine_with("[[" + kind + "]]\n" + keys + "name = \"" + name + "\"\n"));
    return check_files({folder / "mine.toml"})[0].mistake;
  };
  std::string const lump = "heat_capacity = \"1 kJ/K\"\n", pipe = "length = \"1 m\"\ndiameter = \"10 mm\"\n";
  for (std::string const name : {"ambient", "head.stock", "head[1]", "head ", " head", ""})
    EXPECT_THAT(mistake("lump", lump, name),
                HasSubstr(":8: '" + name +
                          "' cannot be the name of a body: it has no '.' and no '[', no blank at its ends, is not "
                          "empty, and is not 'ambient', which is the air of the room"));
  EXPECT_THAT(mistake("channel", pipe, "ambient"), HasSubstr(":8: 'ambient' cannot be the name of a body"));
  EXPECT_THAT(mistake("lump", lump, "ambient air"), HasSubstr("the body 'ambient air' has no path"));
}

/// What adds up or is averaged over places takes none of them twice.
TEST(MachineMistakes, RefusesPlacesThatHaveSomethingInCommon) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& machine, std::string const& table) {
    put(folder / "mine.toml", contents(machine_file(machine)) + table);
    return check_files({folder / "mine.toml"})[0].mistake;
  };
  auto const film = [&](std::string const& one, std::string const& other, std::string const& machine = "v450") {
    return mistake(machine,
                   "[[film]]\nname = \"both\"\narea = \"0.1 m2\"\non = [\"" + one + "\", \"" + other + "\"]\n");
  };
  EXPECT_THAT(
      film("shaft[40 mm .. 90 mm]", "shaft[80 mm .. 99 mm]"),
      AllOf(MatchesRegex(".*mine.toml:[0-9]+:32: .*"),
            HasSubstr("'shaft[40 mm .. 90 mm]' and 'shaft[80 mm .. 99 mm]' overlap: what they share would count")));
  for (std::string const other : {"shaft", "shaft.surface", "shaft[1 mm .. 2 mm]"})
    EXPECT_THAT(film("shaft", other), HasSubstr("'shaft' and '" + other + "' overlap")) << other;
  EXPECT_THAT(film("bed", "bed.surface"), HasSubstr("overlap"));
  for (std::string const other : {"shaft.end", "shaft[90 mm .. 99 mm]", "test_bar[40 mm .. 90 mm]"})
    EXPECT_EQ(film("shaft[40 mm .. 90 mm]", other), "") << other;
  std::string const low = "table.x_min[0 mm .. 50 mm, 0 mm .. 50 mm]";
  EXPECT_THAT(film(low, "table.x_min[40 mm .. 60 mm, 40 mm .. 60 mm]", "vmc850_fine"), HasSubstr("overlap"));
  EXPECT_EQ(film(low, "table.x_min[40 mm .. 60 mm, 50 mm .. 60 mm]", "vmc850_fine"), "");

  auto const sensor = [&](std::string const& keys) {
    return mistake("v450", "[[temperature_sensor]]\nname = \"both\"\n" + keys);
  };
  EXPECT_THAT(sensor("at = [\"bed\", \"motor\", \"bed\"]\n"),
              MatchesRegex(".*:[0-9]+:23: 'bed' and 'bed' overlap: .*"));
  EXPECT_THAT(sensor("at = [\"cartridge[10 mm]\", \"cartridge[1 cm]\"]\n"), HasSubstr("overlap"));
  EXPECT_EQ(sensor("at = [\"cartridge[10 mm]\", \"cartridge[11 mm]\"]\n"), "");
  EXPECT_EQ(sensor("at = [\"bed\", \"motor\", \"bed\"]\nshares = [0.2, 0.5, 0.3]\n"), "");
}

TEST(MachineMistakes, AFilmLeadsToAFluid) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& machine, std::string const& on, std::string const& to) {
    put(folder / "mine.toml", contents(machine_file(machine)) + "[[film]]\nname = \"more\"\non = \"" + on +
                                  "\"\nto = \"" + to + "\"\narea = \"0.1 m2\"\n");
    return check_files({folder / "mine.toml"})[0].mistake;
  };
  EXPECT_THAT(mistake("mill200", "head", "base"),
              AllOf(MatchesRegex(".*mine.toml:[0-9]+:6: .*"),
                    HasSubstr("'base' is a solid of GJL-300; a fluid is due, which has a heat_capacity and no "
                              "material; known: 'ambient'")));
  EXPECT_EQ(mistake("g200", "bed_base", "tank"), "");
  EXPECT_EQ(mistake("mill200", "head", "ambient"), "");
}

/// A shaft cannot be its own outer ring.
TEST(MachineMistakes, RefusesABearingOnOneBody) {
  TemporaryDirectory const folder;
  put(folder / "mine.toml", machine_changed("v450", "outer = \"front_ring\"", "outer = \"shaft[300 mm .. 320 mm]\""));
  EXPECT_THAT(
      check_files({folder / "mine.toml"})[0].mistake,
      MatchesRegex(".*mine.toml:225:9: 'shaft.*' and 'shaft\\[300 mm .. 320 mm\\]' are on one body; 'inner' and "
                   "'outer' are due on two"));
}

TEST(MachineMistakes, RefusesOneNameForTwoChannels) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& table) {
    put(folder / "mine.toml", machine_with(table));
    return check_files({folder / "mine.toml"})[0].mistake;
  };
  EXPECT_THAT(mistake("[[displacement]]\nname = \"T1\"\n"),
              MatchesRegex(".*mine.toml:[0-9]+:8: the name 'T1' is taken by a \\[\\[temperature_sensor\\]\\]"));
  EXPECT_THAT(mistake("[[temperature_sensor]]\nname = \"spindle.speed\"\nat = \"bed\"\n"),
              MatchesRegex(".*mine.toml:[0-9]+:8: 'spindle.speed' is the name of an input channel; a "
                           "\\[\\[temperature_sensor\\]\\] needs another"));
  EXPECT_THAT(mistake("[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 W\"\nwhile_on = \"pump.on\"\n"
                      "[[temperature_sensor]]\nname = \"pump.on\"\nat = \"bed\"\n"),
              HasSubstr("'pump.on' is the name of an input channel"));
  EXPECT_EQ(mistake("[[temperature_sensor]]\nname = \"bed.side\"\nat = \"bed\"\n"), "");
}

TEST(MachineMistakes, RefusesADisplacementThatNothingMoves) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& table) {
    put(folder / "mine.toml", machine_with("[[displacement]]\nname = \"E_Q\"\n" + table));
    return check_files({folder / "mine.toml"})[0].mistake;
  };
  EXPECT_THAT(mistake(""), MatchesRegex(".*mine.toml:[0-9]+:[0-9]+: nothing moves 'E_Q'; .*"));
  EXPECT_EQ(mistake("segment = [{ of = \"bed\", length = \"1 m\" }]\n"), "");
  for (std::string const part : {"[[displacement_step]]\nfollows = \"spindle.running\"\nstep = \"2 um\"\n",
                                 "[[probe_drift]]\ndrift = \"1 um/h\"\n"})
    EXPECT_EQ(mistake(part + "name = \"jump\"\ndisplacement = \"E_Q\"\n"), "") << part;
}

TEST(MachineMistakes, RefusesALumpWithoutAThickness) {
  TemporaryDirectory const folder;
  for (std::string const edge : {"0 mm", "-20 mm"}) {
    put(folder / "mine.toml", machine_with("[[lump]]\nname = \"plate\"\nheat_capacity = \"1 kJ/K\"\n"
                                           "size = [\"120 mm\", \"" +
                                           edge + "\", \"120 mm\"]\n"));
    EXPECT_THAT(check_files({folder / "mine.toml"})[0].mistake,
                HasSubstr("'size' is [\"120 mm\", \"" + edge + "\", \"120 mm\"]; every edge must be positive"));
  }
}

/// Each at its own line of the file.
TEST(MachineMistakes, RefusesWhatNoRunCanDo) {
  TemporaryDirectory const folder;
  auto const lines = [](std::string const& text) { return std::count(text.begin(), text.end(), '\n'); };
  auto const refuses = [&](std::string const& before, std::string const& wrong, std::string const& message) {
    put(folder / "mine.toml", machine_with(before + wrong + "\n"));
    EXPECT_THAT(check_files({folder / "mine.toml"})[0].mistake,
                AllOf(HasSubstr(fmt::format("mine.toml:{}:", 1 + lines(machine_with(before)))), HasSubstr(message)));
  };
  refuses("[[lump]]\nname = \"box\"\nmaterial = \"C45\"\nheat_capacity = \"1 kJ/K\"\n", "mass = \"4 kg\"",
          "give either 'heat_capacity' or 'mass', not both");
  std::string const bar = "[[bar]]\nname = \"rod\"\nmaterial = \"C45\"\nlength = \"1 m\"\nouter_diameter = \"40 mm\"\n";
  for (std::string const section : {"1 um", "1 mm", "41 mm", "4 m"})
    refuses(bar, "section_diameter = \"" + section + "\"", "of an outer diameter of 40 mm, allowed is 2 mm to 40 mm");
  refuses(bar, "capacity_factor = 0", "'capacity_factor' is 0; it must be positive (plausible: 0.3 to 3)");
  refuses(bar, "section_diameter = \"0 mm\"", "'section_diameter' is \"0 mm\"; it must be positive");
  refuses("[[axis]]\nname = \"w\"\nrapid_feed = \"10 m/min\"\nstroke_to = \"100 mm\"\n", "lead = \"0 mm\"",
          "'lead' is \"0 mm\"; it must be positive");
  refuses("[[joint]]\nname = \"twice\"\nfrom = \"bed\"\nto = \"motor\"\nconductance = \"8 W/K\"\n",
          "coefficient = \"800 W/(m2 K)\"", "give either 'conductance' or 'coefficient', not both");
  refuses("[[film]]\nname = \"shine\"\non = \"bed\"\narea = \"1 m2\"\n", "emissivity = 2.0",
          "'emissivity' is 2; it must be at most 1 (plausible: 0.05 to 1)");
}

/// What a run would refuse only when its readings are taken.
TEST(MachineMistakes, RefusesWhatAnInstrumentCannotDo) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& table) {
    put(folder / "mine.toml", machine_with(table));
    return check_files({folder / "mine.toml"})[0].mistake;
  };
  std::string const sensor = "[[temperature_sensor]]\nname = \"hot\"\nat = \"bed\"\n";
  EXPECT_THAT(mistake(sensor + "lowest = \"90 degC\"\nhighest = \"60 degC\"\n"),
              MatchesRegex(".*mine.toml:[0-9]+:1: sensor 'hot': lowest is 90 degC, highest 60 degC; they must rise"));
  EXPECT_THAT(mistake(sensor + "conversion_interval = \"0 s\"\n"),
              HasSubstr("sensor 'hot': conversion_interval is 0 s; it must be positive"));
  EXPECT_THAT(mistake("[[displacement_probe]]\nname = \"P\"\nof = \"E_Z\"\nconversion_interval = \"0 s\"\n"),
              HasSubstr("probe 'P': conversion_interval is 0 s; it must be positive"));
}

TEST(MachineMistakes, RefusesPlacesThatNoSensorCanHave) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& places) {
    put(folder / "mine.toml", machine_with("[[temperature_sensor]]\nname = \"both\"\n" + places));
    return check_files({folder / "mine.toml"})[0].mistake;
  };
  EXPECT_EQ(mistake("at = [\"bed\", \"motor\"]\nshares = [1.1, -0.1]\n"), "");
  EXPECT_THAT(mistake("at = [\"bed\", \"motor\"]\nshares = [1]\n"),
              MatchesRegex(".*mine.toml:[0-9]+:[0-9]+: sensor 'both': 'shares' has 1 numbers for 2 places"));
  EXPECT_THAT(mistake("at = [\"bed\", \"motor\"]\nshares = [0.5, 0.4]\n"),
              HasSubstr("'shares' must add up to 1, not to 0.9"));
  EXPECT_THAT(mistake("at = [\"bed\", \"ambient\"]\n"),
              HasSubstr("sensor 'both': one in the room, 'ambient', has no other place"));
}

std::string milling_centre(std::string const& old, std::string const& fresh) {
  return machine_changed("vmc850", old, fresh);
}

TEST(MachineMistakes, RefusesASupportBearingThatDrivesTwice) {
  TemporaryDirectory const folder;
  put(folder / "mine.toml", milling_centre("bearings = [\"upper\", \"lower\"]", "bearings = [\"upper\", \"upper\"]"));
  EXPECT_THAT(check_files({folder / "mine.toml"})[0].mistake,
              HasSubstr("mine.toml:191:13: the support bearing 'upper' would count twice"));
}

/// The screw is 840 mm long; the stroke goes from 120 to 720 mm.
TEST(MachineMistakes, RefusesWhatLiesBeyondTheScrew) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& old, std::string const& fresh) {
    put(folder / "mine.toml", milling_centre(old, fresh));
    return check_files({folder / "mine.toml"})[0].mistake;
  };
  EXPECT_EQ(mistake("stroke_to = \"720 mm\"", "stroke_to = \"84 cm\""), "");
  EXPECT_THAT(mistake("stroke_to = \"720 mm\"", "stroke_to = \"5 m\""),
              HasSubstr("mine.toml:11:13: 'stroke_to': 5 m is not on the screw of axis 'z', which reaches from 0 mm "
                        "to 840 mm"));
  EXPECT_THAT(mistake("stroke_to = \"720 mm\"", "stroke_to = \"100 mm\""),
              HasSubstr("mine.toml:11:13: the stroke of axis 'z' ends at 100 mm; it must end beyond stroke_from, "
                        "120 mm"));
  std::string const positions = "positions = [\"120 mm\", \"420 mm\", \"720 mm\"]";
  EXPECT_EQ(mistake(positions, "positions = [\"0 mm\", \"840 mm\"]"), "");
  EXPECT_THAT(
      mistake(positions, "positions = [\"120 mm\", \"4 m\"]"),
      HasSubstr(
          "mine.toml:372:24: 'positions': 4 m is not on the screw of axis 'z', which reaches from 0 mm to 840 mm"));
}

TEST(MachineMistakes, ABallScrewIsTheBarOnWhichItsNutRuns) {
  TemporaryDirectory const folder;
  put(folder / "mine.toml", contents(machine_file("vmc850")) +
                                "[[bar]]\nname = \"shaft\"\nmaterial = \"screw steel\"\norigin = [\"0 mm\", \"0 mm\", "
                                "\"0 mm\"]\ndirection = \"z\"\nlength = \"2 m\"\nouter_diameter = \"40 mm\"\n"
                                "[[ball_screw]]\nname = \"E_S\"\naxis = \"z\"\nbody = \"shaft\"\n");
  EXPECT_THAT(check_files({folder / "mine.toml"})[0].mistake,
              MatchesRegex(".*mine.toml:[0-9]+:8: 'shaft' is no screw of axis 'z', whose ball_nut runs on 'screw'"));
}

/// Where a machine states its axes, there is no other.
TEST(MachineMistakes, RefusesAnAxisThatTheMachineHasNot) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& text) {
    put(folder / "mine.toml", text);
    return check_files({folder / "mine.toml"})[0].mistake;
  };
  for (std::string const part : {"ball_nut", "support_bearing", "feed_motor"})
    EXPECT_THAT(mistake(milling_centre("[[" + part + "]]", "[[" + part + "]]\naxis = \"Z\"")),
                MatchesRegex(".*mine.toml:[0-9]+:8: the machine has no axis 'Z'; did you mean 'z'\\?"))
        << part;
  EXPECT_THAT(mistake(milling_centre("axis = \"z\"", "axis = \"Z\"")),
              HasSubstr("mine.toml:369:8: the machine has no axis 'Z'; did you mean 'z'?"));
  EXPECT_THAT(mistake(milling_centre("[[ball_nut]]", "[[ball_nut]]\naxis = \"w\"")),
              HasSubstr("mine.toml:159:8: the machine has no axis 'w'; known: 'z'"));
  EXPECT_THAT(mistake(machine_changed("mill200", "screw = \"x_screw\"\naxis = \"x\"\n", "screw = \"x_screw\"\n")),
              HasSubstr("mine.toml:178:1: 'axis' is not given: the machine has no axis 'z'; known: 'x'"));
  EXPECT_THAT(mistake(milling_centre("speed = \"z.speed\"", "speed = \"Z.speed\"")),
              HasSubstr("mine.toml:294:9: 'Z.speed': the machine has no axis 'Z'; did you mean 'z'?"));
  EXPECT_EQ(mistake(milling_centre("speed = \"z.speed\"", "speed = \"pump.speed\"")), "");
}

}  // namespace
}  // namespace thermotwin::twin
