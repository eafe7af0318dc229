#include "scenarios/csv.h"

#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"

namespace thermotwin::scenarios {
namespace {

class Csv : public testing::Test {
 protected:
  std::filesystem::path file(std::string const& text) {
    tests::put(directory_ / "data.csv", text);
    return directory_ / "data.csv";
  }

  /// What reading `columns` of `text` is refused with, without the directory.
  std::string refused(std::string const& text, std::vector<std::string> const& columns) {
    std::filesystem::path const path = file(text);
    std::string const message = tests::refusal([&] { read_csv(path, columns); });
    return message.starts_with(path.string()) ? "data.csv" + message.substr(path.string().size()) : message;
  }

  tests::TemporaryDirectory directory_;
};

TEST_F(Csv, ReadsColumnsInTheOrderAskedFor) {
  CsvTable const table = read_csv(file("t,a,b\n0,1,2\n1,-3.5e1,+4\n"), {"b", "t"});
  EXPECT_EQ(table.columns[0], (std::vector<double>{2.0, 4.0}));
  EXPECT_EQ(table.columns[1], (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(table.lines, (std::vector<std::size_t>{2, 3}));
}

TEST_F(Csv, TakesSpacesQuotesCarriageReturnsAndEmptyLines) {
  auto const path = file("\xEF\xBB\xBFTime (sec), \"Heater, 1\" ,\"a \"\"b\"\"\"\r\n\r\n 0.0 , \"7\",1\r\n1.0,8,2");
  EXPECT_EQ(csv_header(path), (std::vector<std::string>{"Time (sec)", "Heater, 1", "a \"b\""}));
  CsvTable const table = read_csv(path, {"Time (sec)", "Heater, 1"});
  EXPECT_EQ(table.columns[0], (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(table.columns[1], (std::vector<double>{7.0, 8.0}));
  EXPECT_EQ(table.lines, (std::vector<std::size_t>{3, 4}));
}

TEST_F(Csv, LeavesOtherColumnsAlone) {
  EXPECT_EQ(read_csv(file("t,note\n0,warm up\n"), {"t"}).columns[0], (std::vector<double>{0.0}));
}

TEST_F(Csv, KeepsMissingValuesWhereTheyAreAllowed) {
  CsvTable const table = read_csv(file("t,a\n0,\n1,nan\n2,3\n"), {"a"}, MissingValue::keep_as_nan);
  EXPECT_TRUE(std::isnan(table.columns[0][0]));
  EXPECT_TRUE(std::isnan(table.columns[0][1]));
  EXPECT_EQ(table.columns[0][2], 3.0);
}

TEST_F(Csv, RefusesInfinityEvenWhereValuesMayBeMissing) {
  auto const path = file("t\ninf\n");
  EXPECT_THROW(read_csv(path, {"t"}, MissingValue::keep_as_nan), thermal::InputError);
}

TEST_F(Csv, SaysFileLineColumnAndValue) {
  EXPECT_EQ(refused("t,a\n0,1\n1,abc\n", {"t", "a"}), "data.csv:3:3: column 'a': 'abc' is not a number");
  EXPECT_EQ(refused("t,a\n0,1\n1, 2x\n", {"t", "a"}), "data.csv:3:4: column 'a': '2x' is not a number");
  EXPECT_EQ(refused("t,a\n0,nan\n", {"t", "a"}),
            "data.csv:2:3: column 'a': 'nan' is missing or not finite; a number is due");
  EXPECT_EQ(refused("t,a\n0,\n", {"t", "a"}), "data.csv:2:3: column 'a': '' is missing or not finite; a number is due");
  EXPECT_EQ(refused("t,a\n0,1,2\n", {"t"}), "data.csv:2:1: the line has 3 fields, the header 2");
  EXPECT_EQ(refused("t,a\n0,\"1\n", {"t"}), "data.csv:2:3: the quote is not closed on this line");
}

TEST_F(Csv, NamesTheNearestColumn) {
  EXPECT_EQ(refused("time_s,t16_C\n0,1\n", {"t61_C"}), "data.csv:1:1: no column 't61_C'; did you mean 't16_C'?");
  EXPECT_EQ(refused("t,a,a\n0,1,2\n", {"a"}), "data.csv:1:1: two columns are named 'a'");
}

TEST_F(Csv, RefusesFilesWithoutRows) {
  EXPECT_EQ(refused("", {"t"}), "data.csv: is empty; a first line with the columns' names is due");
  EXPECT_EQ(refused("t,a\n\n", {"t"}), "data.csv: has no rows under its header");
  EXPECT_TRUE(
      tests::refusal([&] { read_csv(directory_ / "none.csv", {"t"}); }).ends_with("none.csv: there is no such file"));
  EXPECT_TRUE(tests::refusal([&] { read_csv(directory_.path(), {"t"}); }).ends_with(": is a folder; a file is due"));
}

TEST_F(Csv, RefusesUtf16) {
  using namespace std::string_literals;
  EXPECT_EQ(refused("\xFF\xFEt\0,\0"s, {"t"}), "data.csv: is written in UTF-16; UTF-8 is due");
}

TEST_F(Csv, SaysWhichSeparatorItFound) {
  EXPECT_EQ(refused("t;S (rpm)\n0;1,5\n", {"t"}),
            "data.csv:1:1: the fields are separated by semicolons; commas are due, and decimals after a point");
  EXPECT_EQ(refused("t\ta\n0\t1\n", {"t"}),
            "data.csv:1:1: the fields are separated by tabs; commas are due, and decimals after a point");
}

}  // namespace
}  // namespace thermotwin::scenarios
