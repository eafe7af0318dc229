#include "scenarios/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::scenarios {
namespace {

using thermal::InputError;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string content_of(std::filesystem::path const& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  if (!std::filesystem::exists(file)) throw InputError(file.string() + ": there is no such file");
  if (std::filesystem::is_directory(file)) throw InputError(file.string() + ": is a folder; a file is due");
  if (!stream) throw InputError(file.string() + ": cannot be read");
  if (stream.peek() != std::ifstream::traits_type::eof()) content << stream.rdbuf();
  std::string text = content.str();
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw InputError(file.string() + ": is written in UTF-16; UTF-8 is due");
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Walks through a file line by line and cuts each into fields.
class CsvReader {
 public:
  CsvReader(std::filesystem::path const& file, std::string_view text) : file_(file), rest_(text) {}

  /// Cuts the next line that is not empty; false at the end.
  bool next() {
    while (!rest_.empty()) {
      std::size_t const end = std::min(rest_.find('\n'), rest_.size());
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (line_.ends_with('\r')) line_.remove_suffix(1);
      if (trimmed(line_).empty()) continue;
      cut();
      return true;
    }
    return false;
  }

  std::vector<std::string_view> const& fields() const { return fields_; }
  std::size_t line() const { return number_; }

  [[noreturn]] void fail(std::string_view at, std::string const& why) const {
    auto const column = static_cast<std::size_t>(at.data() - line_.data()) + 1;
    throw InputError(file_.string() + ":" + std::to_string(number_) + ":" + std::to_string(column) + ": " + why);
  }

  [[noreturn]] void fail(std::string const& why) const { fail(line_, why); }

 private:
  void cut() {
    fields_.clear();
    std::string_view rest = line_;
    while (true) {
      std::size_t const end = end_of_field(rest);
      fields_.push_back(without_quotes(trimmed(rest.substr(0, end))));
      if (end == rest.size()) return;
      rest.remove_prefix(end + 1);
    }
  }

  std::size_t end_of_field(std::string_view rest) const {
    std::size_t const start = rest.find_first_not_of(" \t");
    if (start == std::string_view::npos || rest[start] != '"') return std::min(rest.find(','), rest.size());
    bool quoted = false;
    for (std::size_t i = start; i < rest.size(); ++i) {
      if (rest[i] == '"') quoted = !quoted;
      if (rest[i] == ',' && !quoted) return i;
    }
    if (quoted) fail(rest.substr(start), "the quote is not closed on this line");
    return rest.size();
  }

  static std::string_view without_quotes(std::string_view field) {
    bool const quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
    return quoted ? field.substr(1, field.size() - 2) : field;
  }

  std::filesystem::path const& file_;
  std::string_view rest_;
  std::string_view line_;
  std::size_t number_ = 0;
  std::vector<std::string_view> fields_;
};

/// Inside a quoted field, two quotes stand for one.
std::string name_in(std::string_view field) {
  std::string name(field);
  for (auto at = name.find("\"\""); at != std::string::npos; at = name.find("\"\"", at + 1)) name.erase(at, 1);
  return name;
}

std::vector<std::string> header_of(CsvReader& reader, std::filesystem::path const& file) {
  if (!reader.next()) throw InputError(file.string() + ": is empty; a first line with the columns' names is due");
  std::vector<std::string> names;
  for (std::string_view const field : reader.fields()) names.push_back(name_in(field));
  for (auto const& [separator, name] : {std::pair(';', "semicolons"), {'\t', "tabs"}})
    if (names.size() == 1 && names[0].find(separator) != std::string::npos)
      reader.fail(std::string("the fields are separated by ") + name + "; commas are due, and decimals after a point");
  return names;
}

std::size_t place_of(std::string const& column, std::vector<std::string> const& header, CsvReader const& reader) {
  auto const found = std::find(header.begin(), header.end(), column);
  if (found == header.end()) {
    reader.fail("no column '" + column + "'; " + thermal::did_you_mean(column, header));
  }
  if (std::find(found + 1, header.end(), column) != header.end()) reader.fail("two columns are named '" + column + "'");
  return static_cast<std::size_t>(found - header.begin());
}

double number_in(std::string_view field, std::string const& column, MissingValue missing, CsvReader const& reader) {
  std::string_view const digits = field.starts_with('+') ? field.substr(1) : field;
  double number = nan;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (!field.empty() && (error != std::errc() || end != digits.data() + digits.size())) {
    reader.fail(field, "column '" + column + "': '" + std::string(field) + "' is not a number");
  }
  bool const kept = std::isnan(number) && missing == MissingValue::keep_as_nan;
  if (!std::isfinite(number) && !kept) {
    reader.fail(field,
                "column '" + column + "': '" + std::string(field) + "' is missing or not finite; a number is due");
  }
  return number;
}

}  // namespace

std::vector<std::string> csv_header(std::filesystem::path const& file) {
  std::string const text = content_of(file);
  CsvReader reader(file, text);
  return header_of(reader, file);
}

CsvTable read_csv(std::filesystem::path const& file, std::vector<std::string> const& columns, MissingValue missing) {
  std::string const text = content_of(file);
  CsvReader reader(file, text);
  std::vector<std::string> const header = header_of(reader, file);
  std::vector<std::size_t> places;
  for (std::string const& column : columns) places.push_back(place_of(column, header, reader));

  CsvTable table{file, std::vector<std::vector<double>>(columns.size()), {}};
  while (reader.next()) {
    if (reader.fields().size() != header.size()) {
      reader.fail("the line has " + std::to_string(reader.fields().size()) + " fields, the header " +
                  std::to_string(header.size()));
    }
    table.lines.push_back(reader.line());
    for (std::size_t i = 0; i < places.size(); ++i) {
      table.columns[i].push_back(number_in(reader.fields()[places[i]], columns[i], missing, reader));
    }
  }
  if (table.lines.empty()) throw InputError(file.string() + ": has no rows under its header");
  return table;
}

}  // namespace thermotwin::scenarios
