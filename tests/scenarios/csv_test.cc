#include "scenarios/csv.h"

#include <cmath>
#include <gmock/gmock.h>
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
  EXPECT_EQ(refused("t,a\n0,1,2\n", {"t"}), "data.csv:2:1: the line has 3 fields, the header 2; commas separate them");
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

TEST_F(Csv, RefusesLinesThatEndWithCarriageReturnsAlone) {
  EXPECT_EQ(refused("t,a\r0,1\r5,2\r", {"a"}),
            "data.csv: its lines end with CR alone, as on old Macs; LF, or CR and LF, are due: "
            "tr '\\r' '\\n' < data.csv > lines.csv");
  EXPECT_EQ(refused("t,a\r\n0,1\r\n", {"a"}), "accepted");
  EXPECT_EQ(refused("t,a\r", {"a"}), "data.csv: has no rows under its header");
  EXPECT_EQ(refused("t,a", {"a"}), "data.csv: has no rows under its header");
}

TEST_F(Csv, NamesTheFileThatIsLatin1) {
  std::string const latin =
      "t,T [\xB0"
      "C]\n0,1\n";
  std::string const message =
      "data.csv:1:6: the names of the columns are not written in UTF-8; convert the file, from Latin-1 for example: "
      "iconv -f latin1 -t utf8 data.csv > utf8.csv";
  EXPECT_EQ(refused(latin, {"t", "T [°C]"}), message);
  EXPECT_EQ(refused(latin, {"t"}), "accepted");
  EXPECT_THAT(tests::refusal([&] { csv_header(file(latin)); }), testing::EndsWith(message));
  EXPECT_EQ(refused("t,T [°C]\n0,1\n", {"T [°F]"}), "data.csv:1:1: no column 'T [°F]'; did you mean 'T [°C]'?");
}

TEST_F(Csv, FindsWhatSeparates) {
  for (char const* text :
       {"t,a,note\n0,21,x\n5,21.5,y\n", "t;a;note\r\n0;21;x\r\n5;21,5;y\r\n", "t\ta\tnote\n0\t21\t\n5\t21,5\ty\n",
        "t;a\n0;21\n5;21.5\n", "\"t\";\"a\"\n\"0\";\"21\"\n5;\"21,5\"\n", "t\tnote\ta\n0\t\"a\tb\"\t21\n5\t\t21.5\n",
        "t\tnote\ta\n0\t\t21\n5\t\"b\"\t21.5\n"})
    EXPECT_EQ(read_csv(file(text), {"a"}).columns[0], (std::vector<double>{21.0, 21.5})) << text;
  EXPECT_EQ(refused("t;a;note\n0;21;a, b; c\n", {"t"}),
            "data.csv:2:1: the line has 4 fields, the header 3; semicolons separate them");
}

TEST_F(Csv, FindsWhatSeparatesWhereNamesHoldCommas) {
  auto const path = file("t;bed, top;head, left, above;note\n0;20,72;21,5;door, open\n1;20,73;21,6;\n");
  EXPECT_EQ(csv_header(path), (std::vector<std::string>{"t", "bed, top", "head, left, above", "note"}));
  EXPECT_EQ(read_csv(path, {"bed, top"}).columns[0], (std::vector<double>{20.72, 20.73}));
  EXPECT_EQ(read_csv(file("t;a, b\n0;1,5\n"), {"a, b"}).columns[0], (std::vector<double>{1.5}));
  EXPECT_EQ(read_csv(file("t,a; b\n0,1.5\n"), {"a; b"}).columns[0], (std::vector<double>{1.5}));
  EXPECT_EQ(csv_header(file("t;a;b\n0;1\n")), (std::vector<std::string>{"t", "a", "b"}));
  EXPECT_EQ(csv_header(file("t")), (std::vector<std::string>{"t"}));
}

TEST_F(Csv, RefusesDecimalsThatContradictOneAnother) {
  std::string const rule = "; decimals follow the same sign in the whole file, and nothing sets thousands apart";
  EXPECT_EQ(refused("t;a;n\n0;21,5;1000\n1;21;1.000\n", {"a", "n"}),
            "data.csv:3:6: column 'n': '1.000' has a point, '21,5' on line 2 a comma" + rule);
  EXPECT_EQ(refused("t\ta\n0\t21.5\n1\t21,5\n", {"a"}),
            "data.csv:3:3: column 'a': '21,5' has a comma, '21.5' on line 2 a point" + rule);
  EXPECT_EQ(refused("t;a;version\n0;21,5;1.2\n", {"a"}), "accepted");
  EXPECT_EQ(refused("t;a\n0;1.021,5\n", {"a"}), "data.csv:2:3: column 'a': '1.021,5' is not a number");
  EXPECT_EQ(refused("t,a\n0,\"21,5\"\n", {"a"}), "data.csv:2:4: column 'a': '21,5' is not a number");
  EXPECT_EQ(refused("t,a\n0,21,5\n", {"a"}), "data.csv:2:1: the line has 3 fields, the header 2; commas separate them");
}

TEST_F(Csv, BeginsAtItsHeader) {
  auto const path = file("DAQ 3000; \"no. 42\nMonday\n\nt;a\n0;1,5\n");
  CsvFile csv(path, 4);
  EXPECT_EQ(csv.header(), (std::vector<std::string>{"t", "a"}));
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.line(), 5U);
  EXPECT_EQ(csv.number(1, MissingValue::refuse), 1.5);
  EXPECT_FALSE(csv.next());
  EXPECT_EQ(CsvFile(path, 3).header(), csv.header());  // an empty line
  EXPECT_EQ(refused("DAQ 3000\nMonday\n\nt;bed, top\n0;1,5\n", {"t", "bed, top"}),
            "data.csv:1:1: no column 't'; line 4 has it: header_line = 4");
  EXPECT_THAT(tests::refusal([&] { CsvFile(path, 9); }), testing::EndsWith("data.csv: ends before header_line, 9"));
}

}  // namespace
}  // namespace thermotwin::scenarios
