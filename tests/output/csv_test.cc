#include "output/csv.h"

#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

#include "output/error.h"
#include "tests/output/example_dataset.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
using tests::contents;
using tests::example_dataset;
using tests::put;
using tests::TemporaryDirectory;
using thermal::InputError;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Dataset small_dataset() {
  Dataset dataset;
  dataset.time_s = Eigen::Vector2d(0.0, 0.1);
  dataset.inputs = {{"spindle.speed", "rpm", "", Eigen::Vector2d(4000.0, 1e-300)}};
  dataset.readings = {{"T1", "degC", "", Eigen::Vector2d(20.0625, nan)}};
  dataset.displacements = {{"E_Z", "um", "", Eigen::Vector2d(-1.5, 1.0 / 3.0)}};
  dataset.truth_readings = {{"T1", "degC", "", Eigen::Vector2d(20.0, 21.0)}};
  dataset.truth_displacements = {{"A", "urad", "", Eigen::Vector2d(1.0, 2.0)}};
  dataset.heat = {{"bearing.front", "W", "", Eigen::Vector2d(0.0, 120.0)}};
  return dataset;
}

std::string as_csv(Dataset const& dataset, CsvGroups const& groups) {
  std::ostringstream stream;
  export_csv(dataset, stream, groups);
  return stream.str();
}

TEST(Csv, NamesColumnsWithTheirUnits) {
  EXPECT_EQ(as_csv(small_dataset(), {}),
            "time_s,spindle.speed_rpm,T1_degC,E_Z_um\n"
            "0,4000,20.0625,-1.5\n"
            "0.1,1e-300,,0.3333333333333333\n");
}

TEST(Csv, WritesTheGroupsThatAreWanted) {
  CsvGroups const truth{false, false, false, true, true};
  EXPECT_EQ(as_csv(small_dataset(), truth),
            "time_s,truth.T1_degC,truth.A_urad,heat.bearing.front_W\n0,20,1,0\n0.1,21,2,120\n");
}

TEST(Csv, TellsItsTablesByTheirHeader) {
  auto const data = small_dataset();
  for (bool const truth : {false, true}) {
    auto const table = as_csv(data, {.truth = truth, .heat = true});
    EXPECT_TRUE(is_header_of(data, table.substr(0, table.find('\n')))) << truth;
  }
  EXPECT_TRUE(is_header_of(data, "time_s,spindle.speed_rpm,T1_degC,E_Z_um"));
  for (std::string const other : {"T1;T2", "time_s,T1_degC", "time_s,spindle.speed_rpm,T1_degC,E_Z_um2"})
    EXPECT_FALSE(is_header_of(data, other)) << other;
}

std::vector<std::string> names(std::vector<Channel> const& channels) {
  std::vector<std::string> found;
  for (auto const& channel : channels) found.push_back(channel.name + " [" + channel.unit + "]");
  return found;
}

TEST(Csv, SaysWhatStaysOut) {
  auto dataset = tests::example_dataset();
  EXPECT_EQ(left_out_of_csv(dataset),
            (std::vector<std::string>{"the laser's passes along z", "the temperatures of the nodes"}));
  dataset.positioning.clear();
  dataset.node_temperatures.reset();
  EXPECT_TRUE(left_out_of_csv(dataset).empty());
}

TEST(Csv, GivesBackEveryChannelInItsGroup) {
  TemporaryDirectory const directory;
  Dataset dataset = example_dataset();
  dataset.readings.push_back({"oil.tank", "degC", "", dataset.time_s});
  dataset.readings.push_back({"film", "um", "", dataset.time_s});
  dataset.inputs.push_back({"feed, Z", "mm/min", "", dataset.time_s});
  dataset.inputs.push_back({"truth.seeker", "1", "", dataset.time_s});
  dataset.truth_displacements.push_back({"a.b", "um", "", dataset.time_s});
  export_csv(dataset, directory / "run.csv", {true, true, true, true, true});
  Dataset const again = import_csv(directory / "run.csv");
  EXPECT_EQ(again.time_s, dataset.time_s);
  for (auto const group : {&Dataset::inputs, &Dataset::readings, &Dataset::displacements, &Dataset::truth_readings,
                           &Dataset::truth_displacements, &Dataset::heat}) {
    ASSERT_EQ(names(again.*group), names(dataset.*group));
    for (std::size_t i = 0; i < (dataset.*group).size(); ++i) {
      auto const& expected = (dataset.*group)[i].values;
      auto const& found = (again.*group)[i].values;
      for (Eigen::Index row = 0; row < expected.size(); ++row)
        EXPECT_TRUE(found[row] == expected[row] || (std::isnan(found[row]) && std::isnan(expected[row])));
    }
  }
}

TEST(Csv, ReadsWhatOthersMeasured) {
  TemporaryDirectory const directory;
  put(directory / "run.csv",
      "time_s, spindle_rpm, ch1_um, t1_C, tilt_urad\r\n0, 0, 0.38, 26.19,\r\n15,0,0.4,26.2,1\r\n");
  Dataset const dataset = import_csv(directory / "run.csv");
  EXPECT_THAT(names(dataset.inputs), ElementsAre("spindle [rpm]"));
  EXPECT_THAT(names(dataset.readings), ElementsAre("t1 [degC]"));
  EXPECT_THAT(names(dataset.displacements), ElementsAre("ch1 [um]", "tilt [urad]"));
  EXPECT_EQ(dataset.readings[0].values, Eigen::Vector2d(26.19, 26.2));
  EXPECT_TRUE(std::isnan(dataset.displacements[1].values[0]));
}

TEST(Csv, ReadsTheMeasuredSpindle) {
  char const* const shared = std::getenv("THERMOTWIN_MEASURED_DATA");
  std::filesystem::path const data = shared ? shared : THERMOTWIN_SOURCE_DIR "/../shared/data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no measured data: set THERMOTWIN_MEASURED_DATA";
  Dataset const dataset = import_csv(data / "spindle_5probe/spindle_5probe.csv");
  EXPECT_THAT(names(dataset.inputs), ElementsAre("spindle [rpm]"));
  EXPECT_EQ(dataset.readings.size(), 16u);
  EXPECT_EQ(dataset.displacements.size(), 5u);
  EXPECT_EQ(dataset.time_s[1], 15.0);
}

TEST(Csv, SaysFileLineAndColumn) {
  TemporaryDirectory const directory;
  auto const importing = [&](std::string const& text) {
    return [&directory, text] {
      put(directory / "run.csv", text);
      static_cast<void>(import_csv(directory / "run.csv"));
    };
  };
  EXPECT_THAT(importing("time_s,T1_degC\n0,20\n10,abc\n"),
              ThrowsMessage<InputError>(HasSubstr("run.csv:3:4: column 'T1_degC': 'abc' is not a number")));
  EXPECT_THAT(importing("time_s,T1_degC\n0,20\n10,21\n10,22\n"),
              ThrowsMessage<InputError>(HasSubstr("run.csv:4: column 'time_s': 10 s follows 10 s")));
  EXPECT_THAT(importing("time_s,T1_degC\n,20\n"), ThrowsMessage<InputError>(HasSubstr("run.csv:2: column 'time_s'")));
  EXPECT_THAT(importing("time_min,T1_degC\n0,20\n"),
              ThrowsMessage<InputError>(
                  testing::AllOf(HasSubstr("run.csv:1:1: no column 'time_s'; "),
                                 HasSubstr("; of a table that `thermotwin export` did not write, a measurement file "
                                           "(.toml) says what the columns are"))));
  EXPECT_THAT(importing("time_s,T1_degX\n0,20\n"),
              ThrowsMessage<InputError>(HasSubstr("run.csv:1: column 'T1_degX': ")));
  EXPECT_THAT(importing("time_s,T1\n0,20\n"), ThrowsMessage<InputError>(HasSubstr("'T1': has no unit")));
  EXPECT_THAT(importing("time_s,T1_degC,T1_K\n0,20,293\n"),
              ThrowsMessage<InputError>(HasSubstr("run.csv:1: readings: 'T1' is there twice")));
  EXPECT_THAT(importing("time_s,T1_degC,T1_degC\n0,20,20\n"), ThrowsMessage<InputError>(HasSubstr("T1_degC")));
  EXPECT_THAT([&] { static_cast<void>(import_csv(directory / "no.csv")); },
              ThrowsMessage<InputError>(HasSubstr("no.csv")));
}

TEST(Csv, LeavesTheOldFileWhenItCannotBeWritten) {
  TemporaryDirectory const directory;
  EXPECT_THAT([&] { export_csv(small_dataset(), directory / "no/run.csv"); },
              ThrowsMessage<OutputError>(HasSubstr("No such file or directory")));
  put(directory / "run.csv", "old");
  Dataset broken = small_dataset();
  broken.readings[0].values.resize(1);
  EXPECT_THROW(export_csv(broken, directory / "run.csv"), InputError);
  EXPECT_EQ(contents(directory / "run.csv"), "old");
}

}  // namespace
}  // namespace thermotwin::output
