#include <filesystem>
#include <gtest/gtest.h>
#include <map>

#include "tests/end_to_end/earlier_run.h"
#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"

/// What the program says to wrong input: the message, exit code 2, and that nothing was written or lost.
namespace thermotwin {
namespace {

namespace fs = std::filesystem;

using tests::Answer;
using tests::run_program;

std::string replaced(std::string text, std::string const& from, std::string const& to) {
  auto const at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

fs::path const source = THERMOTWIN_SOURCE_DIR;

/// "name:12:" for the line of a text's first occurrence.
std::string place_in(std::string const& name, std::string const& text, std::string const& marker) {
  auto const at = text.find(marker);
  EXPECT_NE(at, std::string::npos) << marker;
  return name + ":" + std::to_string(1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n')) + ":";
}

/// One mistake in a file that is right otherwise.
struct Mistake {
  std::string name, from, to;
  std::string marker;   ///< text in whose line the mistake is told; empty: that of `to`
  std::string message;  ///< that must be part of the answer
};

void PrintTo(Mistake const& mistake, std::ostream* out) { *out << mistake.name; }

class WrongMachine : public testing::TestWithParam<Mistake> {};

TEST_P(WrongMachine, IsToldWithPlaceAndNothingWritten) {
  auto const& mistake = GetParam();
  tests::TemporaryDirectory const directory;
  fs::path const machine = directory.path() / "machine.toml", dataset = directory.path() / "run.h5";
  auto const text = replaced(tests::contents(source / "twin/machines/v450.toml"), mistake.from, mistake.to);
  tests::put(machine, text);
  tests::put_earlier_run(dataset);
  auto const before = tests::contents(dataset);
  auto const answer = run_program("run golden_b_2000 -m " + machine.string() + " -o " + dataset.string());
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find(mistake.message), std::string::npos) << answer.text;
  auto const place = place_in("machine.toml", text, mistake.marker.empty() ? mistake.to : mistake.marker);
  EXPECT_NE(answer.text.find(place), std::string::npos) << place << " is not in " << answer.text;
  EXPECT_TRUE(tests::contents(dataset) == before);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), {}), 2) << "something was left behind";
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, WrongMachine,
    testing::Values(
        Mistake{"UnknownKey", "outer_diameter = \"40 mm\"", "outer_diametre = \"40 mm\"", "",
                "unknown key 'outer_diametre'; did you mean 'outer_diameter'?"},
        Mistake{"UnknownTable", "[[bearing]]", "[[bearng]]", "", "unknown key 'bearng'; did you mean 'bearing'?"},
        Mistake{"MissingKey", "mass = \"26 kg\"\n", "", "[[lump]]\nname = \"motor\"", "needs a mass"},
        Mistake{"MissingUnit", "mass = \"70 kg\"", "mass = 70", "", "70 has no unit; write for example \"14 kg\""},
        Mistake{"WrongDimension", "mass = \"70 kg\"", "mass = \"70 W\"", "", "'70 W' is a power; a mass is due"},
        Mistake{"UnknownUnit", "length = \"200 mm\"", "length = \"200 mn\"", "",
                "unknown unit 'mn'; did you mean 'mm'?"},
        Mistake{"Negative", "mass = \"70 kg\"", "mass = \"-70 kg\"", "", "must not be negative"},
        Mistake{"Zero", "base = \"450 mm\"", "base = \"0 mm\"", "", "'base' is \"0 mm\"; it must be positive"},
        Mistake{"NoDiameter", "pitch_diameter = \"90 mm\"", "pitch_diameter = \"0 mm\"", "",
                "'pitch_diameter' is \"0 mm\"; it must be positive (plausible: 5 mm to 1 m)"},
        Mistake{"ShareAboveOne", "oil = 22\n", "oil = 22\ninner_share = 1.5\n", "inner_share = 1.5",
                "'inner_share' is 1.5; it must be at most 1 (plausible: 0 to 1)"},
        Mistake{"MoreThanAllHeat", "loss = \"45 W\"", "loss = \"45 W\"\npulley_share = 0.8", "pulley_share",
                "'pulley_share' 0.8 and 'motor_share' 0.325 are 1.125 of the heat; allowed is 1 in all"},
        Mistake{"ContradictoryKeys", "conductance = \"18 W/K\"",
                "conductance = \"18 W/K\"\ncoefficient = \"801 W/(m2 K)\"", "coefficient = \"801 W/(m2 K)\"",
                "give either 'conductance' or 'coefficient', not both"},
        Mistake{"NoSpeed", "maximum_speed = \"6000 rpm\"", "maximum_speed = \"0 rpm\"", "",
                "'maximum_speed' is \"0 rpm\"; it must be positive; a machine without a spindle has no [spindle]"},
        Mistake{"NoName", "name = \"v450\"", "name = \"\"  # none", "", "'' cannot be the name of a machine"},
        Mistake{"NameOfAFolder", "name = \"v450\"", "name = \"shop/v450\"", "",
                "'shop/v450' cannot be the name of a machine: files are called by it"},
        Mistake{"UnknownInput", "name = \"stator\"", "name = \"stator\"\nwhile_on = \"machin.on\"",
                "while_on = \"machin.on\"",
                "the machine needs the input 'machin.on', which the experiment does not give; did you mean "
                "'machine.on'?"},
        Mistake{"ListForTable", "[spindle]", "[[spindle]]", "", "here one table is due"},
        Mistake{"NotANumber", "mass = \"70 kg\"", "mass = nan", "", "must be finite"},
        Mistake{"TextForNumber", "cells = 8", "cells = \"eight\"", "", "a whole number without unit is due"},
        Mistake{"UnknownBody", "from = \"front_ring\"", "from = \"frnt_ring\"", "",
                "unknown body 'frnt_ring'; did you mean 'front_ring'?"},
        Mistake{"UnknownMaterial", "material = \"casting\"", "material = \"castin\"", "",
                "unknown material 'castin'; did you mean 'casting'?"},
        Mistake{"MaterialInAnotherLanguage", "material = \"casting\"", "material = \"Grauguss\"", "",
                "'GJL-250' (grey cast iron)"},
        Mistake{"SensorInNoBody", "at = \"ambient\"", "at = \"room\"", "", ", 'ambient', "},
        Mistake{"DuplicateBody", "name = \"rear_ring\"", "name = \"front_ring\"  # again", "front_ring\"  # again",
                "the name 'front_ring' is taken"},
        Mistake{"DuplicateJoint", "name = \"rear_seat\"", "name = \"front_seat\"  # again", "front_seat\"  # again",
                "the name 'front_seat' is taken"},
        Mistake{"NoPath", "from = \"motor\"\nto = \"rotor\"", "from = \"motor\"\nto = \"bed\"", "name = \"rotor\"",
                "the body 'rotor' has no path"},
        Mistake{"OneEnd", "from = \"motor\"\nto = \"rotor\"", "from = \"motor\"\nto = \"motor\"", "",
                "'motor' and 'motor' share a cell"},
        Mistake{"DecimalComma", "mass = \"70 kg\"", "mass = \"70,5 kg\"", "", "decimals follow a point: \"70.5 kg\""},
        Mistake{"NegativeConductance", "conductance = \"18 W/K\"", "conductance = \"-18 W/K\"", "",
                "must not be negative"},
        Mistake{"SensorOutside", "at = \"cartridge[130 mm]\"", "at = \"cartridge[330 mm]\"", "",
                "330 mm is outside 'cartridge', which is 320 mm long"},
        Mistake{"LengthIsRounded", "at = \"cartridge[130 mm]\"", "at = \"shaft[500 mm]\"", "",
                "500 mm is outside 'shaft', which is 420 mm long"},
        Mistake{"LoopNotClosed", "closure = \"-10 mm\"", "closure = \"0 mm\"", "[[displacement]]\nname = \"E_Z\"",
                "does not close"},
        Mistake{"EmptyRange", "[spindle]",
                "[[uncertain]]\nname = \"joint.head.conductance\"\nfrom = \"12 W/K\"\nto = \"5 W/K\"\n[spindle]",
                "from = \"12 W/K\"", "the range from '12 W/K' to '5 W/K' is empty"},
        Mistake{"RangeOfNothing", "[spindle]",
                "[[uncertain]]\nname = \"joint.haed.conductance\"\nfrom = \"5 W/K\"\nto = \"12 W/K\"\n[spindle]",
                "name = \"joint.haed", "'head'"},
        Mistake{"OutsideItsRange", "[spindle]",
                "[[uncertain]]\nname = \"joint.head.conductance\"\nfrom = \"8 W/K\"\nto = \"12 W/K\"\n[spindle]",
                "from = \"8 W/K\"", "outside its range from '8 W/K' to '12 W/K'"},
        Mistake{"Syntax", "name = \"v450\"", "name = \"v450", "", "is a quote missing at the end of the line?"}),
    [](auto const& info) { return info.param.name; });

class WrongExperiment : public testing::TestWithParam<Mistake> {};

constexpr char const* good_experiment =
    "machine = \"v450\"\n"
    "duration = \"10 min\"\n"
    "[spindle]\n"
    "blocks = [{duration = \"10 min\", speed = \"2000 rpm\"}]\n"
    "[[recorded]]\n"
    "file = \"air.csv\"\n"
    "time_column = \"time_s\"\n"
    "max_gap = \"5 min\"\n"
    "columns = [{column = \"air_C\", channel = \"ambient.temperature\", unit = \"degC\"}]\n";

TEST(BadInput, TheGoodExperimentRuns) {
  tests::TemporaryDirectory const directory;
  tests::put(directory.path() / "experiment.toml", good_experiment);
  tests::put(directory.path() / "air.csv", "time_s,air_C\n0,20\n300,21\n600,22\n");
  auto const answer = run_program("run -q " + (directory.path() / "experiment.toml").string());
  EXPECT_EQ(answer.code, 0) << answer.text;
}

/// The good experiment, changed, through `run` with these options.
Answer run_of_experiment(std::string const& from, std::string const& to, std::string const& options) {
  tests::TemporaryDirectory const directory;
  tests::put(directory.path() / "experiment.toml", replaced(good_experiment, from, to));
  tests::put(directory.path() / "air.csv", "time_s,air_C\n0,20\n300,21\n600,22\n");
  return run_program("run " + (directory.path() / "experiment.toml").string() + " " + options);
}

TEST(BadInput, ASettingThatWouldChangeNothing) {
  auto const answer = run_of_experiment("v450", "v450", "--set 'experiment.ambient.mean=30 degC'");
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("parameter 'experiment.ambient.mean' would change nothing"), std::string::npos)
      << answer.text;
}

TEST(BadInput, WhatIsOddIsToldAndRun) {
  for (auto const& [from, to, message] :
       {std::tuple{"ambient.temperature", "ambient.temp",
                   "experiment.toml:9:41: recorded[0].columns[0].channel: nothing on 'v450' reads 'ambient.temp'; did "
                   "you mean 'ambient.temperature'?\n"},
        std::tuple{
            "blocks = [{duration = \"10 min\"", "blocks = [{duration = \"8 h\"",
            "experiment.toml:4:10: spindle.blocks: they last 8 h in all, and the run 10 min; what comes later is "
            "left out\n"}}) {
    auto const answer = run_of_experiment(from, to, "");
    EXPECT_EQ(answer.code, 0) << answer.text;
    EXPECT_NE(answer.text.find(message), std::string::npos) << answer.text;
    EXPECT_EQ(run_of_experiment(from, to, "-q").text, "");
  }
}

TEST_P(WrongExperiment, IsToldWithPlace) {
  auto const& mistake = GetParam();
  tests::TemporaryDirectory const directory;
  auto const text = replaced(good_experiment, mistake.from, mistake.to);
  tests::put(directory.path() / "experiment.toml", text);
  tests::put(directory.path() / "air.csv", "time_s,air_C\n0,20\n300,21\n600,22\n");
  auto const answer = run_program("run " + (directory.path() / "experiment.toml").string() + " -o " +
                                  (directory.path() / "run.h5").string());
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find(mistake.message), std::string::npos) << answer.text;
  auto const place = place_in("experiment.toml", text, mistake.marker.empty() ? mistake.to : mistake.marker);
  EXPECT_NE(answer.text.find(place), std::string::npos) << place << " is not in " << answer.text;
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), {}), 2) << "something was left behind";
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, WrongExperiment,
    testing::Values(
        Mistake{"CoolRoom", "duration = \"10 min\"\n[spindle]\n",
                "duration = \"10 min\"\nambient.mean = \"22 K\"\n[spindle]\n", "ambient.mean",
                "'22 K' is -251.15 degC; allowed is -50 degC to 80 degC"},
        Mistake{"FrozenRoom", "duration = \"10 min\"\n[spindle]\n",
                "duration = \"10 min\"\nambient.mean = \"-55 degC\"\n[spindle]\n", "ambient.mean",
                "-55 degC; allowed is -50 degC to 80 degC"},
        Mistake{"ColdStart", "duration = \"10 min\"\n", "duration = \"10 min\"\ninitial_temperature = \"22 K\"\n",
                "initial_temperature", "'22 K' is -251.15 degC; allowed is -60 degC"},
        Mistake{"ColdCoolant", "duration = \"10 min\"\n", "duration = \"10 min\"\ncoolant.temperature = \"22 K\"\n",
                "coolant.temperature", "'22 K' is -251.15 degC; allowed is -60 degC"},
        Mistake{"ColdProgramme", "[[recorded]]",
                "[[inputs]]\nchannel = \"coolant.temperature\"\n"
                "blocks = [{duration = \"1 h\", value = \"22 K\"}]\n[[recorded]]",
                "blocks = [{duration = \"1 h\"", "allowed is -60 degC to 150 degC"},
        Mistake{"ColdRecord", "unit = \"degC\"", "unit = \"K\"", "",
                "allowed is -50 degC to 80 degC; is its unit right?"},
        Mistake{"SwitchThatIsMoreThanOn", "[[recorded]]",
                "[[inputs]]\nchannel = \"machine.on\"\nblocks = [{duration = \"1 h\", value = \"5\"}]\n[[recorded]]",
                "blocks = [{duration = \"1 h\"", "programme reaches 5; allowed is 0 (off) to 1 (on)"},
        Mistake{"TwoDriversOfOneChannel", "[[recorded]]",
                "[[inputs]]\nchannel = \"ambient.temperature\"\n"
                "blocks = [{duration = \"1 h\", value = \"22 degC\"}]\n[[recorded]]",
                "column = \"air_C\"", "channel 'ambient.temperature' is driven twice"},
        Mistake{"LengthForASpeed", "[spindle]\nblocks = [{duration = \"10 min\", speed = \"2000 rpm\"}]\n",
                "[[inputs]]\nchannel = \"spindle.speed\"\nblocks = [{duration = \"1 h\", value = \"5 m\"}]\n",
                "blocks = [{duration = \"1 h\"", "programme is in m, the channel in rad/s, for example \"6000 rpm\""},
        Mistake{"ProgrammeOfTwoKinds", "[[recorded]]",
                "[[inputs]]\nchannel = \"pump.on\"\nblocks = [{duration = \"1 h\", value = \"1 rmp\"}]\n[[recorded]]",
                "1 rmp", "inputs[0].blocks[0].value: '1 rmp': unknown unit"},
        Mistake{"TwoProgrammes", "[[recorded]]",
                "[[inputs]]\nchannel = \"spindle.speed\"\n"
                "blocks = [{duration = \"1 h\", value = \"1000 rpm\"}]\n[[recorded]]",
                "channel = \"spindle.speed\"", "'spindle.speed' would stand in place of 'spindle.blocks'"},
        Mistake{"FallingShares", "blocks = [{duration = \"10 min\", speed = \"2000 rpm\"}]",
                "random = {run = \"10 min\", lowest = 0.8, highest = 0.2}", "", "highest: 0.2 is below lowest, 0.8"},
        Mistake{"OffsetOnTheScale", "unit = \"degC\"}", "unit = \"degC\", offset = \"10 rpm\"}", "",
                "recorded[0].columns[0].offset: column 'air_C': "},
        Mistake{"NoColumns", "columns = [{column = \"air_C\", channel = \"ambient.temperature\", unit = \"degC\"}]",
                "columns = []", "", "recorded[0].columns: it is empty"},
        Mistake{"EmptySpectrum", "blocks = [{duration = \"10 min\", speed = \"2000 rpm\"}]", "blocks = []", "[spindle]",
                "the spectrum is empty"},
        Mistake{"TooFast", "2000 rpm", "20000 rpm", "", "20000 rpm"},
        Mistake{"TooFastPerMinute", "2000 rpm", "20000 1/min", "",
                "20000 rpm is above the machine's maximum, 6000 rpm"},
        Mistake{"NoDuration", "duration = \"10 min\"\n", "", "machine", "duration"},
        Mistake{"UnknownKey", "duration = \"10 min\"\n", "duraton = \"10 min\"\n", "", "did you mean 'duration'?"}),
    [](auto const& info) { return info.param.name; });

struct WrongRecording {
  std::string name, csv, place, message;
};
void PrintTo(WrongRecording const& recording, std::ostream* out) { *out << recording.name; }

class Recording : public testing::TestWithParam<WrongRecording> {};

TEST_P(Recording, IsToldWithFileLineAndColumn) {
  tests::TemporaryDirectory const directory;
  tests::put(directory.path() / "experiment.toml", good_experiment);
  tests::put(directory.path() / "air.csv", GetParam().csv);
  auto const answer = run_program("run " + (directory.path() / "experiment.toml").string() + " -o " +
                                  (directory.path() / "run.h5").string());
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find(GetParam().message), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("air.csv:" + GetParam().place), std::string::npos) << answer.text;
  EXPECT_FALSE(fs::exists(directory.path() / "run.h5"));
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, Recording,
    testing::Values(WrongRecording{"TimeBackwards", "time_s,air_C\n0,20\n300,21\n200,22\n600,22\n", "4", "200"},
                    WrongRecording{"MissingColumn", "time_s,air\n0,20\n600,22\n", "1:1",
                                   "no column 'air_C'; known: 'air'"},
                    WrongRecording{"Gap", "time_s,air_C\n0,20\n100,21\n600,22\n", "4", "gap"},
                    WrongRecording{"NotANumber", "time_s,air_C\n0,20\n300,nan\n600,22\n", "3", "nan"},
                    WrongRecording{"Text", "time_s,air_C\n0,20\n300,warm\n600,22\n", "3", "warm"}),
    [](auto const& info) { return info.param.name; });

TEST(BadInput, NamesThatDoNotExist) {
  struct Row {
    std::string arguments, message;
  };
  for (auto const& [arguments, message] :
       {Row{"run spindle_standrd", "did you mean 'spindle_standard'?"},
        Row{"run golden_b_2000 -m v405", "did you mean 'v450'?"},
        Row{"run golden_b_2000 -m v450 --set bearing.frnt.grease_factor=0.8", "did you mean 'front'?"},
        Row{"run golden_b_2000 -m v450 --set bearing.front.grease_fctor=0.8", "did you mean 'grease_factor'?"},
        Row{"run golden_b_2000 -m v450 --set bearing.front.grease_factor", "path=value"},
        Row{"run golden_b_2000 --set experiment.seed=2 --set experiment.seed=3",
            "parameter 'experiment.seed' is set twice"},
        Row{"volumetric mill200 --set volumetric.drawn.seed=2 --set volumetric.drawn.seed=3",
            "parameter 'volumetric.drawn.seed' is set twice"},
        Row{"run golden_b_2000 -m v450 --set experiment.duratoin=1h",
            "parameter experiment.duratoin: unknown key 'duratoin'; did you mean 'duration'?"},
        Row{"run golden_b_2000 -m v450 --set ambient.mean=22degC", "did you mean 'experiment.ambient.mean'?"},
        Row{"run golden_b_2000 -m v450 --fieldz x", "run: unknown option '--fieldz'; did you mean '--fields'?"},
        Row{"run golden_b_2000 --tolernce=1e-5", "run: unknown option '--tolernce'; did you mean '--tolerance'?"},
        Row{"run golden_b_2000 v450", "run: 'v450' is an argument too many"},
        Row{"diagnose v450 a.h5 --without radiation,hot_neighbor", "did you mean 'hot_neighbour'?"},
        Row{"diagnose v450 a.h5 --without 'radiation, hot_neighbor'", "'hot_neighbor'; did you mean 'hot_neighbour'?"},
        Row{"fit a.h5 --sensors 'T1, T2,T1' -o m.toml", "--sensors: 'T1' is given twice"},
        Row{"effects bering", "did you mean 'bearing'?"},
        Row{"describe machin", "machine"},
        Row{"describe studdy", "did you mean 'study'?"},
        Row{"describe film", "describe: there is no 'film'; it is an effect: thermotwin effects film"},
        Row{"describe ball_screw", "'ball_screw'; it is a table of a machine: thermotwin describe machine"},
        Row{"describe duration", "'duration'; it is a key of experiment: thermotwin describe experiment"},
        Row{"rnu", "unknown command 'rnu'; did you mean 'run'?"}}) {
    auto const answer = run_program(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find(message), std::string::npos) << answer.text;
  }
}

/// A file that is right, where one of another kind is due.
TEST(BadInput, FilesOfAnotherKind) {
  tests::TemporaryDirectory const directory;
  auto const machine = (source / "twin/machines/v450.toml").string(),
             experiment = (source / "scenarios/catalogue/golden_b_2000.toml").string();
  for (auto const& [arguments, message] : std::map<std::string, std::string>{
           {"report " + machine + " -o x.html", "v450.toml: is a machine file; a measurement file is due"},
           {"report " + experiment + " -o x.html", "golden_b_2000.toml: is an experiment; a measurement file is due"},
           {"diagnose v450 " + machine, "v450.toml: is a machine file; a measurement file is due"},
           {"diagnose v450 a.h5 --hold-out " + machine, "v450.toml: is a machine file; a measurement file is due"},
           {"calibrate v450 " + experiment, "golden_b_2000.toml: is an experiment; a measurement file is due"},
           {"fit " + machine + " --error E_Z -o m.toml", "v450.toml: is a machine file; a measurement file is due"},
           {"run " + machine, "v450.toml: is a machine file; an experiment is due"},
           {"run golden_b_2000 -m " + experiment, "golden_b_2000.toml: is an experiment; a machine file is due"},
           {"campaign " + experiment + " -o x", "golden_b_2000.toml: is an experiment; a campaign is due"}}) {
    auto const answer = tests::run_command("cd " + directory.path().string() + " && " +
                                           std::string(THERMOTWIN_PROGRAM) + " " + arguments + " 2>&1");
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find(message), std::string::npos) << arguments << "\n" << answer.text;
  }
  EXPECT_TRUE(fs::is_empty(directory.path()));
}

TEST(BadInput, AnswersThatWereCut) {
  tests::TemporaryDirectory const directory;
  tests::put(directory / "cut.json", "{\"verdict\": {\n  \"found\": [");
  for (std::string const command : {"report", "figure"}) {
    auto const answer =
        run_program(command + " " + (directory / "cut.json").string() + (command == "report" ? " -o x.html" : ""));
    EXPECT_EQ(answer.code, 2) << command;
    EXPECT_NE(answer.text.find("cut.json: damaged at line 2, column 13: not JSON"), std::string::npos) << answer.text;
  }
}

/// A file or a folder of the same name does not stand in for a machine that is shipped.
TEST(BadInput, ANameIsTheShippedMachine) {
  tests::TemporaryDirectory const directory;
  tests::put(directory.path() / "v450", "no machine");
  fs::create_directory(directory.path() / "golden_b_2000");
  auto const run = [&](std::string const& machine) {
    return tests::run_command("cd " + directory.path().string() + " && " + std::string(THERMOTWIN_PROGRAM) +
                              " run -q golden_b_2000 -m " + machine + " 2>&1");
  };
  EXPECT_EQ(run("v450").code, 0) << run("v450").text;
  EXPECT_EQ(run("./v450").code, 2);
}

TEST(BadInput, CheckGoesOnWithTheNextFile) {
  tests::TemporaryDirectory const directory;
  fs::path const empty = directory.path() / "empty.toml";
  tests::put(empty, "");
  auto const answer = run_program("check " + empty.string() + " " + (source / "twin/machines/v450.toml").string());
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("empty.toml: the file is empty"), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("no mistake found"), std::string::npos) << answer.text;
}

TEST(BadInput, FullDiskLeavesTheOldFile) {
  tests::TemporaryDirectory const directory;
  fs::path const dataset = directory.path() / "run.h5";
  tests::put_earlier_run(dataset);
  auto const before = tests::contents(dataset);
  std::string const command = "sh -c 'ulimit -f 64; trap \"\" XFSZ; " + std::string(THERMOTWIN_PROGRAM) +
                              " run -q golden_b_2000 -m v450 -o " + dataset.string() + "' 2>&1";
  auto const [code, text] = tests::run_command(command);
  EXPECT_EQ(code, 2) << text;
  EXPECT_NE(text.find("cannot write"), std::string::npos) << text;
  EXPECT_TRUE(tests::contents(dataset) == before);
}

TEST(BadInput, DataSetsThatAreNone) {
  tests::TemporaryDirectory const directory;
  fs::path const good = directory.path() / "good.h5", cut = directory.path() / "cut.h5",
                 csv = directory.path() / "out.csv";
  ASSERT_EQ(run_program("run -q golden_b_2000 -m v450 -o " + good.string()).code, 0);
  auto const bytes = tests::contents(good);
  tests::put(cut, bytes.substr(0, bytes.size() / 2));
  tests::put(directory.path() / "text.h5", "not a data set");
  for (std::string const name : {"cut.h5", "text.h5", "absent.h5"}) {
    auto const answer = run_program("export " + (directory.path() / name).string() + " -o " + csv.string());
    EXPECT_EQ(answer.code, 2) << name;
    EXPECT_NE(answer.text.find(name), std::string::npos) << answer.text;
    EXPECT_FALSE(fs::exists(csv));
  }
}

}  // namespace
}  // namespace thermotwin
