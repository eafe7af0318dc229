#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace thermotwin::scenarios {

/// What to do with an empty field or a "nan".
enum class MissingValue { refuse, keep_as_nan };

/// A table of text, row by row.
///
/// Commas, semicolons or tabs separate its fields: whichever cuts the first lines alike. Where it is not a comma, the
/// decimals of all numbers follow either a point or a comma. Fields may be quoted and stand between spaces; a line may
/// end with CR LF; a byte order mark, empty lines and rows of empty fields, as spreadsheets leave them, are skipped.
///
/// Throws InputError: "data.csv:17:8: column 't16_C': 'abc' is not a number"; a file that cannot be read or has no
/// header, a row with more or fewer fields than the header, a column that is missing (with the nearest name, or the
/// line that has it) or there twice, a point here and a comma there.
class CsvFile {
 public:
  /// The names of the columns are on line `header_line`, from 1, or the next that is not empty; what stands above may
  /// be anything.
  explicit CsvFile(std::filesystem::path file, std::size_t header_line = 1);
  CsvFile(CsvFile const&) = delete;
  CsvFile& operator=(CsvFile const&) = delete;

  [[nodiscard]] std::filesystem::path const& path() const { return path_; }
  [[nodiscard]] std::vector<std::string> const& header() const { return header_; }
  /// Which field a column is; to be asked before the first row.
  [[nodiscard]] std::size_t place_of(std::string const& column) const;
  /// The names are text for people, too: refuses those that are not UTF-8.
  void require_utf8() const;

  /// Goes to the next row; false at the end.
  bool next();
  [[nodiscard]] std::size_t line() const { return number_; }
  [[nodiscard]] std::string_view field(std::size_t place) const { return fields_[place]; }
  /// Whether a number stands there, or a "nan".
  [[nodiscard]] bool holds_number(std::size_t place) const;
  /// The number there: NaN where it is missing and may be.
  double number(std::size_t place, MissingValue missing);

  /// What is said of a field of the present row, with its place.
  [[nodiscard]] std::string said_of(std::size_t place, std::string const& what) const;
  /// Complains of it.
  [[noreturn]] void fail(std::size_t place, std::string const& why) const;

 private:
  bool go_to_next_line();
  void cut();
  [[nodiscard]] std::optional<double> parsed(std::string_view field) const;
  [[nodiscard]] std::string place_in_line(std::string_view at) const;
  [[nodiscard]] std::size_t line_that_names(std::string const& column) const;
  void check_decimals(std::size_t place);

  std::filesystem::path path_;
  std::string text_;
  std::string_view rest_;  ///< below the present line
  std::string_view line_;
  std::size_t number_ = 0;  ///< of the present line
  std::vector<std::string_view> fields_;
  char separator_ = ',';
  std::vector<std::string> header_;
  std::string decimals_;  ///< the first number with decimals
  std::size_t decimals_line_ = 0;
};

/// Columns of numbers from a CSV file.
struct CsvTable {
  std::filesystem::path file;
  std::vector<std::vector<double>> columns;  ///< in the order in which they were asked for
  std::vector<std::size_t> lines;            ///< line of each row in the file
};

/// What is to be done about a file in another encoding than UTF-8.
std::string conversion_to_utf8(std::filesystem::path const& file);

/// Names of the columns, from the first line.
std::vector<std::string> csv_header(std::filesystem::path const& file);

/// Reads the named columns as numbers; other columns may hold anything. Throws InputError as CsvFile does, and for a
/// file without rows.
CsvTable read_csv(std::filesystem::path const& file, std::vector<std::string> const& columns,
                  MissingValue missing = MissingValue::refuse);

}  // namespace thermotwin::scenarios
