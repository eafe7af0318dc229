#include "scenarios/recorded.h"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "scenarios/sampled.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"

namespace thermotwin::scenarios {
namespace {

class RecordedInput : public testing::Test {
 protected:
  /// A recording of `text` with one column `a` for the channel "heater.duty".
  Recording recording(std::string const& text, std::string const& unit = "1") {
    tests::put(directory_ / "data.csv", text);
    Recording result;
    result.file = "data.csv";
    result.columns = {{"a", "heater.duty", unit, "linear"}};
    return result;
  }

  std::vector<DrivenChannel> read(Recording const& recording, double duration) {
    return read_recordings({recording}, directory_.path(), duration);
  }

  std::string refused(Recording const& recording, double duration = 20.0) {
    std::string message = tests::refusal([&] { read(recording, duration); });
    std::string const folder = directory_.path().string() + "/";
    return message.starts_with(folder) ? message.substr(folder.size()) : message;
  }

  tests::TemporaryDirectory directory_;
};

TEST_F(RecordedInput, IsInSIWithTheChannelsName) {
  auto const channels = read(recording("time_s,a\n0,0\n20,50\n", "%"), 20.0);
  ASSERT_EQ(channels.size(), 1U);
  EXPECT_EQ(channels[0].channel.name, "heater.duty");
  EXPECT_EQ(channels[0].channel.unit, "1");
  EXPECT_DOUBLE_EQ(channels[0].signal.at(10.0), 0.25);
}

TEST_F(RecordedInput, InDegreesBecomesKelvin) {
  auto const channels = read(recording("time_s,a\n0,20\n20,22\n", "degC"), 20.0);
  EXPECT_EQ(channels[0].channel.unit, "K");
  EXPECT_DOUBLE_EQ(channels[0].signal.at(10.0), 294.15);
}

TEST_F(RecordedInput, HoldsItsValueWhereItIsStepped) {
  Recording stepped = recording("time_s,a\n0,1\n10,2\n20,2\n");
  stepped.columns[0].interpolation = "step";
  Signal const signal = read(stepped, 20.0)[0].signal;
  EXPECT_EQ(signal.at(9.9), 1.0);
  EXPECT_EQ(signal.at(10.0), 2.0);
  EXPECT_EQ(signal.jumps(), (std::vector<double>{10.0}));
}

TEST_F(RecordedInput, IsReadAsThatOfAMeasurementIs) {
  std::string text = "time_s,n,room\n";
  for (int i = 0; i <= 60; ++i)
    text += std::to_string(10 * i) + "," + std::to_string((i < 30 ? 1000.0 : 3000.0) + 7.0 * std::sin(i * i)) + "," +
            std::to_string(20.0 + 0.1 * std::cos(i * i)) + "\n";
  Recording logged = recording(text);
  logged.columns = {{"n", "spindle.speed", "rpm"}, {"room", "ambient.temperature", "degC"}};
  auto const table = read_tables({logged}, directory_.path(), 600.0).at(0);
  auto const channels = read(logged, 600.0);
  EXPECT_EQ(channels[0].signal.jumps(), (std::vector<double>{300.0}));  // noise apart
  EXPECT_LT(std::abs(channels[1].signal.at(305.0) - 293.15), 0.05);
  EXPECT_TRUE(channels[1].absolute_temperature);
  for (std::size_t c = 0; c < 2; ++c) {
    Signal const measured = driven_channel(sampled_input(logged.columns[c], table.times, table.columns[c])).signal;
    EXPECT_EQ(channels[c].signal.times(), measured.times()) << c;
    EXPECT_EQ(channels[c].signal.values(), measured.values()) << c;
  }
}

/// A speed that is written down where it changes is held until the next row.
TEST_F(RecordedInput, HoldsAListOfSpeeds) {
  Recording list = recording("time_s,a\n0,0\n1800,3000\n12000,0\n14400,0\n", "rpm");
  list.columns[0].channel = "spindle.speed";
  list.columns[0].interpolation = RecordedColumn().interpolation;
  list.max_gap = 14400.0;
  Signal const speed = read(list, 14400.0)[0].signal;
  EXPECT_EQ(speed.jumps(), (std::vector<double>{1800.0, 12000.0}));
  EXPECT_DOUBLE_EQ(speed.integral(14400.0), 10200.0 * thermal::from_unit(3000.0, "rpm"));
}

/// Per cent of 5000 rpm, and a sensor of the room that shows half a kelvin too much.
TEST_F(RecordedInput, HasAFactorAndAnOffset) {
  Recording part = recording("time_s,a\n0,0\n20,50\n", "rpm");
  part.columns[0].factor = 50.0;
  EXPECT_DOUBLE_EQ(read(part, 20.0)[0].signal.at(10.0), thermal::from_unit(1250.0, "rpm"));
  part.columns[0].offset = "10 rpm";
  EXPECT_DOUBLE_EQ(read(part, 20.0)[0].signal.at(10.0), thermal::from_unit(1260.0, "rpm"));
  part.columns[0].offset = "10 K";
  EXPECT_TRUE(refused(part).starts_with("recorded[0].columns[0].offset: column 'a': '10 K' is a temperature"))
      << refused(part);
  Recording room = recording("time_s,a\n0,20.5\n20,22.5\n", "degC");
  room.columns[0].offset = "-0.5 K";
  EXPECT_NEAR(read(room, 20.0)[0].signal.at(10.0), 294.15, 1e-9);
}

TEST_F(RecordedInput, ShiftsItsClockAndReadsItsUnit) {
  Recording shifted = recording("time_min,a\n0,0\n1,60\n2,120\n");
  shifted.time_column = "time_min";
  shifted.time_unit = "min";
  shifted.clock_offset = -60.0;
  EXPECT_DOUBLE_EQ(read(shifted, 60.0)[0].signal.at(30.0), 90.0);
}

TEST_F(RecordedInput, ReadsWhatALoggerWrote) {
  Recording logged = recording("room, 1st floor\ntime;a\n;°C\n24.11.2025 07:00;21,5\n24.11.2025 07:10;22,5\n", "degC");
  logged.time_column = "time";
  logged.header_line = 2;
  EXPECT_DOUBLE_EQ(read(logged, 600.0)[0].signal.at(300.0), 295.15);
}

TEST_F(RecordedInput, OfSeveralFilesHasOneClock) {
  Recording first = recording("time,a\n2025-11-24 07:00:00,0\n2025-11-24 07:10:00,10\n");
  first.time_column = "time";
  Recording second = first;
  second.file = "other.csv";
  second.columns[0].channel = "coolant.flow";
  tests::put(directory_ / "other.csv", "time;a\n24.11.2025 07:05;0\n24.11.2025 07:15;10\n");
  auto const channels = read_recordings({first, second}, directory_.path(), 600.0);
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_DOUBLE_EQ(channels[0].signal.at(450.0), 7.5);
  EXPECT_DOUBLE_EQ(channels[1].signal.at(450.0), 2.5);
}

TEST_F(RecordedInput, SaysWhereTimeDoesNotIncrease) {
  EXPECT_EQ(refused(recording("time_s,a\n0,0\n15,1\n10,2\n")),
            "data.csv:4:1: column 'time_s': '10' after '15': time must increase");
  EXPECT_EQ(refused(recording("time_s,a\n0,0\n15,1\n15,2\n")),
            "data.csv:4:1: column 'time_s': '15' after '15': time must increase");
}

TEST_F(RecordedInput, SaysWhereAGapIs) {
  Recording gap = recording("time_s,a\n0,0\n10,1\n90,2\n");
  gap.max_gap = 60.0;
  EXPECT_EQ(refused(gap), "data.csv:4: column 'time_s': 80 s after the row before is a gap longer than max_gap, 1 min");
  gap.max_gap = 80.0;
  EXPECT_EQ(refused(gap), "accepted");
}

TEST_F(RecordedInput, SaysWhereItsClockWasPutForward) {
  Recording night = recording("t,a\n2025-03-30 01:59,1\n2025-03-30 03:00,2\n");
  night.time_column = "t";
  EXPECT_TRUE(refused(night).starts_with("data.csv:3: '2025-03-30 03:00' after '2025-03-30 01:59': the clock was"))
      << refused(night);
}

TEST_F(RecordedInput, MustCoverTheRun) {
  Recording brief = recording("time_s,a\n0,0\n10,1\n");
  brief.max_gap = 60.0;
  EXPECT_EQ(refused(brief, 100.0),
            "data.csv: covers 0 s to 10 s of a run of 100 s; at its ends at most max_gap, 1 min, may be missing (see "
            "clock_offset and duration)");
  EXPECT_EQ(refused(brief, 70.0), "accepted");
  brief.clock_offset = 61.0;
  EXPECT_TRUE(refused(brief, 70.0).starts_with("data.csv: covers 61 s to 71 s")) << refused(brief, 70.0);
}

TEST_F(RecordedInput, RefusesWhatTheFileDoesNotHave) {
  EXPECT_EQ(refused(recording("time_s,b\n0,0\n")), "data.csv:1:1: no column 'a'; known: 'b', 'time_s'");
  EXPECT_EQ(refused(recording("t,a\n0,0\n")), "data.csv:1:1: no column 'time_s'; known: 't', 'a'");
  EXPECT_EQ(refused(recording("time_s,a\n0,x\n")), "data.csv:2:3: column 'a': 'x' is not a number");
}

TEST_F(RecordedInput, RefusesUnitsAndWordsThatAreNone) {
  std::string const text = "time_s,a\n0,0\n20,1\n";
  EXPECT_EQ(refused(recording(text, "rpmm")),
            "recorded[0].columns[0].unit: column 'a': 'rpmm': unknown unit 'rpmm'; did you mean 'rpm'?");
  Recording r = recording(text);
  r.time_unit = "K";
  EXPECT_EQ(refused(r), "recorded[0].time_unit: 'K' is no unit of time; known: 's', 'h', 'min', 'day'");
  r = recording(text);
  r.columns[0].interpolation = "cubic";
  EXPECT_EQ(refused(r), "recorded[0].columns[0].interpolation: 'cubic' must be \"automatic\", \"linear\" or \"step\"");
  r = recording(text);
  r.max_gap = 0.0;
  EXPECT_EQ(refused(r), "recorded[0].max_gap: 0 min must be above 0 s");
  r.columns.clear();
  EXPECT_EQ(refused(r), "recorded[0].columns: it is empty; name at least one column and its channel");
  EXPECT_EQ(refused({}), "recorded[0].file: the name of a CSV file is due");
  r = recording(text);
  r.columns[0].channel.clear();
  EXPECT_EQ(refused(r), "recorded[0].columns[0].channel: the name of an input channel is due");
}

class Environment : public testing::Test {
 protected:
  void TearDown() override { ::unsetenv("THERMOTWIN_TEST_FOLDER"); }
};

TEST_F(Environment, GivesTheFolderOfAPath) {
  ::setenv("THERMOTWIN_TEST_FOLDER", "/somewhere", 1);
  EXPECT_EQ(resolved_path("${THERMOTWIN_TEST_FOLDER}/a.csv", "/here"), "/somewhere/a.csv");
  EXPECT_EQ(resolved_path("${THERMOTWIN_TEST_FOLDER:-../data}/a.csv", "/here"), "/somewhere/a.csv");
}

TEST_F(Environment, RelativeStartsAtTheWorkingDirectory) {
  ::setenv("THERMOTWIN_TEST_FOLDER", "data", 1);
  EXPECT_EQ(resolved_path("${THERMOTWIN_TEST_FOLDER}/a.csv", "/here"), std::filesystem::current_path() / "data/a.csv");
}

TEST_F(Environment, DefaultsStartAtTheFilesDirectory) {
  EXPECT_EQ(resolved_path("${THERMOTWIN_TEST_FOLDER:-../data}/a.csv", "/here/there"), "/here/data/a.csv");
  EXPECT_EQ(resolved_path("a.csv", "/here"), "/here/a.csv");
  EXPECT_EQ(resolved_path("/there/a.csv", "/here"), "/there/a.csv");
}

TEST_F(Environment, SaysWhatIsNotSet) {
  EXPECT_EQ(tests::refusal([] { resolved_path("${THERMOTWIN_TEST_FOLDER}/a.csv", "."); }),
            "the environment variable THERMOTWIN_TEST_FOLDER is not set; it names the folder of a recorded file");
  EXPECT_EQ(tests::refusal([] { resolved_path("${THERMOTWIN", "."); }), "'${THERMOTWIN': a '}' is missing");
}

}  // namespace
}  // namespace thermotwin::scenarios
