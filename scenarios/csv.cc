#include "scenarios/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::scenarios {
namespace {

using thermal::InputError;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr auto nowhere = std::string_view::npos;
constexpr std::string_view separators = "\t;,";  ///< those that numbers may hold come last
constexpr std::size_t compared_lines = 10;       ///< of the header and below, for the separator
constexpr std::size_t preamble = 100;            ///< no more lines are searched for a header

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
  if (text.find('\n') == nowhere && text.find('\r') < text.size() - 1)
    throw InputError(file.string() +
                     ": its lines end with CR alone, as on old Macs; LF, or CR and LF, are due: tr '\\r' '\\n' < " +
                     file.filename().string() + " > lines.csv");
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

/// Where a text is not UTF-8; npos if it is.
std::size_t foreign_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    auto const lead = static_cast<unsigned char>(text[i]);
    std::size_t const length = lead < 0x80 ? 1 : lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    std::string_view const letter = text.substr(i, length);
    bool const continued = std::all_of(letter.begin() + (letter.empty() ? 0 : 1), letter.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; });
    if (length == 0 || lead > 0xF4 || letter.size() < length || !continued) return i;
    i += length;
  }
  return nowhere;
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Takes the first line off, without its end.
std::string_view take_line(std::string_view& rest) {
  std::size_t const end = std::min(rest.find('\n'), rest.size());
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string_view without_quotes(std::string_view field) {
  bool const quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return quoted ? field.substr(1, field.size() - 2) : field;
}

/// The first field's end; npos if its quote is not closed.
std::size_t end_of_field(std::string_view rest, char separator) {
  std::size_t const start = rest.find_first_not_of(separator == '\t' ? " " : " \t");
  if (start == nowhere || rest[start] != '"') return std::min(rest.find(separator), rest.size());
  bool quoted = false;
  for (std::size_t i = start; i < rest.size(); ++i) {
    if (rest[i] == '"') quoted = !quoted;
    if (rest[i] == separator && !quoted) return i;
  }
  return quoted ? nowhere : rest.size();
}

/// A line's fields. Of one whose quote is not closed the last is the rest of the line, quote and all.
std::vector<std::string_view> fields_of(std::string_view rest, char separator) {
  std::vector<std::string_view> fields;
  while (true) {
    std::size_t const end = end_of_field(rest, separator);
    std::string_view const field = trimmed(rest.substr(0, end));
    fields.push_back(end == nowhere ? field : without_quotes(field));
    if (end >= rest.size()) return fields;
    rest.remove_prefix(end + 1);
  }
}

/// Inside a quoted field, two quotes stand for one.
std::string name_in(std::string_view field) {
  std::string name(field);
  for (auto at = name.find("\"\""); at != std::string::npos; at = name.find("\"\"", at + 1)) name.erase(at, 1);
  return name;
}

/// What separates the fields of a header and of the rows below: the first of those that cut all of them alike, else the
/// one that cuts the header most often.
char separator_of(std::string_view header, std::string_view rest) {
  std::vector<std::string_view> rows;
  while (!rest.empty() && rows.size() < compared_lines)
    if (auto const line = take_line(rest); !trimmed(line).empty()) rows.push_back(line);
  char best = ',';
  std::size_t most = 1;
  for (char const separator : separators) {
    std::size_t const names = fields_of(header, separator).size();
    auto const alike = [&](std::string_view row) { return fields_of(row, separator).size() == names; };
    if (names > 1 && std::all_of(rows.begin(), rows.end(), alike)) return separator;
    if (names > most) best = separator;
    most = std::max(most, names);
  }
  return best;
}

std::string name_of(char separator) { return separator == '\t' ? "tabs" : separator == ';' ? "semicolons" : "commas"; }

}  // namespace

CsvFile::CsvFile(std::filesystem::path file, std::size_t header_line)
    : path_(std::move(file)), text_(content_of(path_)), rest_(text_) {
  while (number_ + 1 < header_line && !rest_.empty()) {
    take_line(rest_);
    ++number_;
  }
  if (!go_to_next_line()) {
    throw InputError(path_.string() + (header_line > 1 ? ": ends before header_line, " + std::to_string(header_line)
                                                       : ": is empty; a first line with the columns' names is due"));
  }
  separator_ = separator_of(line_, rest_);
  cut();
  for (std::string_view const field : fields_) header_.push_back(name_in(field));
}

bool CsvFile::go_to_next_line() {
  while (!rest_.empty()) {
    line_ = take_line(rest_);
    ++number_;
    if (!trimmed(line_).empty()) return true;
  }
  return false;
}

void CsvFile::cut() {
  fields_ = fields_of(line_, separator_);
  std::string_view const last = fields_.back();
  if (last.starts_with('"') && std::count(last.begin(), last.end(), '"') % 2 == 1)
    throw InputError(place_in_line(last) + "the quote is not closed on this line");
}

bool CsvFile::next() {
  do {
    if (!go_to_next_line()) return false;
    cut();
  } while (std::all_of(fields_.begin(), fields_.end(), [](std::string_view field) { return field.empty(); }));
  if (fields_.size() != header_.size()) {
    throw InputError(place_in_line(line_) + "the line has " + std::to_string(fields_.size()) + " fields, the header " +
                     std::to_string(header_.size()) + "; " + name_of(separator_) + " separate them");
  }
  return true;
}

std::string CsvFile::place_in_line(std::string_view at) const {
  auto const column = static_cast<std::size_t>(at.data() - line_.data()) + 1;
  return path_.string() + ":" + std::to_string(number_) + ":" + std::to_string(column) + ": ";
}

std::string CsvFile::said_of(std::size_t place, std::string const& what) const {
  return place_in_line(fields_[place]) + "column '" + header_[place] + "': " + what;
}

void CsvFile::fail(std::size_t place, std::string const& why) const { throw InputError(said_of(place, why)); }

void CsvFile::require_utf8() const {
  std::size_t const foreign = foreign_byte(line_);
  if (foreign == nowhere) return;
  throw InputError(place_in_line(line_.substr(foreign)) + "the names of the columns are not written in UTF-8; " +
                   conversion_to_utf8(path_));
}

std::size_t CsvFile::place_of(std::string const& column) const {
  auto const found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end()) {
    require_utf8();
    std::size_t const below = line_that_names(column);
    throw InputError(place_in_line(line_) + "no column '" + column + "'; " +
                     (below > 0 ? "line " + std::to_string(below) + " has it: header_line = " + std::to_string(below)
                                : thermal::did_you_mean(column, header_)));
  }
  if (std::find(found + 1, header_.end(), column) != header_.end())
    throw InputError(place_in_line(line_) + "two columns are named '" + column + "'");
  return static_cast<std::size_t>(found - header_.begin());
}

/// Below the header that is none; 0 if there is no such line.
std::size_t CsvFile::line_that_names(std::string const& column) const {
  std::string_view rest = rest_;
  for (std::size_t number = number_ + 1; !rest.empty() && number <= number_ + preamble; ++number) {
    std::string_view const line = take_line(rest);
    for (char const separator : separators) {
      auto const fields = fields_of(line, separator);
      if (std::any_of(fields.begin(), fields.end(), [&](auto field) { return name_in(field) == column; }))
        return number;
    }
  }
  return 0;
}

std::optional<double> CsvFile::parsed(std::string_view field) const {
  std::string digits(field.starts_with('+') ? field.substr(1) : field);
  if (separator_ != ',') std::replace(digits.begin(), digits.end(), ',', '.');
  double number = 0.0;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

bool CsvFile::holds_number(std::size_t place) const { return parsed(fields_[place]).has_value(); }

double CsvFile::number(std::size_t place, MissingValue missing) {
  std::string_view const field = fields_[place];
  auto const number = field.empty() ? nan : parsed(field);
  if (!number) fail(place, "'" + std::string(field) + "' is not a number");
  bool const kept = std::isnan(*number) && missing == MissingValue::keep_as_nan;
  if (!std::isfinite(*number) && !kept)
    fail(place, "'" + std::string(field) + "' is missing or not finite; a number is due");
  check_decimals(place);
  return *number;
}

/// "1,5" and "1.500" in one file: one of them is not what it seems.
void CsvFile::check_decimals(std::size_t place) {
  std::string_view const field = fields_[place];
  std::size_t const mark = field.find_first_of(",.");
  if (mark == nowhere) return;
  if (decimals_.empty()) {
    decimals_ = field;
    decimals_line_ = number_;
  }
  if (decimals_.find(field[mark]) != std::string::npos) return;
  auto const name = [](bool comma) { return comma ? "comma" : "point"; };
  fail(place, "'" + std::string(field) + "' has a " + name(field[mark] == ',') + ", '" + decimals_ + "' on line " +
                  std::to_string(decimals_line_) + " a " + name(field[mark] != ',') +
                  "; decimals follow the same sign in the whole file, and nothing sets thousands apart");
}

std::string conversion_to_utf8(std::filesystem::path const& file) {
  return "convert the file, from Latin-1 for example: iconv -f latin1 -t utf8 " + file.filename().string() + " > utf8" +
         file.extension().string();
}

std::vector<std::string> csv_header(std::filesystem::path const& file) {
  CsvFile const csv(file);
  csv.require_utf8();
  return csv.header();
}

CsvTable read_csv(std::filesystem::path const& file, std::vector<std::string> const& columns, MissingValue missing) {
  CsvFile csv(file);
  std::vector<std::size_t> places;
  for (std::string const& column : columns) places.push_back(csv.place_of(column));
  CsvTable table{file, std::vector<std::vector<double>>(columns.size()), {}};
  while (csv.next()) {
    table.lines.push_back(csv.line());
    for (std::size_t i = 0; i < places.size(); ++i) table.columns[i].push_back(csv.number(places[i], missing));
  }
  if (table.lines.empty()) throw InputError(file.string() + ": has no rows under its header");
  return table;
}

}  // namespace thermotwin::scenarios
