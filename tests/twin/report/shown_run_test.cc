#include "twin/report/shown_run.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class ShownRunOf : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path text(std::string const& name, std::string const& content) const {
    tests::put(folder / name, content);
    return folder / name;
  }

  tests::TemporaryDirectory folder;
};

void expect_channel(output::Channel const& channel, std::string const& name, std::string const& unit, double first) {
  EXPECT_EQ(channel.name, name);
  EXPECT_EQ(channel.unit, unit) << name;
  EXPECT_NEAR(channel.values[0], first, 1e-9) << name;
}

TEST_F(ShownRunOf, ATableHasTheUnitsOfARun) {
  auto const run = read_shown_run(
      text("day.csv",
           "time_s,spindle.speed_rad/s,ambient.temperature_K,chiller.offset_K,z.position_m,motor.power_kW,T1_K,T2_mK,"
           "E_Z_mm,E_X_um,A_arcsec\n"
           "0,314.1592653589793,294.15,-2,0.2,1.5,293.98,293000,0.0053,7.25,3.6\n"
           "60,,295.15,-2,0.2,1.5,,293100,0.0054,7.5,3.6\n"));
  ASSERT_EQ(run.data.inputs.size(), 5U);
  expect_channel(run.data.inputs[0], "spindle.speed", "rpm", 3000.0);
  expect_channel(run.data.inputs[1], "ambient.temperature", "degC", 21.0);
  expect_channel(run.data.inputs[2], "chiller.offset", "K", -2.0);
  expect_channel(run.data.inputs[3], "z.position", "mm", 200.0);
  expect_channel(run.data.inputs[4], "motor.power", "W", 1500.0);
  expect_channel(run.data.readings[0], "T1", "degC", 20.83);
  expect_channel(run.data.readings[1], "T2", "degC", 19.85);
  expect_channel(run.data.displacements[0], "E_Z", "um", 5.3);
  expect_channel(run.data.displacements[1], "E_X", "um", 7.25);
  EXPECT_EQ(run.data.displacements[2].unit, "urad");
  EXPECT_NEAR(run.data.displacements[2].values[0], M_PI / 180.0 * 1e3, 1e-8);
  EXPECT_TRUE(std::isnan(run.data.readings[0].values[1]));
  EXPECT_TRUE(std::isnan(run.data.inputs[0].values[1]));
}

/// The degree sign and the letter µ are the same units.
TEST_F(ShownRunOf, AMeasurementHasThemToo) {
  (void)text("day.csv", "t,room,warm,long\n0,21,20.83,5.3\n1,21.5,20.85,5.4\n");
  auto const run = read_shown_run(text("day.toml", R"(title = "Montag, Aufwärmen"
machine = "lathe"
[[table]]
file = "day.csv"
time_column = "t"
time_unit = "min"
input = [{column = "room", channel = "ambient.temperature", unit = "°C"}]
reading = [{column = "warm", sensor = "T1", unit = "°C"}, {column = "long", sensor = "E_Z", unit = "µm"}]
)"));
  EXPECT_EQ(run.data.title, "Montag, Aufwärmen");
  EXPECT_EQ(run.machine, "lathe");
  EXPECT_FALSE(run.simulated);
  expect_channel(run.data.inputs[0], "ambient.temperature", "degC", 21.0);
  expect_channel(run.data.readings[0], "T1", "degC", 20.83);
  expect_channel(run.data.displacements[0], "E_Z", "um", 5.3);
}

TEST_F(ShownRunOf, ARunIsLeftAsItIs) {
  output::Dataset data;
  data.time_s = Eigen::Vector2d(0.0, 60.0);
  data.inputs = {{"spindle.speed", "rpm", "", Eigen::Vector2d(1.0 / 3.0, 4000.1)}};
  data.readings = {{"T1", "degC", "", Eigen::Vector2d(20.830000000000002, 1.0 / 7.0)}};
  data.displacements = {{"E_Z", "um", "", Eigen::Vector2d(0.37123349930841, 1e-11)}};
  data.provenance = {{"solver.steps", "12"}};
  output::write(data, folder / "run.h5");
  auto const run = read_shown_run(folder / "run.h5");
  EXPECT_EQ(run.data.inputs[0].values, data.inputs[0].values);
  EXPECT_EQ(run.data.readings[0].values, data.readings[0].values);
  EXPECT_EQ(run.data.displacements[0].values, data.displacements[0].values);
  EXPECT_TRUE(std::isinf(run.max_gap));
}

TEST_F(ShownRunOf, AnUnknownUnitIsToldWithItsFile) {
  output::Dataset data;
  data.time_s = Eigen::Vector2d(0.0, 60.0);
  data.readings = {{"T1", "degX", "", Eigen::Vector2d(20.0, 21.0)}};
  output::write(data, folder / "odd.h5");
  EXPECT_THAT([&] { (void)read_shown_run(folder / "odd.h5"); },
              ThrowsMessage<thermal::InputError>(AllOf(HasSubstr("odd.h5: "), HasSubstr("'degX'"))));
}

/// max_gap, 10 min unless the measurement file says otherwise, or ten usual intervals where those are longer.
TEST_F(ShownRunOf, AGapIsLongerThanMaxGapAndThanTenIntervals) {
  auto const is_gap = [](ShownRun const& run) {
    return samples_of(run, run.data.readings[0].values).values.array().isNaN().any();
  };
  auto const rows = [](double step, double last) {
    return fmt::format("0,20\n{},21\n{},22\n{},23\n{},24\n", step, 2 * step, 3 * step, 3 * step + last);
  };
  auto const measured = [&](std::string const& key, double step, double last) {
    (void)text("rows.csv", "t,T1\n" + rows(step, last));
    return is_gap(
        read_shown_run(text("rows.toml", "[[table]]\nfile = \"rows.csv\"\ntime_column = \"t\"\n" + key +
                                             "reading = [{column = \"T1\", sensor = \"T1\", unit = \"degC\"}]\n")));
  };
  EXPECT_FALSE(measured("", 10.0, 590.0));
  EXPECT_TRUE(measured("", 10.0, 610.0));
  EXPECT_TRUE(measured("max_gap = \"3 min\"\n", 10.0, 190.0));
  EXPECT_FALSE(measured("max_gap = \"3 min\"\n", 60.0, 590.0));
  EXPECT_TRUE(measured("max_gap = \"3 min\"\n", 60.0, 610.0));
  auto const table = [&](double last) {
    return is_gap(read_shown_run(text("rows.csv", "time_s,T1_degC\n" + rows(120.0, last))));
  };
  EXPECT_FALSE(table(1190.0));
  EXPECT_TRUE(table(1210.0));
}

/// Rows of another table, and an empty cell, are passed over; samples that are far apart have a NaN between them.
TEST_F(ShownRunOf, SamplesAreThoseOfTheirOwnTable) {
  (void)text("warm.csv", "t,T1\n0,20\n10,21\n20,\n30,23\n1030,24\n");
  (void)text("long.csv", "t,E_Z\n5,1\n305,2\n605,3\n905,4\n");
  auto const run = read_shown_run(text("both.toml", R"([[table]]
file = "warm.csv"
time_column = "t"
max_gap = "8 min"
reading = [{column = "T1", sensor = "T1", unit = "degC"}]
[[table]]
file = "long.csv"
time_column = "t"
max_gap = "9 min"
reading = [{column = "E_Z", sensor = "E_Z", unit = "um"}]
)"));
  EXPECT_EQ(run.data.time_s.size(), 9);
  auto const [time_s, values] = samples_of(run, run.data.readings[0].values);
  ASSERT_EQ(time_s, (Eigen::VectorXd(5) << 0.0, 10.0, 30.0, 530.0, 1030.0).finished());
  EXPECT_TRUE(std::isnan(values[3]));
  EXPECT_EQ(values[2], 23.0);
  EXPECT_EQ(values[4], 24.0);
  auto const length = samples_of(run, run.data.displacements[0].values);
  EXPECT_EQ(length.time_s, Eigen::Vector4d(5.0, 305.0, 605.0, 905.0));
  EXPECT_EQ(length.values, Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
}

}  // namespace
}  // namespace thermotwin::twin
