#include "twin/file_check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "twin/error_model_file.h"
#include "twin/experiment_file.h"
#include "twin/machine.h"
#include "twin/study/judgement.h"

/// `thermotwin check`: each file by itself, and experiments with their machine.
namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::SizeIs;
using thermotwin::tests::contents;
using thermotwin::tests::put;
using thermotwin::tests::TemporaryDirectory;

constexpr char const* experiment = "machine = \"v450\"\nduration = \"1 h\"\n";

/// The air of an hour; the channel that it is taken for is left open.
constexpr char const* air = "time_s,room\n0,20\n600,20.5\n1200,21\n1800,21.5\n2400,22\n3000,22.5\n3600,23\n";
std::string recorded(std::string const& channel) {
  return "[[recorded]]\nfile = \"air.csv\"\ncolumns = [{column = \"room\", channel = \"" + channel +
         "\", unit = \"degC\"}]\n";
}

/// The lumped machine with one thing more.
std::string machine_with(std::string const& table) { return contents(machine_file("v450")) + table; }

TEST(FileCheck, FindsNothingInWhatIsShipped) {
  std::vector<fs::path> files;
  for (auto const* folder : {"twin/machines", "scenarios/catalogue"})
    for (auto const& entry : fs::directory_iterator(fs::path(THERMOTWIN_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
  auto const checks = check_files(files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_EQ(checks[i].mistake, "") << files[i];
    std::size_t const implausible = files[i].stem() == "tclab" ? 2 : 0;  // two transistors are no machine tool
    EXPECT_THAT(checks[i].warnings, SizeIs(implausible)) << files[i];
    EXPECT_NE(checks[i].text, "");
  }
}

TEST(FileCheck, KnowsTheNamesOfWhatIsShipped) {
  fs::path const source = THERMOTWIN_SOURCE_DIR;
  EXPECT_EQ(file_to_check("v450"), source / "twin/machines/v450.toml");
  EXPECT_EQ(file_to_check("golden_b_4000"), source / "scenarios/catalogue/golden_b_4000.toml");
  EXPECT_EQ(file_to_check("paper_004"), source / "scenarios/studies/paper_004.toml");
  EXPECT_EQ(file_to_check("v450_small"), source / "scenarios/campaigns/v450_small.toml");
  for (std::string const path : {"v450.toml", "some/v450", "v45"}) EXPECT_EQ(file_to_check(path), path);
  EXPECT_EQ(check_files({file_to_check("v45")})[0].mistake, "v45: there is no such file; did you mean 'v450'?");
  EXPECT_EQ(check_files({file_to_check("paper_04")})[0].mistake,
            "paper_04: there is no such file; did you mean 'paper_004'?");
}

TEST(FileCheck, WarnsOfWhatIsNotPlausible) {
  TemporaryDirectory const folder;
  auto text = contents(machine_file("v450"));
  std::string const factor = "grease_factor = 0.55";
  text.replace(text.find(factor), factor.size(), "grease_factor = 55");
  put(folder / "machine.toml", text);
  put(folder / "experiment.toml", std::string(experiment) + "ambient.daily_cycle.amplitude = \"12 K\"\n");
  auto const checks = check_files({folder / "machine.toml", folder / "experiment.toml"});
  EXPECT_EQ(checks[0].mistake, "");
  EXPECT_THAT(checks[0].warnings,
              ElementsAre(MatchesRegex(
                  ".*machine.toml:[0-9]+:[0-9]+: 'grease_factor' is 55; outside what is plausible: 0.2 to 8")));
  EXPECT_THAT(checks[1].warnings, ElementsAre(HasSubstr("'amplitude' is \"12 K\"; outside what is plausible")));
}

TEST(FileCheck, WarnsOfUnitsThatSlipped) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& from, std::string const& to) {
    auto text = contents(machine_file("v450"));
    EXPECT_NE(text.find(from), std::string::npos) << from;
    put(folder / "mine.toml", text.replace(text.find(from), from.size(), to));
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
  put(folder / "experiment.toml", std::string(experiment) + "[ambient]\nstratification = \"70 K/m\"\n");
  EXPECT_THAT(check_files({folder / "experiment.toml"})[0].warnings,
              ElementsAre(HasSubstr("'stratification' is \"70 K/m\"; outside what is plausible: -5 K/m to 10 K/m")));
}

TEST(FileCheck, SaysOnceWhatIsWrongWithANumber) {
  TemporaryDirectory const folder;
  std::string const block = "[spindle]\nblocks = [{duration = \"1 h\", of_maximum = 1.5}]\n";
  put(folder / "experiment.toml", experiment + block + "[ambient]\ndaily_cycle.amplitude = \"12 K\"\n");
  auto const check = check_files({folder / "experiment.toml"})[0];
  EXPECT_THAT(check.mistake, HasSubstr("experiment.toml:4:43: spindle.blocks[0].of_maximum: 1.5 must be from 0 to 1"));
  EXPECT_THAT(check.warnings, ElementsAre(HasSubstr("'amplitude' is \"12 K\"")));
}

TEST(FileCheck, WarnsOfAnInputThatNearlyHasAKnownName) {
  TemporaryDirectory const folder;
  auto text = contents(machine_file("vmc850"));
  std::string const speed = "speed = \"z.speed\"";
  text.replace(text.find(speed), speed.size(), "speed = \"zspeed\"");
  put(folder / "machine.toml", text);
  auto const check = check_files({folder / "machine.toml"})[0];
  EXPECT_EQ(check.mistake, "");
  EXPECT_THAT(check.warnings,
              ElementsAre(MatchesRegex(".*machine.toml:294:[0-9]+: input 'zspeed': did you mean 'z.speed'\\?")));
}

TEST(FileCheck, CountsInWholeNumbers) {
  TemporaryDirectory const folder;
  auto text = contents(machine_file("v450"));
  text.replace(text.find("count = 2"), 9, "count = 2.5");
  put(folder / "machine.toml", text);
  EXPECT_THAT(check_files({folder / "machine.toml"})[0].mistake,
              MatchesRegex(".*machine.toml:[0-9]+:[0-9]+: 'count' is 2.5; a whole number is due"));
}

TEST(FileCheck, AMistakeDoesNotHideTheNextFile) {
  TemporaryDirectory const folder;
  put(folder / "broken.toml", "name = ");
  put(folder / "experiment.toml", experiment);
  auto const checks = check_files({folder / "broken.toml", folder / "none.toml", folder / "experiment.toml"});
  EXPECT_THAT(checks[0].mistake, HasSubstr("broken.toml:1:"));
  EXPECT_THAT(checks[1].mistake, HasSubstr("none.toml: there is no such file"));
  EXPECT_EQ(checks[2].mistake, "");
  EXPECT_EQ(checks[2].text, "an experiment of 1.00 h on v450");
}

TEST(FileCheck, KnowsEveryKindOfFile) {
  fs::path const source = THERMOTWIN_SOURCE_DIR;
  TemporaryDirectory const folder;
  put(folder / "sites.toml", "[[site]]\nat = \"motor\"\n");
  put(folder / "model.toml",
      "[predicts]\nerror = \"E_X\"\n[model]\nmethod = \"linear\"\ninputs = [\"T2\"]\n[model.linear]\n"
      "intercept = 1\nlag = [{ samples = 0, coefficients = [1] }]\n");
  put(folder / "run.csv", "time_s,T1_degC,T2_degC,E_Z_um\n0,20,20,0\n600,21,20,3\n1200,22,20,5\n");
  put(folder / "run.toml",
      "[[table]]\nfile = \"run.csv\"\nreading = [{column = \"T1_degC\", sensor = \"T1\", unit = \"degC\"}]\n");
  auto const checks =
      check_files({source / "scenarios/studies/paper_004.toml", source / "scenarios/campaigns/v450_small.toml",
                   folder / "sites.toml", folder / "model.toml", folder / "run.csv", folder / "run.toml",
                   source / "scenarios/campaigns/v450_spectra.toml"});
  for (auto const& check : checks) EXPECT_EQ(check.mistake, "");
  EXPECT_EQ(checks[0].text, "a study of 1 world, 17 selections and 14 models");
  EXPECT_EQ(checks[1].text, "a campaign of 200 runs on v450");
  EXPECT_THAT(checks[2].text, HasSubstr("candidates of a placement: 1 site; name a machine"));
  EXPECT_EQ(checks[3].text, "an error model: linear of E_X [um] on 1 input, fitted to nobody knows what");
  EXPECT_EQ(checks[4].text, "a record of 0.33 h: 3 rows, 0 inputs, 2 sensors, 1 displacement channel");
  EXPECT_THAT(checks[4].warnings, ElementsAre(HasSubstr("run.csv: 'T2' is dead: it never moves")));
  EXPECT_EQ(checks[5].text, "a record of 0.33 h: 3 rows, 0 inputs, 1 sensor, 0 displacement channels");
  EXPECT_THAT(checks[6].text, HasSubstr("a campaign of "));
}

/// The twin is asked whether it has what it shall observe.
TEST(FileCheck, LooksAtAnObserverTogetherWithItsTwin) {
  TemporaryDirectory const folder;
  fs::copy_file(machine_file("v450"), folder / "mine.toml");
  SavedErrorModel saved;
  saved.error = "E_Z";
  saved.twin = twin_beside(folder / "mine.toml");
  auto const check = [&](std::vector<std::string> const& sensors, bool mean) {
    saved.parts = {observing_part(sensors, {})};
    if (mean) saved.parts.push_back({nothing_more(sensors), true, {}});
    write_error_model(folder / "model.toml", saved);
    return check_files({folder / "model.toml"})[0];
  };
  EXPECT_EQ(check({"T1", "T3"}, false).text,
            "an error model: twin observer of E_Z [um] on 2 inputs, fitted to nobody knows what");
  EXPECT_THAT(check({"T1", "T33"}, false).mistake,
              HasSubstr("model.toml:12:17: the twin has no sensor 'T33' on a body; did you mean 'T3'?"));
  EXPECT_THAT(check({"T1", "T33"}, true).mistake,
              HasSubstr("model.toml:12:17: the twin has no sensor 'T33' on a body"));
  saved.error = "E_W";
  EXPECT_THAT(check({"T1"}, false).mistake, HasSubstr("model.toml:10:1: the machine has no displacement 'E_W'"));
}

TEST(FileCheck, FindsTheMistakesOfEveryKind) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& text, std::string const& name = "file.toml") {
    put(folder / name, text);
    return check_files({folder / name})[0].mistake;
  };
  EXPECT_THAT(mistake("models = [\"linear\"]\nselections = [\"al\"]\n"),
              HasSubstr("file.toml:2:15: no selection method 'al'"));
  EXPECT_THAT(mistake("experiments = [\"etv\"]\n"), HasSubstr("file.toml:1:16: there is no experiment 'etv'"));
  EXPECT_THAT(mistake("experiments = [\"etve\"]\nmachine = \"v450\"\ntolerance = 0\n"),
              HasSubstr("file.toml:3:13: 'tolerance' is 0; allowed is 1e-12 to 0.01"));
  EXPECT_THAT(mistake("predicts = { error = \"E_X\" }\n"), HasSubstr("file.toml:1:1: no table [model]"));
  EXPECT_THAT(mistake("forbiden = []\nmost = 3\n"), HasSubstr("file.toml:1:1: unknown key 'forbiden'"));
  EXPECT_THAT(mistake("[[table]]\nfile = \"none.csv\"\n"), HasSubstr("none.csv"));
  EXPECT_THAT(mistake("time_s,T1_degC\n0,20\n60,warm\n", "run.csv"),
              HasSubstr("run.csv:3:4: column 'T1_degC': 'warm'"));
}

/// What `run -o` would refuse after the run.
TEST(FileCheck, RefusesNamesThatNoChannelCanHave) {
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
TEST(FileCheck, RefusesNamesThatNoPlaceCanBeginWith) {
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
TEST(FileCheck, RefusesPlacesThatHaveSomethingInCommon) {
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

TEST(FileCheck, AFilmLeadsToAFluid) {
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
TEST(FileCheck, RefusesABearingOnOneBody) {
  TemporaryDirectory const folder;
  auto text = contents(machine_file("v450"));
  std::string const ring = "outer = \"front_ring\"";
  text.replace(text.find(ring), ring.size(), "outer = \"shaft[300 mm .. 320 mm]\"");
  put(folder / "mine.toml", text);
  EXPECT_THAT(
      check_files({folder / "mine.toml"})[0].mistake,
      MatchesRegex(".*mine.toml:225:9: 'shaft.*' and 'shaft\\[300 mm .. 320 mm\\]' are on one body; 'inner' and "
                   "'outer' are due on two"));
}

/// A screw stands still most of the time, and is measured then.
TEST(FileCheck, WarnsOfSensorsThatTurnWithTheSpindle) {
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

TEST(FileCheck, WarnsOfMassesThatDoNotFitTheirBox) {
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

TEST(FileCheck, RefusesOneNameForTwoChannels) {
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

TEST(FileCheck, RefusesADisplacementThatNothingMoves) {
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

TEST(FileCheck, RefusesALumpWithoutAThickness) {
  TemporaryDirectory const folder;
  for (std::string const edge : {"0 mm", "-20 mm"}) {
    put(folder / "mine.toml", machine_with("[[lump]]\nname = \"plate\"\nheat_capacity = \"1 kJ/K\"\n"
                                           "size = [\"120 mm\", \"" +
                                           edge + "\", \"120 mm\"]\n"));
    EXPECT_THAT(check_files({folder / "mine.toml"})[0].mistake,
                HasSubstr("'size' is [\"120 mm\", \"" + edge + "\", \"120 mm\"]; every edge must be positive"));
  }
}

TEST(FileCheck, TellsAMistakeOfAMachineOnce) {
  TemporaryDirectory const folder;
  put(folder / "mine.toml", machine_with("[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 K\"\n"));
  put(folder / "experiment.toml", "machine = \"mine.toml\"\nduration = \"1 h\"\n");
  auto const checks = check_files({folder / "experiment.toml", folder / "mine.toml"});
  EXPECT_EQ(checks[0].mistake, "");
  EXPECT_EQ(checks[0].text, "an experiment of 1.00 h, not looked at together with 'mine.toml', which has a mistake");
  EXPECT_THAT(checks[1].mistake, HasSubstr("mine.toml:"));
  EXPECT_EQ(check_files({folder / "experiment.toml"})[0].mistake, checks[1].mistake);
}

/// Each at its own line of the file.
TEST(FileCheck, RefusesWhatNoRunCanDo) {
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

TEST(FileCheck, DoubtsANutWithAnotherLeadThanItsAxis) {
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

/// What a run would refuse only when its readings are taken.
TEST(FileCheck, RefusesWhatAnInstrumentCannotDo) {
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
  put(folder / "experiment.toml", std::string(experiment) + "[laser]\naxis = \"z\"\n");
  EXPECT_THAT(
      check_files({folder / "experiment.toml", machine_file("v450")})[0].mistake,
      HasSubstr("experiment.toml:4:8: laser.axis: the laser measures axis 'z', but the machine has no ball_screw"));
}

TEST(FileCheck, RefusesPlacesThatNoSensorCanHave) {
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

TEST(FileCheck, LeavesAComplaintThatNamesItsOwnFile) {
  TemporaryDirectory const folder;
  put(folder / "experiment.toml", std::string(experiment) + "[[recorded]]\nfile = \"air.csv\"\ncolumns = []\n");
  Value const document = read_toml(folder / "experiment.toml");
  for (std::string const complaint : {"air.csv: is empty", "folder/air.csv: is empty", "air.csv:3: column 'room'"})
    EXPECT_EQ(located_in(document, thermal::InputError(complaint)).what(), complaint);
  EXPECT_THAT(located_in(document, thermal::InputError("duration: 0 s must be above 0 s")).what(),
              HasSubstr("experiment.toml:2:12: duration: 0 s"));
}

/// vmc850 with one text in place of another, its first.
std::string milling_centre(std::string const& old, std::string const& fresh) {
  auto text = contents(machine_file("vmc850"));
  return text.replace(text.find(old), old.size(), fresh);
}

TEST(FileCheck, RefusesASupportBearingThatDrivesTwice) {
  TemporaryDirectory const folder;
  put(folder / "mine.toml", milling_centre("bearings = [\"upper\", \"lower\"]", "bearings = [\"upper\", \"upper\"]"));
  EXPECT_THAT(check_files({folder / "mine.toml"})[0].mistake,
              HasSubstr("mine.toml:191:13: the support bearing 'upper' would count twice"));
}

/// The screw is 840 mm long; the stroke goes from 120 to 720 mm.
TEST(FileCheck, RefusesWhatLiesBeyondTheScrew) {
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

/// The same of experiments; a laser's targets count from the start of the stroke.
TEST(FileCheck, RefusesAProgrammeBeyondTheScrew) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& more) {
    put(folder / "experiment.toml", "machine = \"vmc850\"\nduration = \"1 h\"\n" + more);
    return check_files({folder / "experiment.toml"})[0].mistake;
  };
  std::string const axes = "[[axes]]\nblocks = [{duration = \"1 h\", feed = \"8 m/min\"}]\n";
  EXPECT_EQ(mistake(axes + "stroke_to = \"840 mm\"\n"), "");
  EXPECT_THAT(mistake(axes + "stroke_to = \"1600 mm\"\n"),
              HasSubstr("experiment.toml:5:13: axes.z.stroke_to: 1.6 m is not on the screw of axis 'z', which reaches "
                        "from 0 mm to 840 mm"));
  EXPECT_THAT(mistake(axes + "stroke_from = \"-10 mm\"\n"),
              HasSubstr("experiment.toml:5:15: axes.z.stroke_from: -10 mm is not on the screw"));
  EXPECT_EQ(mistake("laser.to = \"700 mm\"\n"), "");
  EXPECT_THAT(mistake("laser.to = \"750 mm\"\n"),
              HasSubstr("experiment.toml:3:12: laser.to: 750 mm from the start of the stroke, 870 mm is not on the "
                        "screw of axis 'z'"));
}

TEST(FileCheck, ABallScrewIsTheBarOnWhichItsNutRuns) {
  TemporaryDirectory const folder;
  put(folder / "mine.toml", contents(machine_file("vmc850")) +
                                "[[bar]]\nname = \"shaft\"\nmaterial = \"screw steel\"\norigin = [\"0 mm\", \"0 mm\", "
                                "\"0 mm\"]\ndirection = \"z\"\nlength = \"2 m\"\nouter_diameter = \"40 mm\"\n"
                                "[[ball_screw]]\nname = \"E_S\"\naxis = \"z\"\nbody = \"shaft\"\n");
  EXPECT_THAT(check_files({folder / "mine.toml"})[0].mistake,
              MatchesRegex(".*mine.toml:[0-9]+:8: 'shaft' is no screw of axis 'z', whose ball_nut runs on 'screw'"));
}

/// Where a machine states its axes, there is no other.
TEST(FileCheck, RefusesAnAxisThatTheMachineHasNot) {
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
  auto text = contents(machine_file("mill200"));
  std::string const with_axis = "screw = \"x_screw\"\naxis = \"x\"\n";
  text.replace(text.find(with_axis), with_axis.size(), "screw = \"x_screw\"\n");
  EXPECT_THAT(mistake(text),
              HasSubstr("mine.toml:178:1: 'axis' is not given: the machine has no axis 'z'; known: 'x'"));
  EXPECT_THAT(mistake(milling_centre("speed = \"z.speed\"", "speed = \"Z.speed\"")),
              HasSubstr("mine.toml:294:9: 'Z.speed': the machine has no axis 'Z'; did you mean 'z'?"));
  EXPECT_EQ(mistake(milling_centre("speed = \"z.speed\"", "speed = \"pump.speed\"")), "");
}

/// A complaint about an axis names it by its name; the default is z.
TEST(FileCheck, AComplaintAboutAnAxisPointsToItsKey) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& axes) {
    put(folder / "experiment.toml", "machine = \"vmc850\"\nduration = \"1 h\"\n" + axes);
    return check_files({folder / "experiment.toml"})[0].mistake;
  };
  std::string const blocks = "blocks = [{duration = \"1 h\", feed = \"8 m/min\"}]\n";
  EXPECT_THAT(mistake("[[axes]]\n" + blocks + "duty = 2\n"),
              HasSubstr("experiment.toml:5:8: axes.z.duty: 2 must be above 0 and at most 1"));
  EXPECT_THAT(mistake("[[axes]]\naxis = \"z\"\nblocks = [{duration = \"10 min\"},\n  {duration = \"1 h\", feed = "
                      "\"80 m/min\"}]\n"),
              HasSubstr("experiment.toml:6:29: axes.z.blocks[1].feed: 80000 mm/min is above"));
  EXPECT_THAT(mistake("[[axes]]\n" + blocks + "stroke_to = \"100 mm\"\n"),
              HasSubstr("experiment.toml:5:13: axes.z.stroke_to: 100 mm must be beyond stroke_from, 120 mm"));
}

TEST(FileCheck, LooksAtCandidatesAndMachineTogether) {
  TemporaryDirectory const folder;
  put(folder / "sites.toml", "forbidden = [\"rotr\"]\n");
  auto const checks = check_files({folder / "sites.toml", machine_file("v450")});
  EXPECT_THAT(checks[0].mistake, HasSubstr("sites.toml:1:14: unknown body 'rotr'; did you mean 'rotor'?"));
  EXPECT_EQ(checks[1].mistake, "");
}

TEST(FileCheck, LooksAtMachineAndExperimentTogether) {
  TemporaryDirectory const folder;
  put(folder / "mine.toml", machine_with("[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 W\"\n"
                                         "while_on = \"coolant.onn\"\n"));
  put(folder / "experiment.toml", experiment);
  EXPECT_EQ(check_files({folder / "mine.toml"})[0].mistake, "");
  auto const checks = check_files({folder / "mine.toml", folder / "experiment.toml"});
  EXPECT_EQ(checks[0].mistake, "");
  EXPECT_THAT(checks[1].mistake, MatchesRegex(".*mine.toml:[0-9]+:[0-9]+: the machine needs the input 'coolant.onn', "
                                              "which the experiment does not give; did you mean 'coolant.on'\\?"));
}

/// 314 rad/s would be 314 times the power.
/// With `run -m` that is as it should be; whoever meant the other machine is told.
TEST(FileCheck, WarnsOfAnExperimentOfAnotherMachine) {
  TemporaryDirectory const folder;
  fs::copy_file(machine_file("v450"), folder / "mine.toml");
  fs::copy_file(machine_file("vmc850"), folder / "other.toml");
  auto const warnings = [&](std::string const& named, std::string const& machine) {
    put(folder / "day.toml", "machine = \"" + named + "\"\nduration = \"1 h\"\n");
    return check_files({folder / machine, folder / "day.toml"})[1].warnings;
  };
  EXPECT_THAT(warnings("v450", "other.toml"),
              Contains(HasSubstr("day.toml: it is an experiment of 'v450', the machine file is 'vmc850'")));
  EXPECT_THAT(warnings("v450.toml", "other.toml"),
              Contains(HasSubstr("day.toml: it is an experiment of 'v450.toml', the machine file is 'vmc850'")));
  for (auto const* named : {"v450", "v450_fine", "mine.toml", "v450.toml", "machines/v450.toml"})
    EXPECT_THAT(warnings(named, "mine.toml"), testing::Not(Contains(HasSubstr("it is an experiment of")))) << named;
}

TEST(FileCheck, RefusesAFlagThatIsNoShare) {
  TemporaryDirectory const folder;
  put(folder / "experiment.toml", experiment);
  for (auto const& [channel, unit] : {std::pair{"time_of_day", "s"}, {"ambient.temperature", "K"}}) {
    put(folder / "mine.toml", machine_with(std::string("[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 W\"\n") +
                                           "while_on = \"" + channel + "\"\n"));
    EXPECT_THAT(check_files({folder / "mine.toml", folder / "experiment.toml"})[1].mistake,
                HasSubstr(std::string("the machine takes the input '") + channel +
                          "' as a share between 0 and 1, and the experiment gives it in " + unit));
  }
}

TEST(FileCheck, NamesThePlaceOfAQuantityThatIsNone) {
  TemporaryDirectory const folder;
  put(folder / "experiment.toml", "machine = \"v450\"\nduration = \"8 Stunden\"\n");
  EXPECT_THAT(check_files({folder / "experiment.toml"})[0].mistake,
              HasSubstr("experiment.toml:2:12: 'duration': '8 Stunden': unknown unit 'Stunden'"));
}

TEST(FileCheck, WarnsOfInputsThatNothingReads) {
  TemporaryDirectory const folder;
  put(folder / "air.csv", air);
  put(folder / "good.toml", experiment + recorded("ambient.temperature"));
  put(folder / "typo.toml", experiment + recorded("ambient.temp"));
  put(folder / "oil.toml",
      std::string(experiment) +
          "inputs = [{channel = \"oil.flow\", blocks = [{duration = \"1 h\", value = \"80 %\"}]}]\n");
  put(folder / "mine.toml", machine_with("[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 W\"\n"
                                         "while_on = \"oil.flow\"\n"));
  auto const checks = check_files({folder / "good.toml", folder / "typo.toml", folder / "oil.toml"});
  EXPECT_THAT(checks[0].warnings, SizeIs(0));
  EXPECT_THAT(checks[1].warnings,
              ElementsAre(HasSubstr("typo.toml:5:40: recorded[0].columns[0].channel: nothing on 'v450' reads "
                                    "'ambient.temp'; did you mean 'ambient.temperature'?")));
  EXPECT_THAT(checks[2].warnings, ElementsAre(HasSubstr("oil.toml:3:22: inputs[0].channel: nothing on 'v450' reads "
                                                        "'oil.flow'; known: ")));
  EXPECT_THAT(check_files({folder / "oil.toml", folder / "mine.toml"})[0].warnings, SizeIs(0));
  for (auto const& check : checks) EXPECT_EQ(check.mistake, "");
}

/// Not of switches that go to and fro: so one looks for what the machine's file lacks.
TEST(FileCheck, WarnsOfTablesThatNothingReads) {
  TemporaryDirectory const folder;
  put(folder / "press.toml",
      "name = \"press\"\n[spindle]\nmaximum_speed = \"6000 rpm\"\n[[axis]]\nname = \"x\"\nrapid_feed = \"20 m/min\"\n"
      "lead = \"10 mm\"\nstroke_to = \"500 mm\"\n[[lump]]\nname = \"motor\"\nheat_capacity = \"9 kJ/K\"\n"
      "[[film]]\nname = \"motor\"\non = \"motor\"\narea = \"0.3 m2\"\n");
  auto const warnings = [&](std::string const& table) {
    put(folder / "day.toml", "machine = \"press.toml\"\nduration = \"1 h\"\n" + table);
    auto const check = check_files({folder / "day.toml"})[0];
    EXPECT_EQ(check.mistake, "") << table;
    return check.warnings;
  };
  struct Row {
    std::string table, warning;
  };
  for (auto const& [table, warning] :
       {Row{"[coolant]\non = true\n", "day.toml:4:6: coolant.on: nothing on 'press' reads 'coolant.on'; it changes"},
        Row{"[coolant]\ntemperature = \"18 degC\"\n", "coolant.temperature: nothing on 'press' reads"},
        Row{"[chiller]\noffset = \"2 K\"\n", "chiller.offset: nothing on 'press' reads 'chiller.offset'"},
        Row{"[chiller]\non = false\n", "chiller.on: nothing on 'press' reads"},
        Row{"[power]\non = false\n", "power.on: nothing on 'press' reads 'machine.on'"},
        Row{"[servo]\non = false\n", "day.toml:4:6: servo.on: nothing on 'press' reads 'servo.on'"},
        Row{"[spindle]\nblocks = [{duration = \"1 h\", speed = \"900 rpm\"}]\n",
            "spindle: nothing on 'press' reads 'spindle.…'"},
        Row{"[[axes]]\naxis = \"x\"\nblocks = [{duration = \"1 h\", feed = \"8 m/min\"}]\n",
            "day.toml:4:8: axes[0].axis: nothing on 'press' reads 'x.…'"}})
    EXPECT_THAT(warnings(table), ElementsAre(HasSubstr(warning)));
  EXPECT_THAT(warnings("[coolant]\non = false\n[chiller]\non = true\n[servo]\non = true\n"), SizeIs(0));
  EXPECT_THAT(warnings("[coolant]\ntemperature = \"18 degC\"\nblocks = [{duration = \"30 min\", on = true}]\n"),
              SizeIs(0));
}

/// The stroke of the axis goes from 120 to 720 mm of a screw of 840 mm.
TEST(FileCheck, WarnsOfWhatIsBeyondStrokeAndRun) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& more) {
    put(folder / "experiment.toml", "machine = \"vmc850\"\nduration = \"1 h\"\n" + more);
    return check_files({folder / "experiment.toml"})[0].warnings;
  };
  EXPECT_THAT(warnings("laser.to = \"600 mm\"\n"), SizeIs(0));
  EXPECT_THAT(warnings("laser.to = \"700 mm\"\n"),
              ElementsAre(HasSubstr("experiment.toml:3:12: laser.to: the target 700 mm is outside the stroke of axis "
                                    "'z', 0 mm to 600 mm")));
  EXPECT_THAT(warnings("laser.from = \"-50 mm\"\n"),
              ElementsAre(HasSubstr("experiment.toml:3:14: laser.from: the target -50 mm is outside")));
  EXPECT_THAT(warnings("[ambient]\ndoor_openings = [{time = \"50 min\"}, {time = \"2 h\"}]\n"),
              ElementsAre(HasSubstr("ambient.door_openings[1].time: it opens at 2 h, and the run ends at 1 h")));
}

TEST(FileCheck, RefusesTwoProgrammesOfOneChannel) {
  TemporaryDirectory const folder;
  auto const mistake = [&](std::string const& machine, std::string const& table, std::string const& channel,
                           std::string const& value) {
    put(folder / "experiment.toml", "machine = \"" + machine + "\"\nduration = \"1 h\"\n" + table +
                                        "[[inputs]]\nchannel = \"" + channel +
                                        "\"\nblocks = [{duration = \"1 h\", value = \"" + value + "\"}]\n");
    return check_files({folder / "experiment.toml"})[0].mistake;
  };
  std::string const spindle = "[spindle]\nblocks = [{duration = \"1 h\", speed = \"100 rpm\"}]\n",
                    axis = "[[axes]]\nblocks = [{duration = \"1 h\", feed = \"8 m/min\"}]\n";
  EXPECT_THAT(mistake("v450", spindle, "spindle.speed", "1000 rpm"),
              HasSubstr("experiment.toml:6:11: inputs[0].channel: 'spindle.speed' would stand in place of "
                        "'spindle.blocks', which is written, too; leave out one of them"));
  EXPECT_THAT(mistake("v450", "power.on = false\n", "machine.on", "1"), HasSubstr("in place of 'power.on'"));
  EXPECT_THAT(mistake("v450", "coolant.on = true\n", "coolant.on", "0"), HasSubstr("in place of 'coolant.on'"));
  EXPECT_THAT(mistake("v450", "ambient.mean = \"25 degC\"\n", "ambient.temperature", "20 degC"),
              HasSubstr("in place of 'ambient.mean'"));
  EXPECT_THAT(mistake("vmc850", axis, "z.feed", "2 m/min"), HasSubstr("in place of 'axes.0.blocks'"));
  EXPECT_THAT(mistake("vmc850", axis, "z.speed", "200 rpm"), HasSubstr("in place of 'axes.0.blocks'"));
  EXPECT_EQ(mistake("vmc850", axis, "z.duty", "50 %"), "");
  EXPECT_EQ(mistake("v450", "", "spindle.speed", "1000 rpm"), "");
  EXPECT_EQ(mistake("v450", "ambient.door_openings = [{time = \"5 min\"}]\n", "ambient.temperature", "20 degC"), "");
  put(folder / "speed.csv", "time_s,n\n0,900\n3600,900\n");
  put(folder / "experiment.toml", experiment + spindle +
                                      "[[recorded]]\nfile = \"speed.csv\"\nmax_gap = \"2 h\"\ncolumns = [{column = "
                                      "\"n\", channel = \"spindle.speed\", unit = \"rpm\"}]\n");
  EXPECT_EQ(check_files({folder / "experiment.toml"})[0].mistake, "");  // as documented: in place of programmes
}

TEST(FileCheck, WarnsOfSpectraLongerThanTheRun) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& spindle) {
    put(folder / "experiment.toml", experiment + spindle);
    return check_files({folder / "experiment.toml"})[0].warnings;
  };
  std::string const blocks =
      "[spindle]\nblocks = [{duration = \"20 min\", speed = \"900 rpm\"}, {duration = \"10 min\"}]\n";
  EXPECT_THAT(warnings(blocks + "cycles = 2\n"), SizeIs(0));
  EXPECT_THAT(warnings(blocks + "cycles = 3\n"),
              ElementsAre(HasSubstr("experiment.toml:4:10: spindle.blocks: they last 90 min in all, and the run 1 h; "
                                    "what comes later is left out")));
}

/// A record of rows 10 min apart, the last at 60 min, stands for 10 min more.
TEST(FileCheck, WarnsOfARecordThatEndsBeforeTheRun) {
  TemporaryDirectory const folder;
  put(folder / "air.csv", air);
  auto const warnings = [&](std::string const& duration) {
    put(folder / "experiment.toml", "machine = \"v450\"\nduration = \"" + duration + "\"\n" +
                                        recorded("ambient.temperature") + "max_gap = \"1 h\"\n");
    return check_files({folder / "experiment.toml"})[0].warnings;
  };
  EXPECT_THAT(warnings("1 h"), SizeIs(0));
  EXPECT_THAT(warnings("70 min"), SizeIs(0));
  EXPECT_THAT(warnings("90 min"),
              ElementsAre(HasSubstr("experiment.toml:4:8: recorded[0].file: it ends at 1 h, and the run at 90 min; "
                                    "until then its last values hold")));
}

/// 33 s of a minute at one speed: each row of the data would show it.
TEST(FileCheck, WarnsOfChangesBetweenTwoRows) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& text) {
    put(folder / "experiment.toml", text);
    return check_files({folder / "experiment.toml"})[0].warnings;
  };
  std::string const spindle =
      "machine = \"v450\"\nduration = \"2 h\"\n[spindle]\n"
      "blocks = [{duration = \"33 s\", speed = \"3000 rpm\"}, {duration = \"27 s\"}]\ncycles = 120\n";
  EXPECT_THAT(warnings(spindle),
              ElementsAre(HasSubstr("spindle: 119 of 239 changes are followed by another one before the next row, and "
                                    "the inputs in the data lack them; a `sampling` of 27 s or less shows what was "
                                    "given")));
  EXPECT_THAT(warnings("sampling = \"25 s\"\n" + spindle), SizeIs(0));
  EXPECT_THAT(warnings("machine = \"vmc850\"\nduration = \"1 h\"\n[[axes]]\ncycles = 10\n"
                       "blocks = [{duration = \"20 s\", feed = \"8 m/min\"}, {duration = \"20 s\"}]\n"),
              ElementsAre(HasSubstr("axes[0].blocks: 12 of 19 changes are followed by another one before the next row, "
                                    "and the inputs in the data lack them; a `sampling` of 20 s or less, or one block "
                                    "with a `duty`, shows what was given")));
}

TEST(FileCheck, WarnsOfAnEndOfTheRunWithoutARow) {
  TemporaryDirectory const folder;
  auto const warnings = [&](std::string const& sampling) {
    put(folder / "experiment.toml", "machine = \"v450\"\nduration = \"4 h\"\nsampling = \"" + sampling + "\"\n");
    return check_files({folder / "experiment.toml"})[0].warnings;
  };
  EXPECT_THAT(warnings("8 min"), SizeIs(0));
  EXPECT_THAT(warnings("7 min"),
              ElementsAre(HasSubstr("experiment.toml:3:12: sampling: the last row is at 238 min, and "
                                    "the run ends at 4 h; what comes later is left out")));
}

TEST(FileCheck, LooksAtTheExperimentsOfAStudy) {
  TemporaryDirectory const folder;
  put(folder / "air.csv", air);
  put(folder / "short.toml", experiment + recorded("ambient.temperature"));
  put(folder / "long.toml", "machine = \"v450\"\nduration = \"5 h\"\n" + recorded("ambient.temperature"));
  auto const with = [&](std::string const& test, std::string const& more = "") {
    put(folder / "study.toml",
        "selections = [\"all\"]\nmodels = [\"linear\"]\n[[world]]\nname = \"shop\"\nmachine = \"v450\"\nerror = "
        "\"E_Z\"\ntrain = [\"short.toml\"]\ntest = [\"" +
            test + "\"]\n" + more);
    return check_files({folder / "study.toml"})[0].mistake;
  };
  EXPECT_EQ(with("golden_b_2000"), "");
  EXPECT_THAT(with("long.toml"), HasSubstr("study.toml:8:9: world 'shop': 'long.toml': "));
  EXPECT_THAT(with("long.toml"), HasSubstr("air.csv: covers 0 s to 3600 s of a run of 18000 s"));
  put(folder / "fast.toml",
      std::string(experiment) + "spindle.blocks = [{duration = \"1 h\", speed = \"7000 rpm\"}]\n");
  EXPECT_THAT(with("fast.toml"), HasSubstr("fast.toml:3:46: spindle.blocks[0].speed: 7000 rpm is above the machine's "
                                           "maximum, 6000 rpm"));
  EXPECT_EQ(with("fast.toml", "set = [\"spindle.maximum_speed=8000 rpm\"]\n"), "");
  EXPECT_THAT(with("fast.toml",
                   "add = '''\n[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 W\"\n"
                   "while_on = \"pump.on\"\n'''\nset = [\"spindle.maximum_speed=8000 rpm\"]\n"),
              HasSubstr("the machine needs the input 'pump.on', which the experiment does not give"));
}

TEST(FileCheck, DoubtsTheUnitOfTimeOfAShortRecord) {
  TemporaryDirectory const folder;
  std::string rows = "t,T1\n";
  for (int row = 0; row < 12; ++row) rows += fmt::format("{},{}\n", 3000 * row, 21 + 0.3 * row);
  put(folder / "run.csv", rows);
  auto const checks = [&](std::string const& unit, std::vector<fs::path> files) {
    put(folder / "run.toml", "[[table]]\nfile = \"run.csv\"\ntime_column = \"t\"\ntime_unit = \"" + unit +
                                 "\"\nreading = [{column = \"T1\", sensor = \"T1\", unit = \"degC\"}]\n");
    files.insert(files.begin(), folder / "run.toml");
    return check_files(files)[0];
  };
  auto const doubt = HasSubstr("run.toml: the record lasts 33 s in all; is its unit of time right?");
  EXPECT_THAT(checks("s", {}).warnings, testing::Not(Contains(doubt)));
  EXPECT_THAT(checks("ms", {}).warnings, ElementsAre(doubt));
  EXPECT_THAT(checks("ms", {machine_file("v450")}).warnings, Contains(doubt));
}

TEST(FileCheck, LooksAtRecordAndMachineTogether) {
  TemporaryDirectory const folder;
  std::string rows = "time_s,n,room,T1\n";
  for (int row = 0; row < 12; ++row)
    rows += fmt::format("{},{},{},{}\n", 300 * row, row < 6 ? 3000 : 5000, 20 + 0.1 * row, 21 + 0.3 * row);
  put(folder / "run.csv", rows);
  auto const checks = [&](std::string const& speed) {
    put(folder / "run.toml",
        "[[table]]\nfile = \"run.csv\"\ninput = [{column = \"n\", channel = \"" + speed +
            "\", unit = \"1/min\"}, {column = \"room\", channel = \"ambient.temperature\", unit = \"degC\"}]\n"
            "reading = [{column = \"T1\", sensor = \"T1\", unit = \"degC\"}]\n");
    return check_files({folder / "run.toml", machine_file("v450")});
  };
  auto const right = checks("spindle.speed");
  EXPECT_EQ(right[0].mistake, "");
  EXPECT_EQ(right[0].text,
            "a record of 0.92 h: 12 rows, 2 inputs (spindle.speed changes 1 time), 1 sensor, 0 displacement channels, "
            "on v450");
  EXPECT_THAT(right[0].warnings, Contains(HasSubstr("run.toml: of the machine, but not in the data: T2")));
  auto const wrong = checks("spindel.speed");
  EXPECT_THAT(wrong[0].mistake,
              HasSubstr("run.toml:3:35: nothing on 'v450' reads 'spindel.speed'; did you mean 'spindle.speed'?"));
  EXPECT_EQ(wrong[1].mistake, "");
  auto const alone = check_files({folder / "run.toml"});
  EXPECT_EQ(alone[0].mistake, "");
  EXPECT_THAT(alone[0].warnings,
              Contains(HasSubstr("run.toml:3:35: input 'spindel.speed': did you mean 'spindle.speed'?")));
}

}  // namespace
}  // namespace thermotwin::twin
