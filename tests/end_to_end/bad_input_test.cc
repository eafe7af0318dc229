#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <sstream>

#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"

/// What the program says to wrong input: the message, exit code 2, and that nothing was written or lost.
namespace thermotwin {
namespace {

namespace fs = std::filesystem;

using tests::Answer;

Answer program(std::string const& arguments) {
  return tests::run_command(std::string(THERMOTWIN_PROGRAM) + " " + arguments + " 2>&1");
}

std::string read_text(fs::path const& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text(fs::path const& path, std::string const& text) { std::ofstream(path) << text; }

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
  auto const text = replaced(read_text(source / "twin/machines/v450.toml"), mistake.from, mistake.to);
  write_text(machine, text);
  write_text(dataset, "what the user had");
  auto const answer = program("run golden_b_2000 -m " + machine.string() + " -o " + dataset.string());
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find(mistake.message), std::string::npos) << answer.text;
  auto const place = place_in("machine.toml", text, mistake.marker.empty() ? mistake.to : mistake.marker);
  EXPECT_NE(answer.text.find(place), std::string::npos) << place << " is not in " << answer.text;
  EXPECT_TRUE(read_text(dataset) == "what the user had");
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
        Mistake{"NotANumber", "mass = \"70 kg\"", "mass = nan", "", "must be finite"},
        Mistake{"TextForNumber", "cells = 8", "cells = \"eight\"", "", "a whole number without unit is due"},
        Mistake{"UnknownBody", "from = \"front_ring\"", "from = \"frnt_ring\"", "",
                "unknown body 'frnt_ring'; did you mean 'front_ring'?"},
        Mistake{"UnknownMaterial", "material = \"casting\"", "material = \"castin\"", "",
                "unknown material 'castin'; did you mean 'casting'?"},
        Mistake{"DuplicateBody", "name = \"rear_ring\"", "name = \"front_ring\"  # again", "front_ring\"  # again",
                "the name 'front_ring' is taken"},
        Mistake{"DuplicateJoint", "name = \"rear_seat\"", "name = \"front_seat\"  # again", "front_seat\"  # again",
                "the name 'front_seat' is taken"},
        Mistake{"NoPath", "from = \"motor\"\nto = \"rotor\"", "from = \"motor\"\nto = \"motor\"", "name = \"rotor\"",
                "the body 'rotor' has no path"},
        Mistake{"NegativeConductance", "conductance = \"18 W/K\"", "conductance = \"-18 W/K\"", "",
                "must not be negative"},
        Mistake{"SensorOutside", "at = \"cartridge[130 mm]\"", "at = \"cartridge[330 mm]\"", "",
                "330 mm is outside 'cartridge', which is 320 mm long"},
        Mistake{"LoopNotClosed", "closure = \"-10 mm\"", "closure = \"0 mm\"", "[[displacement]]\nname = \"E_Z\"",
                "does not close"},
        Mistake{"Syntax", "name = \"v450\"", "name = \"v450", "", "string"}),
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
  write_text(directory.path() / "experiment.toml", good_experiment);
  write_text(directory.path() / "air.csv", "time_s,air_C\n0,20\n300,21\n600,22\n");
  auto const answer = program("run -q " + (directory.path() / "experiment.toml").string());
  EXPECT_EQ(answer.code, 0) << answer.text;
}

TEST_P(WrongExperiment, IsToldWithPlace) {
  auto const& mistake = GetParam();
  tests::TemporaryDirectory const directory;
  auto const text = replaced(good_experiment, mistake.from, mistake.to);
  write_text(directory.path() / "experiment.toml", text);
  write_text(directory.path() / "air.csv", "time_s,air_C\n0,20\n300,21\n600,22\n");
  auto const answer = program("run " + (directory.path() / "experiment.toml").string() + " -o " +
                              (directory.path() / "run.h5").string());
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find(mistake.message), std::string::npos) << answer.text;
  auto const place = place_in("experiment.toml", text, mistake.marker.empty() ? mistake.to : mistake.marker);
  EXPECT_NE(answer.text.find(place), std::string::npos) << place << " is not in " << answer.text;
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), {}), 2) << "something was left behind";
}

INSTANTIATE_TEST_SUITE_P(BadInput, WrongExperiment,
                         testing::Values(Mistake{"EmptySpectrum",
                                                 "blocks = [{duration = \"10 min\", speed = \"2000 rpm\"}]",
                                                 "blocks = []", "[spindle]", "the spectrum is empty"},
                                         Mistake{"TooFast", "2000 rpm", "20000 rpm", "", "20000 rpm"},
                                         Mistake{"NoDuration", "duration = \"10 min\"\n", "", "machine", "duration"},
                                         Mistake{"UnknownKey", "duration = \"10 min\"\n", "duraton = \"10 min\"\n", "",
                                                 "did you mean 'duration'?"}),
                         [](auto const& info) { return info.param.name; });

struct WrongRecording {
  std::string name, csv, place, message;
};
void PrintTo(WrongRecording const& recording, std::ostream* out) { *out << recording.name; }

class Recording : public testing::TestWithParam<WrongRecording> {};

TEST_P(Recording, IsToldWithFileLineAndColumn) {
  tests::TemporaryDirectory const directory;
  write_text(directory.path() / "experiment.toml", good_experiment);
  write_text(directory.path() / "air.csv", GetParam().csv);
  auto const answer = program("run " + (directory.path() / "experiment.toml").string() + " -o " +
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
        Row{"effects bering", "did you mean 'bearing'?"}, Row{"describe machin", "machine"},
        Row{"rum", "Run with --help"}}) {
    auto const answer = program(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find(message), std::string::npos) << answer.text;
  }
}

TEST(BadInput, OutputsThatCannotBeWritten) {
  for (std::string const target : {"/nonexistent/run.h5", "/proc/run.h5"}) {
    auto const answer = program("run -q golden_b_2000 -m v450 -o " + target);
    EXPECT_EQ(answer.code, 2);
    EXPECT_NE(answer.text.find("cannot write '" + target), std::string::npos) << answer.text;
  }
}

TEST(BadInput, FullDiskLeavesTheOldFile) {
  tests::TemporaryDirectory const directory;
  fs::path const dataset = directory.path() / "run.h5";
  write_text(dataset, "what the user had");
  std::string const command = "sh -c 'ulimit -f 64; trap \"\" XFSZ; " + std::string(THERMOTWIN_PROGRAM) +
                              " run -q golden_b_2000 -m v450 -o " + dataset.string() + "' 2>&1";
  auto const [code, text] = tests::run_command(command);
  EXPECT_EQ(code, 2) << text;
  EXPECT_NE(text.find("cannot write"), std::string::npos) << text;
  EXPECT_TRUE(read_text(dataset) == "what the user had");
}

TEST(BadInput, DataSetsThatAreNone) {
  tests::TemporaryDirectory const directory;
  fs::path const good = directory.path() / "good.h5", cut = directory.path() / "cut.h5",
                 csv = directory.path() / "out.csv";
  ASSERT_EQ(program("run -q golden_b_2000 -m v450 -o " + good.string()).code, 0);
  auto const bytes = read_text(good);
  write_text(cut, bytes.substr(0, bytes.size() / 2));
  write_text(directory.path() / "text.h5", "not a data set");
  for (std::string const name : {"cut.h5", "text.h5", "absent.h5"}) {
    auto const answer = program("export " + (directory.path() / name).string() + " -o " + csv.string());
    EXPECT_EQ(answer.code, 2) << name;
    EXPECT_NE(answer.text.find(name), std::string::npos) << answer.text;
    EXPECT_FALSE(fs::exists(csv));
  }
}

}  // namespace
}  // namespace thermotwin
