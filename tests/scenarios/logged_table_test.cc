#include "scenarios/logged_table.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"

namespace thermotwin::scenarios {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

class Logged : public testing::Test {
 protected:
  LoggedFile file(std::string const& name, std::string const& text) {
    tests::put(directory_ / name, text);
    LoggedFile result;
    result.file = name;
    result.time_column = "t";
    return result;
  }

  LoggedTable read(LoggedFile const& file, std::vector<std::string> const& columns = {"a"}) {
    return reader_.read(file, directory_ / file.file, columns);
  }

  /// What a file of its own is refused with, without the directory.
  std::string refused(LoggedFile const& file, std::vector<std::string> const& columns = {"a"}) {
    std::string const message = tests::refusal(
        [&] { static_cast<void>(TableReader(MissingValue::keep_as_nan).read(file, directory_ / file.file, columns)); });
    std::string const folder = directory_.path().string() + "/";
    return message.starts_with(folder) ? message.substr(folder.size()) : message;
  }
  std::string refused(std::string const& text) { return refused(file("data.csv", text)); }

  tests::TemporaryDirectory directory_;
  TableReader reader_{MissingValue::keep_as_nan};
};

TEST_F(Logged, CountsInItsUnit) {
  auto data = file("data.csv", "t;a\n0,5;1\n1;2\n");
  data.time_unit = "min";
  data.clock_offset = 6.0;
  auto const table = read(data);
  EXPECT_THAT(table.times, ElementsAre(36.0, 66.0));
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(1.0, 2.0)));
  EXPECT_THAT(table.lines, ElementsAre(2U, 3U));
  EXPECT_EQ(table.remark, "");
  EXPECT_FALSE(reader_.time_of_day(0.0));
}

TEST_F(Logged, CountsTimeStampsFromItsFirstRow) {
  auto const table = read(file("data.csv", "t;a\n24.11.2025 23:59:30;20,5\n25.11.2025 00:00:30;21,5\n"));
  EXPECT_THAT(table.times, ElementsAre(0.0, 60.0));
  EXPECT_THAT(table.columns[0], ElementsAre(20.5, 21.5));
  EXPECT_EQ(reader_.time_of_day(0.0), 86370.0);
  EXPECT_EQ(reader_.time_of_day(60.0), 30.0);
  EXPECT_EQ(reader_.time_of_day(-3600.0), 82770.0);
}

TEST_F(Logged, SharesTheClockOfTheFirstTable) {
  EXPECT_THAT(read(file("a.csv", "t,a\n2025-11-24 07:00:00,1\n2025-11-24 07:00:10,1\n")).times, ElementsAre(0.0, 10.0));
  EXPECT_THAT(read(file("b.csv", "t;a\n24.11.2025 06:59;1\n24.11.2025 07:01;1\n")).times, ElementsAre(-60.0, 60.0));
  auto late = file("c.csv", "t,a\n2025-11-24T07:00:30.25,1\n");
  late.clock_offset = -30.0;
  EXPECT_THAT(read(late).times, ElementsAre(0.25));
  EXPECT_EQ(reader_.time_of_day(0.0), 7 * 3600.0);
}

TEST_F(Logged, StartsWhenTheShiftedStampsSay) {
  auto shifted = file("a.csv", "t,a\n2025-11-24 07:00:00,1\n");
  shifted.clock_offset = 1800.0;
  EXPECT_THAT(read(shifted).times, ElementsAre(1800.0));
  EXPECT_EQ(reader_.time_of_day(0.0), 6.5 * 3600.0);
}

TEST_F(Logged, AsksHowClocksOfTwoKindsLie) {
  static_cast<void>(read(file("a.csv", "t,a\n2025-11-24T06:00:00Z,1\n")));
  auto local = file("b.csv", "t;a\n24.11.2025 07:00;1\n");
  EXPECT_THAT(
      tests::refusal([&] { read(local); }),
      HasSubstr("b.csv:2:1: column 't': its times are time stamps without a time zone, those of the first table "
                "time stamps with a time zone; `clock_offset` must say how the two clocks lie (\"0 s\": alike)"));
  local.clock_offset = -3600.0;
  EXPECT_THAT(read(local).times, ElementsAre(0.0));
  auto counted = file("c.csv", "t,a\n5,1\n");
  EXPECT_THAT(tests::refusal([&] { read(counted); }), HasSubstr("its times are numbers, those of the first table"));
  counted.clock_offset = 0.0;
  EXPECT_THAT(read(counted).times, ElementsAre(5.0));
  EXPECT_EQ(refused("t,a\n2025-11-24T06:00:00Z,1\n2025-11-24T06:01:00,1\n"),
            "data.csv:3:1: column 't': '2025-11-24T06:01:00': some rows have a time zone, others none");
}

TEST_F(Logged, SaysWhichTimesItReads) {
  std::string const forms = " that is read; those are: " + std::string(time_stamp_forms);
  EXPECT_EQ(refused("t,a\n11/24/2025 07:00:00,1\n"),
            "data.csv:2:1: column 't': '11/24/2025 07:00:00' is no number and no time stamp" + forms);
  EXPECT_EQ(refused("t,a\n2025-11-24 07:00:00,1\n2025-11-31 07:00:00,1\n"),
            "data.csv:3:1: column 't': '2025-11-31 07:00:00' is no time stamp" + forms);
  EXPECT_EQ(refused("t,a\n0,1\n2025-11-24 07:00:00,1\n"),
            "data.csv:3:1: column 't': '2025-11-24 07:00:00' is no number and no time stamp" + forms);
  EXPECT_EQ(refused("t,a\n0,1\n,1\n"), "data.csv:3:1: column 't': '' is missing or not finite; a number is due");
  EXPECT_EQ(refused("t,a\n2025-11-24 07:00:00,1\n2025-11-24 06:59:59,1\n"),
            "data.csv:3:1: column 't': '2025-11-24 06:59:59' after '2025-11-24 07:00:00': time must increase");
}

TEST_F(Logged, SaysWhereTheClockWasProbablyPut) {
  std::string const instead = "; write time stamps with their offset, as 2025-11-24T07:00:00+01:00, or seconds";
  EXPECT_EQ(refused("t,a\n2025-10-26 02:59:00,1\n2025-10-26 02:00:00,1\n"),
            "data.csv:3:1: column 't': '2025-10-26 02:00:00' after '2025-10-26 02:59:00': time must increase; the "
            "clock was probably put back to winter time there" +
                instead);
  auto const table = read(file("data.csv", "t,a\n2025-03-30 01:59,1\n2025-03-30 03:00,2\n2025-03-30 03:01,3\n"));
  EXPECT_THAT(table.times, ElementsAre(0.0, 3660.0, 3720.0));
  EXPECT_THAT(table.clock_remark,
              testing::EndsWith("data.csv:3: '2025-03-30 03:00' after '2025-03-30 01:59': the clock was probably put "
                                "forward to summer time there, and all that follows is an hour late" +
                                instead));
  EXPECT_EQ(read(file("data.csv", "t,a\n2025-03-29 01:59,1\n2025-03-29 03:00,2\n")).clock_remark, "");
}

/// A log of events to the second has two in one now and then: the last counts, where it says anything.
TEST_F(Logged, TakesTheLastOfRowsWithOneTime) {
  std::string text = "t,a,b\n";
  for (int i = 0; i < 20; ++i) text += std::to_string(10 * i) + ",1,2\n";
  auto const table = read(file("data.csv", text + "190,3,\n200,4,5\n"), {"a", "b"});
  ASSERT_EQ(table.times.size(), 21U);
  EXPECT_EQ(table.lines[19], 22U);
  EXPECT_EQ(table.columns[0][19], 3.0);
  EXPECT_EQ(table.columns[1][19], 2.0);
  EXPECT_THAT(table.repeats_remark,
              EndsWith("data.csv:22:1: column 't': '190' after '190': of rows with one time the last counts"));
  EXPECT_EQ(refused(text + "190,3,4\n190,4,5\n190,5,6\n"),
            "data.csv:22:1: column 't': '190' after '190': time must increase");
}

TEST_F(Logged, TakesNoUnitForTimeStamps) {
  auto data = file("data.csv", "t,a\n2025-11-24 07:00:00,1\n");
  data.time_unit = "min";
  EXPECT_EQ(
      refused(data),
      "data.csv:2:1: column 't': '2025-11-24 07:00:00' is a time stamp, which has no unit; leave `time_unit`, 'min', "
      "out");
  data.time_unit = "K";
  EXPECT_THAT(refused(data), HasSubstr("time_unit: 'K' is no unit of time"));
}

TEST_F(Logged, SkipsARowOfUnitsAndSaysSo) {
  auto const table = read(file("data.csv", "t,n,a,b,note\nmin,1/min,°C,°C,5\n0,1000,20,21,\n"), {"n", "a", "b"});
  EXPECT_THAT(table.times, ElementsAre(0.0));
  EXPECT_THAT(table.lines, ElementsAre(3U));
  EXPECT_THAT(table.remark, testing::EndsWith("data.csv:2: skipped as a row of units: 'min', '1/min', '°C'"));
  EXPECT_THAT(read(file("data.csv", "t,a\n,[mm]\n0,20\n")).remark, HasSubstr("units: '', '[mm]'"));
}

TEST_F(Logged, SkipsNoRowOfData) {
  EXPECT_EQ(refused("t,a\n0,mm\n1,2\n"), "data.csv:2:3: column 'a': 'mm' is not a number and no word of `missing`");
  EXPECT_EQ(refused("t,a\nmin,1\n1,2\n"),
            "data.csv:2:1: column 't': 'min' is no number and no time stamp that is read; "
            "those are: " +
                std::string(time_stamp_forms));
  EXPECT_THAT(refused("t,a\n11/24/2025,---\n1,2\n"), HasSubstr("data.csv:2:1: column 't': '11/24/2025' is no number"));
  EXPECT_THAT(refused("t,a\nmin,mm\ns,um\n"), HasSubstr("data.csv:3:1: column 't': 's' is no number"));
  EXPECT_THAT(refused("t,a\n,5\n1,2\n"), HasSubstr("data.csv:2:1: column 't': '' is missing"));
  EXPECT_EQ(refused("t,a\nmin,mm\n"), "data.csv: has no rows under its header");
  auto const table = read(file("data.csv", "t;a\n24.11.2025 07:00;\n24.11.2025 07:01;1\n"));
  EXPECT_EQ(table.times.size(), 2U);
  EXPECT_TRUE(std::isnan(table.columns[0][0]));
}

TEST_F(Logged, SkipsRowsOfEmptyCells) {
  auto const table = read(file("data.csv", "t;a;b\n24.11.2025 07:00;1;\n;;\n24.11.2025 07:01;2;\n;;\n ; ;\n;;;\n"));
  EXPECT_THAT(table.times, ElementsAre(0.0, 60.0));
  EXPECT_THAT(table.lines, ElementsAre(2U, 4U));
}

TEST_F(Logged, LeavesOutWhatWordsSayIsMissing) {
  auto data = file("data.csv", "t,a\n0,---\n1,-9999\n2,\n3,nan\n4,20\n");
  EXPECT_EQ(refused(data), "data.csv:2:3: column 'a': '---' is not a number and no word of `missing`");
  data.missing = {"---", "-9999"};
  auto const values = read(data).columns[0];
  ASSERT_EQ(values.size(), 5U);
  for (std::size_t row = 0; row < 4; ++row) EXPECT_TRUE(std::isnan(values[row])) << row;
  EXPECT_EQ(values[4], 20.0);
}

TEST_F(Logged, BeginsAtItsHeader) {
  auto data = file("data.csv", "# DAQ 3000\n# Serial 42\nt;a\n0;20,5\n");
  EXPECT_EQ(refused(data), "data.csv:1:1: no column 't'; line 3 has it: header_line = 3");
  data.header_line = 3;
  auto const table = read(data);
  EXPECT_THAT(table.columns[0], ElementsAre(20.5));
  EXPECT_THAT(table.lines, ElementsAre(4U));
}

}  // namespace
}  // namespace thermotwin::scenarios
