#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace thermotwin::scenarios {

/// What to do with an empty field or a "nan".
enum class MissingValue { refuse, keep_as_nan };

/// Columns of numbers from a CSV file.
struct CsvTable {
  std::filesystem::path file;
  std::vector<std::vector<double>> columns;  ///< in the order in which they were asked for
  std::vector<std::size_t> lines;            ///< line of each row in the file
};

/// Names of the columns, from the first line. Commas separate; fields may be quoted and stand between spaces; a line
/// may end with CR LF; a byte order mark is skipped. Throws InputError if the file cannot be read or is empty.
std::vector<std::string> csv_header(std::filesystem::path const& file);

/// Reads the named columns as numbers; other columns may hold anything. Empty lines are skipped.
///
/// Throws InputError: "data.csv:17:8: column 't16_C': 'abc' is not a number", a row with more or fewer fields than the
/// header, a column that is missing (with the nearest name) or there twice.
CsvTable read_csv(std::filesystem::path const& file, std::vector<std::string> const& columns,
                  MissingValue missing = MissingValue::refuse);

}  // namespace thermotwin::scenarios
