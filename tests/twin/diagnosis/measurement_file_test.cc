#include "twin/diagnosis/measurement_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/measured_data.h"
#include "twin/diagnosis/measurement_file.h"

/// What a measurement file makes of the tables that it names.
namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using thermotwin::tests::put;
using thermotwin::tests::refusal;
using thermotwin::tests::TemporaryDirectory;
using thermotwin::twin::tests::value_at;

/// A board that is measured by a file of two tables.
class MeasurementFileTest : public testing::Test {
 protected:
  void write_tables() {
    std::string duties = "t,h1,h2\n";
    for (int i = 0; i <= 60; ++i) duties += fmt::format("{},{},0\n", 10 * i, i < 30 ? 70 : 0);
    put(folder / "duty.csv", duties);
    std::string table = "minute,a,b\n";
    for (int i = 0; i < 40; ++i)
      table +=
          fmt::format("{},{},{}\n", 0.1 + 0.25 * i, i == 7 ? "" : std::to_string(20.0 + 0.1 * i), -293.0 - 0.2 * i);
    put(folder / "readings.csv", table);
  }
  MeasuredRun read(std::string const& text) {
    put(folder / "run.toml", text);
    return read_measured_run(folder / "run.toml", board);
  }

  TemporaryDirectory folder;
  Machine board = Machine::read(machine_file("tclab"));
  std::string const whole = R"(
title = "two tables"
machine = "tclab"
from = "30 s"
to = "9 min"

[[constant]]
channel = "ambient.temperature"
value = "20 degC"

[[table]]
file = "duty.csv"
time_column = "t"
[[table.input]]
column = "h1"
channel = "heater1.duty"
unit = "%"
[[table.input]]
column = "h2"
channel = "heater2.duty"
unit = "%"

[[table]]
file = "readings.csv"
time_column = "minute"
time_unit = "min"
clock_offset = "6 s"
[[table.reading]]
column = "a"
sensor = "T1"
unit = "degC"
offset = "0.5 K"
[[table.reading]]
column = "b"
sensor = "T2"
unit = "K"
factor = -1
)";
};

/// Replaces the first of a text's pieces.
std::string with(std::string text, std::string const& from, std::string const& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(MeasurementFileTest, LaysTablesOverOneAnother) {
  write_tables();
  auto const run = read(whole);
  EXPECT_DOUBLE_EQ(run.time[0], 0.0);
  EXPECT_NEAR(run.time[1], 0.1 * 60 + 2 * 15 + 6 - 30, 1e-9);
  EXPECT_TRUE(std::isnan(run.channels[0].values[0]));  // between two rows of the readings' table
  EXPECT_NEAR(run.channels[0].values[1], 273.15 + 20.0 + 0.2 + 0.5, 1e-9);
  EXPECT_NEAR(run.channels[1].values[1], 293.0 + 0.4, 1e-9);
  EXPECT_TRUE(std::isnan(run.channels[0].values[6]));  // the empty cell
  EXPECT_DOUBLE_EQ(run.course->next_jump(0.0), 300.0 - 30.0);
  for (auto const& channel : run.channels) EXPECT_EQ(channel.clock, "readings.csv");  // the duties are another's
}

TEST_F(MeasurementFileTest, TellsWhatIsWrongAndWhere) {
  write_tables();
  auto const changed = [&](std::string const& from, std::string const& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    return refusal([&] { (void)read(text); });
  };
  EXPECT_THAT(changed("column = \"a\"", "column = \"c\""), HasSubstr("no column 'c'"));
  EXPECT_THAT(changed("sensor = \"T1\"", "sensr = \"T1\""), HasSubstr("run.toml:30:1: unknown key 'sensr'"));
  EXPECT_THAT(changed("column = \"a\"", "column = \"c\""), HasSubstr("run.toml:29:10: "));
  EXPECT_THAT(changed("unit = \"K\"", "unit = \"W\""),
              HasSubstr("run.toml:36:8: 'W' is no unit of a temperature, a length or an angle; reading T2 is due"));
  EXPECT_THAT(changed("unit = \"K\"", "unit = \"KK\""), HasSubstr("run.toml:36:8: 'KK': unknown unit"));
  EXPECT_THAT(changed("unit = \"K\"", "unit = \"um\""),
              HasSubstr("run.toml:36:8: 'um': channel T2 of the data is a displacement"));
  EXPECT_THAT(changed("offset = \"0.5 K\"", "offset = \"0.5 mm\""), HasSubstr("run.toml:32:10: '0.5 mm'"));
  EXPECT_THAT(changed("time_unit = \"min\"", "time_unit = \"K\""), HasSubstr("'K' is no unit of time"));
  EXPECT_THAT(changed("to = \"9 min\"", "to = \"20 s\""), HasSubstr("holds nothing of the tables"));
  EXPECT_THAT(changed("channel = \"heater2.duty\"", "channel = \"heater1.duty\""),
              HasSubstr("input 'heater1.duty' is given twice"));
  EXPECT_THAT(changed("channel = \"heater2.duty\"", "channel = \"heater3.duty\""),
              HasSubstr("run.toml:20:11: nothing on 'tclab' reads 'heater3.duty'; did you mean 'heater2.duty'?"));
  EXPECT_THAT(changed("channel = \"heater2.duty\"", "channel = \"lamp\""),
              HasSubstr("needs inputs that the data lack: heater2.duty; the data have heater1.duty, lamp, ambient"));
}

/// In kelvin a number of degrees Celsius is colder than any machine.
TEST_F(MeasurementFileTest, RefusesTemperaturesThatNoMachineHas) {
  write_tables();
  std::string cold = "t,room\n";
  for (int i = 0; i <= 60; ++i) cold += fmt::format("{},{}\n", 10 * i, 22.0 + 0.01 * i);
  put(folder / "room.csv", cold);
  std::string const constant = "[[constant]]\nchannel = \"ambient.temperature\"\nvalue = \"20 degC\"\n";
  std::string const recorded =
      "\n[[table]]\nfile = \"room.csv\"\ntime_column = \"t\"\n[[table.input]]\ncolumn = \"room\"\n"
      "channel = \"ambient.temperature\"\nunit = \"K\"\n";
  auto const changed = [&](std::string const& from, std::string const& to, std::string const& more) {
    std::string text = whole + more;
    text.replace(text.find(from), from.size(), to);
    return refusal([&] { (void)read(text); });
  };
  std::string const allowed = "allowed is -60 degC to 150 degC; is its unit right?";
  EXPECT_THAT(changed("\"20 degC\"", "\"20 K\"", ""), HasSubstr("run.toml:9:9: '20 K' is -253.15 degC; " + allowed));
  EXPECT_THAT(changed("title", "initial_temperature = \"22 K\"\ntitle", ""),
              HasSubstr("run.toml:2:23: 'initial_temperature': '22 K' is -251.15 degC; " + allowed));
  EXPECT_THAT(changed(constant, "", recorded), HasSubstr("input 'ambient.temperature' is at -250.8"));
  EXPECT_THAT(changed(constant, "", recorded), HasSubstr("run.toml:"));
  EXPECT_EQ(changed(constant, "", with(recorded, "\"K\"", "\"degC\"")), "accepted");
}

TEST_F(MeasurementFileTest, SaysWhereAUnitContradictsTheChannel) {
  write_tables();
  std::string const more = "\n[[constant]]\nchannel = \"coolant.on\"\nvalue = \"3 K\"\n";
  EXPECT_THAT(refusal([&] { (void)read(whole + more); }), HasSubstr("'3 K' is a temperature"));
  std::string const speed =
      "\n[[table]]\nfile = \"duty.csv\"\ntime_column = \"t\"\n[[table.input]]\n"
      "column = \"h1\"\nchannel = \"spindle.speed\"\nunit = \"degC\"\n";
  EXPECT_THAT(refusal([&] { (void)read(whole + speed); }), HasSubstr("'degC' is no unit of"));
  EXPECT_THAT(refusal([&] { (void)read(whole + speed); }), HasSubstr("the channel is spindle.speed"));
}

/// As those of readings: the unit is that of the number times the factor.
TEST_F(MeasurementFileTest, InputsHaveAFactorAndAnOffset) {
  write_tables();
  auto const duty = [&](std::string const& keys) {
    return value_at(*read(with(whole, "unit = \"%\"", keys)).course, "heater1.duty", 0.0);
  };
  EXPECT_DOUBLE_EQ(duty("unit = \"%\""), 0.7);
  EXPECT_DOUBLE_EQ(duty("unit = \"1\"\nfactor = 0.01"), 0.7);
  EXPECT_DOUBLE_EQ(duty("unit = \"%\"\nfactor = 0.5\noffset = \"5 %\""), 0.4);
  std::string const share =
      "\n[[table]]\nfile = \"duty.csv\"\ntime_column = \"t\"\n[[table.input]]\n"
      "column = \"h1\"\nchannel = \"spindle.speed\"\nunit = \"%\"\n";
  EXPECT_THAT(refusal([&] { (void)read(whole + share); }),
              HasSubstr("the channel is spindle.speed; or give a factor: unit = \"rpm\", factor = 50 reads % of 5000"));
  EXPECT_DOUBLE_EQ(value_at(*read(whole + with(share, "\"%\"", "\"rpm\"\nfactor = 50")).course, "spindle.speed", 0.0),
                   thermal::from_unit(3500.0, "rpm"));
}

TEST_F(MeasurementFileTest, TellsOfAColumnForTwoSensors) {
  write_tables();
  auto text = with(with(whole, "column = \"b\"", "column = \"a\""), "unit = \"K\"", "unit = \"degC\"");
  EXPECT_THAT(read(with(text, "factor = -1", "factor = 1")).remarks,
              Contains("readings.csv: column 'a' is given to two channels, T1 and T2"));
  EXPECT_THAT(read(whole).remarks, testing::Not(Contains(HasSubstr("is given to two"))));
}

TEST_F(MeasurementFileTest, TellsThatItsClockWasPutForward) {
  std::string table = "t;h1;h2;a\n";
  for (int i = 0; i < 40; ++i)
    table += fmt::format("30.03.2025 {:02}:{:02};70;0;{},5\n", i < 20 ? 1 : 3, (40 + i) % 60, 20 + i);
  put(folder / "all.csv", table);
  EXPECT_THAT(read("[[constant]]\nchannel = \"ambient.temperature\"\nvalue = \"20 degC\"\n[[table]]\nfile = "
                   "\"all.csv\"\ntime_column = \"t\"\n"
                   "input = [{column = \"h1\", channel = \"heater1.duty\", unit = \"%\"}, "
                   "{column = \"h2\", channel = \"heater2.duty\", unit = \"%\"}]\n"
                   "reading = [{column = \"a\", sensor = \"T1\", unit = \"degC\"}]\n")
                  .remarks,
              Contains(HasSubstr("all.csv:22: '30.03.2025 03:00' after '30.03.2025 01:59': the clock was probably")));
}

/// Nobody quotes a number that has no unit; one that lacks it is told.
TEST_F(MeasurementFileTest, AConstantWithoutUnitNeedsNoQuotes) {
  write_tables();
  std::string const duty = "[[table.input]]\ncolumn = \"h2\"\nchannel = \"heater2.duty\"\nunit = \"%\"\n";
  for (std::string const value : {"0.25", "\"0.25\"", "1"}) {
    auto const run =
        read(with(whole, duty, "") + "\n[[constant]]\nchannel = \"heater2.duty\"\nvalue = " + value + "\n");
    EXPECT_EQ(run.input("heater2.duty", Eigen::Vector2d(10.0, 400.0)),
              Eigen::Vector2d::Constant(value == "1" ? 1.0 : 0.25));
  }
  EXPECT_THAT(refusal([&] { (void)read(with(whole, "\"20 degC\"", "20")); }),
              HasSubstr("20 has no unit; write for example"));
}

TEST_F(MeasurementFileTest, ReadsDegreesFahrenheit) {
  write_tables();
  auto const celsius = read(whole);
  std::string table = "minute,a,b\n";
  for (int i = 0; i < 40; ++i)
    table +=
        fmt::format("{},{},{}\n", 0.1 + 0.25 * i, i == 7 ? "" : fmt::format("{}", 68.0 + 0.18 * i), -293.0 - 0.2 * i);
  put(folder / "readings.csv", table);
  auto const run = read(with(whole, "unit = \"degC\"", "unit = \"degF\""));
  int read_there = 0;
  for (Eigen::Index r = 0; r < run.time.size(); ++r) {
    if (!std::isfinite(celsius.channels[0].values[r])) continue;
    EXPECT_NEAR(run.channels[0].values[r], celsius.channels[0].values[r], 1e-9);
    ++read_there;
  }
  EXPECT_GT(read_there, 30);
}

/// -127 degC is what a DS18B20 says that nobody hears.
TEST_F(MeasurementFileTest, LeavesOutWhatABrokenSensorShows) {
  write_tables();
  auto const table = [&](int broken_from) {
    std::string text = "minute,a,b\n";
    for (int i = 0; i < 40; ++i)
      text += fmt::format("{},{},{}\n", 0.1 + 0.25 * i, i < broken_from ? 20.0 + 0.1 * i : -127.0, -293.0 - 0.2 * i);
    put(folder / "readings.csv", text);
  };
  auto const plain = with(whole, "offset = \"0.5 K\"\n", "");
  for (int const from : {0, 10}) {
    table(from);
    auto const run = read(plain);
    EXPECT_EQ(run.channels[0].values.array().isFinite().any(), from > 0);
    EXPECT_THAT(run.remarks, Contains(AllOf(HasSubstr("'T1' reads -127.0 degC in "), HasSubstr("left out"))));
    EXPECT_TRUE(run.channels[1].values.array().isFinite().any());
  }
  write_tables();
  EXPECT_THAT(refusal([&] { (void)read(with(plain, "unit = \"degC\"", "unit = \"K\"")); }),
              HasSubstr("sensor 'T1' reads"));
}

TEST_F(MeasurementFileTest, ReadsWhatLoggersWrite) {
  write_tables();
  auto const plain = read(whole);
  std::string duties = "controller 4711\nt\th1\th2\n\t%\t%\n";
  for (int i = 0; i <= 60; ++i)
    duties += fmt::format("2025-11-24T07:{:02}:{:02}\t{}\t0,0\n", i / 6, 10 * (i % 6), i < 30 ? "70,0" : "0,0");
  put(folder / "duty.csv", duties);
  std::string table = "minute;a, left;b;note\r\n";
  for (int i = 0; i < 40; ++i)
    table += fmt::format("24.11.2025 07:{:02}:{:02},0;{},{};-{},{};door, shut\r\n", (15 * i) / 60, (15 * i) % 60,
                         i == 7 ? 0 : 20 + i / 10, i == 7 ? 0 : i % 10, 293 + i / 5, 2 * (i % 5));
  put(folder / "readings.csv", table);
  auto text =
      with(whole, "time_unit = \"min\"\nclock_offset = \"6 s\"\n", "clock_offset = \"12 s\"\nmissing = [\"0,0\"]\n");
  text = with(with(text, "column = \"a\"", "column = \"a, left\""), "unit = \"degC\"", "unit = \"°C\"");
  text = with(text, "time_column = \"t\"", "time_column = \"t\"\nheader_line = 2");
  auto const run = read(text);
  EXPECT_TRUE(run.time.isApprox(plain.time, 1e-12));
  for (std::size_t c = 0; c < 2; ++c)
    for (Eigen::Index row = 0; row < run.time.size(); ++row) {
      double const value = run.channels[c].values[row], due = plain.channels[c].values[row];
      EXPECT_TRUE(std::abs(value - due) < 1e-9 || (std::isnan(value) && std::isnan(due))) << c << " " << row;
    }
  EXPECT_EQ(run.course->next_jump(0.0), plain.course->next_jump(0.0));
  EXPECT_THAT(run.remarks, Contains(HasSubstr("duty.csv:3: skipped as a row of units: '', '%'")));
  EXPECT_DOUBLE_EQ(value_at(*run.course, "time_of_day", 0.0), 7 * 3600.0 + 30.0);
  EXPECT_DOUBLE_EQ(value_at(*plain.course, "time_of_day", 0.0), 8 * 3600.0);
}

TEST_F(MeasurementFileTest, ARecordedClockGoesBeforeTimeStamps) {
  std::string table = "t;clock;h1;h2;a\n";
  for (int i = 0; i < 40; ++i) table += fmt::format("24.11.2025 07:{:02};{};70;0;{},5\n", i, 36000 + 60 * i, 20 + i);
  put(folder / "all.csv", table);
  std::string const text =
      "[[constant]]\nchannel = \"ambient.temperature\"\nvalue = \"20 degC\"\n[[table]]\nfile = \"all.csv\"\n"
      "time_column = \"t\"\ninput = [{column = \"h1\", channel = \"heater1.duty\", unit = \"%\"}, "
      "{column = \"h2\", channel = \"heater2.duty\", unit = \"%\"}, "
      "{column = \"clock\", channel = \"time_of_day\", unit = \"s\"}]\n"
      "reading = [{column = \"a\", sensor = \"T1\", unit = \"degC\"}]\n";
  EXPECT_DOUBLE_EQ(value_at(*read(text).course, "time_of_day", 0.0), 10 * 3600.0);
  EXPECT_DOUBLE_EQ(
      value_at(*read(with(text, "channel = \"time_of_day\"", "channel = \"other\"")).course, "time_of_day", 0.0),
      7 * 3600.0);
}

TEST_F(MeasurementFileTest, SaysThatTimeStampsHaveNoUnit) {
  write_tables();
  put(folder / "readings.csv", "minute;a;b\n24.11.2025 07:00;20;-293\n");
  EXPECT_THAT(
      refusal([&] { (void)read(whole); }),
      HasSubstr("column 'minute': '24.11.2025 07:00' is a time stamp, which has no unit; leave `time_unit`, 'min'"));
  EXPECT_THAT(
      refusal([&] { (void)read(with(with(whole, "time_unit = \"min\"\n", ""), "clock_offset = \"6 s\"\n", "")); }),
      HasSubstr("run.toml:25:15: " + (folder / "readings.csv").string() + ":2:1: column 'minute': its times are"));
}

TEST_F(MeasurementFileTest, ARowOfUnitsMayNotContradict) {
  write_tables();
  auto const with_units = [&](std::string const& units) {
    std::string table = "minute,a,b\n" + units + "\n";
    for (int i = 0; i < 40; ++i) table += fmt::format("{},{},{}\n", 0.1 + 0.25 * i, 20.0 + 0.1 * i, -293.0 - 0.2 * i);
    put(folder / "readings.csv", table);
    return refusal([&] { (void)read(whole); });
  };
  EXPECT_EQ(with_units("min,°C,K"), "accepted");
  EXPECT_EQ(with_units("[min],,whatever"), "accepted");
  EXPECT_THAT(with_units("s,°C,K"),
              HasSubstr("readings.csv:2: column 'minute': this row says that its unit is 's', `time_unit` says 'min'"));
  EXPECT_THAT(with_units("min,degF,K"), HasSubstr("column 'a': this row says that its unit is 'degF'"));
  EXPECT_THAT(with_units("min,°C,mm"), HasSubstr("column 'b': this row says that its unit is 'mm', `unit` says 'K'"));
}

/// "tclab" of this folder, or its file, may call itself otherwise.
TEST_F(MeasurementFileTest, TheMachineIsNamedAsItCallsItself) {
  write_tables();
  put(folder / "board.toml", "name = \"tclab\"\n");
  for (std::string const named : {"board", "board.toml", "tclab"})
    EXPECT_THAT(read(with(whole, "machine = \"tclab\"", "machine = \"" + named + "\"")).remarks,
                testing::Not(Contains(HasSubstr("it is a run of"))))
        << named;
  EXPECT_THAT(read(with(whole, "machine = \"tclab\"", "machine = \"g200\"")).remarks,
              Contains(HasSubstr("it is a run of 'g200'")));
  EXPECT_THAT(read(with(whole, "machine = \"tclab\"", "machine = \"lathe.toml\"")).remarks,
              Contains("it is a run of 'lathe.toml', but there is no such file beside it"));
}

/// "g200.toml" beside it may be the measurement of that machine.
TEST_F(MeasurementFileTest, AFileOfAnotherKindHidesNoShippedMachine) {
  write_tables();
  put(folder / "g200.toml", whole);
  put(folder / "run.toml", with(whole, "machine = \"tclab\"", "machine = \"g200\""));
  EXPECT_EQ(read_measurement_file(folder / "run.toml").machine_file, std::filesystem::path());
  put(folder / "g200.toml", "name = \"board\"\n");
  EXPECT_EQ(read_measurement_file(folder / "run.toml").machine_file, folder / "g200.toml");
}

TEST_F(MeasurementFileTest, TimeMayNotRunBackwards) {
  write_tables();
  put(folder / "duty.csv", "t,h1,h2\n0,1,1\n20,1,1\n10,1,1\n");
  EXPECT_THAT(refusal([&] { (void)read(whole); }),
              HasSubstr("duty.csv:4:1: column 't': '10' after '20': time must increase"));
}

class ShippedMeasurement : public testing::TestWithParam<std::pair<char const*, char const*>> {};

TEST_P(ShippedMeasurement, IsReadWithItsMachine) {
  char const* given = std::getenv("THERMOTWIN_MEASURED_DATA");
  if (!given || !std::filesystem::exists(given)) GTEST_SKIP() << "measured data are not there";
  auto const [file, name] = GetParam();
  auto const folder = std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "scenarios" / "measured";
  auto const plant = Machine::read(machine_file(name));
  auto const run = read_measured_run(folder / (std::string(file) + ".toml"), plant);
  auto const sensors =
      std::count_if(run.channels.begin(), run.channels.end(), [](auto const& c) { return !c.displacement; });
  EXPECT_EQ(sensors, std::ptrdiff_t(plant.sensors.size()));
  EXPECT_GT(run.time.size(), 100);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedMeasurement,
                         testing::Values(std::pair("water_pipe_150801", "water_pipe"),
                                         std::pair("water_pipe_151204_1", "water_pipe"),
                                         std::pair("tclab_energy_balance", "tclab"),
                                         std::pair("tclab_second_order", "tclab"),
                                         std::pair("spindle_5probe_first", "spindle_5probe"),
                                         std::pair("spindle_5probe_rest", "spindle_5probe")));

}  // namespace
}  // namespace thermotwin::twin
