#include "thermal/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/unit.h"

namespace thermotwin::thermal {
namespace {

Unit read(std::string_view unit) { return read_unit(in_ascii(unit), unit); }

/// Fewest digits before `unit` that give back `si` exactly; empty if even 17 do not.
std::string exact_number(double si, Unit const& unit) {
  double const number = unit.number(si);
  std::array<char, 64> buffer{};
  for (int digits = 1; digits <= 17; ++digits) {
    auto const end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, std::chars_format::general, digits).ptr;
    double back = 0.0;
    std::from_chars(buffer.data(), end, back);
    if (unit.si(back) == si) return format_number(back);
  }
  return {};
}

std::string best_text(double si, std::span<std::string_view const> units) {
  std::string best;
  std::size_t best_cost = 1000;
  for (std::string_view const symbol : units) {
    Unit const unit = read(symbol);
    std::string const number = exact_number(si, unit);
    if (number.empty()) continue;
    double const size = std::abs(unit.number(si));
    bool const handy = size >= 1.0 && size < 1e5;
    std::size_t const cost = number.size() + (handy || unit.absolute ? 0 : 3);
    if (cost >= best_cost) continue;
    best_cost = cost;
    best = symbol == "1" ? number : number + " " + std::string(symbol);
  }
  return best;
}

std::string with_article(std::string const& noun) {
  return (std::string_view("aeiou").find(noun.front()) == std::string_view::npos ? "a " : "an ") + noun;
}

std::string mismatch(std::string_view text, Quantity const& quantity, Dimension expected) {
  if (quantity.dimension == dimension::dimensionless) return missing_unit(text, expected);
  return "'" + std::string(text) + "' is " + with_article(name_of(quantity.dimension)) + "; " +
         with_article(name_of(expected)) + " is due, for example \"" + example_of(expected) + "\"" +
         doubt_of_unit(text);
}

/// Every comma has exactly three digits behind it, and no zero begins the number: "18,000 rpm".
bool may_part_thousands(std::string_view letters) {
  constexpr std::string_view digits = "0123456789";
  if (letters[letters.find_first_of(digits)] == '0') return false;
  for (auto comma = letters.find(','); comma != std::string_view::npos; comma = letters.find(',', comma + 1))
    if (std::min(letters.find_first_not_of(digits, comma + 1), letters.size()) != comma + 4) return false;
  return true;
}

/// What a number with commas may mean: "70.5 kg" for "70,5 kg", and "18000 rpm" or "18.000 rpm" for "18,000 rpm".
std::string without_commas(std::string const& letters) {
  std::string joined = letters, pointed = letters;
  std::erase(joined, ',');
  pointed[pointed.find(',')] = '.';
  if (!may_part_thousands(letters)) return "\"" + pointed + "\"";
  bool const is_number = pointed.find(',') == std::string::npos && pointed.find('.') == pointed.rfind('.');
  return "\"" + joined + "\"" + (is_number ? " or \"" + pointed + "\"" : "");
}

/// InputError for a character that looks like a plain space, or like nothing.
void refuse_unseen(std::string_view letters, std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 4> unseen = {
      {{"\u2009", "a thin space, U+2009"},
       {"\u200b", "a zero-width space, U+200B"},
       {"\ufeff", "a byte order mark, U+FEFF"},
       {"\t", "a tab"}}};
  for (auto const& [sign, name] : unseen)
    if (letters.find(sign) != std::string_view::npos)
      throw InputError("'" + std::string(text) + "' holds " + std::string(name) + "; plain spaces alone are due");
}

/// `due` ends the message about a text that is no number; `usual` units are offered for an unknown one.
Quantity parse(std::string_view text, std::string const& due, std::span<std::string_view const> usual = {}) {
  std::string const letters = in_ascii(text);
  refuse_unseen(letters, text);
  std::string_view rest = letters;
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double number = 0.0;
  auto const [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::result_out_of_range)
    throw InputError("'" + std::string(text) + "': beyond what a double holds");
  if (error != std::errc()) throw InputError("'" + std::string(text) + "': " + due);
  if (!std::isfinite(number)) throw InputError("'" + std::string(text) + "': a finite number is due");
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  if (rest.empty()) return {number, dimension::dimensionless, false};
  if (rest.size() > 1 && rest[0] == ',' && std::isdigit(static_cast<unsigned char>(rest[1]))) {
    bool const thousands = may_part_thousands(letters);
    throw InputError("'" + std::string(text) + "': " + (thousands ? "nothing sets thousands apart, and " : "") +
                     "decimals follow a point: " + without_commas(letters));
  }
  if (rest[0] == ':')
    throw InputError("'" + std::string(text) + "': a time is one number with one unit: for 15:30 write \"15.5 h\"");
  Unit const unit = read_unit(rest, text, usual);
  return {unit.si(number), unit.dimension, unit.absolute};
}

std::string due_text(Dimension dimension) {
  bool const plain = dimension == dimension::dimensionless;
  return (plain ? with_article(name_of(dimension)) : "a number with a unit") + " is due, for example \"" +
         example_of(dimension) + "\"";
}

constexpr std::array<std::string_view, 2> scales = {"degC", "K"};  ///< in which temperatures are written
constexpr std::array<std::string_view, 3> read_scales = {"degC", "K", "degF"};

}  // namespace

Quantity parse_quantity(std::string_view text) { return parse(text, due_text(dimension::length)); }

double parse_value(std::string_view text, Dimension expected) {
  bool const plain = expected == dimension::dimensionless;
  Quantity const quantity =
      parse(text, due_text(expected), plain ? std::span<std::string_view const>() : usual_units(expected));
  if (quantity.dimension != expected) throw InputError(mismatch(text, quantity, expected));
  if (quantity.absolute_temperature) {
    throw InputError("'" + std::string(text) +
                     "' is a point on the temperature scale; a difference is due, for example \"" +
                     example_of(expected) + "\"");
  }
  return quantity.value;
}

std::string doubt_of_unit(std::string_view text) {
  for (std::string_view const per_millikelvin : {"/mK", "/(mK)"})
    if (text.ends_with(per_millikelvin))
      return "; mK is a millikelvin: per metre and kelvin is \"" +
             std::string(text.substr(0, text.size() - per_millikelvin.size())) + "/(m K)\"";
  return {};
}

double parse_temperature(std::string_view text) {
  Quantity const quantity = parse(text, "a temperature is due, for example \"22 degC\"", read_scales);
  if (quantity.dimension == dimension::dimensionless) {
    throw InputError(std::string(text) + " has no unit; write for example \"22 degC\"");
  }
  if (quantity.dimension != dimension::temperature_difference) {
    throw InputError("'" + std::string(text) + "' is a " + name_of(quantity.dimension) +
                     "; a temperature is due, for example \"22 degC\"");
  }
  if (quantity.value < 0.0) throw InputError("'" + std::string(text) + "' is below absolute zero (-273.15 degC)");
  return quantity.value;
}

double to_unit(double si, std::string_view unit) { return read(unit).number(si); }

double from_unit(double number, std::string_view unit) { return read(unit).si(number); }

void to_unit(std::span<double> values, std::string_view unit) {
  Unit const its_unit = read(unit);
  for (double& value : values) value = its_unit.number(value);
}

void from_unit(std::span<double> numbers, std::string_view unit) {
  Unit const its_unit = read(unit);
  for (double& number : numbers) number = its_unit.si(number);
}

Dimension dimension_of(std::string_view unit) { return read(unit).dimension; }

void require_unit(std::string_view unit, Dimension expected) {
  auto const usual = usual_units(expected);
  if (read_unit(in_ascii(unit), unit, usual).dimension == expected) return;
  throw InputError("'" + std::string(unit) + "' is no unit of " + name_of(expected) + "; " +
                   did_you_mean(unit, std::vector<std::string>(usual.begin(), usual.end())));
}

std::string missing_unit(std::string_view number, Dimension expected) {
  return std::string(number) + " has no unit; write for example \"" + example_of(expected) + "\"";
}

std::string format_number(double value) {
  std::array<char, 64> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

double without_rounding(double x, double size) {
  auto const exponent = [](double number) { return static_cast<int>(std::floor(std::log10(number))); };
  double const largest = std::max(std::abs(x), std::abs(size));
  if (x == 0.0 || !std::isfinite(largest)) return x;
  double nearest = 0.0;
  if (int const decimals = 11 - exponent(largest) + exponent(std::abs(x)); decimals >= 0) {
    std::array<char, 64> buffer{};
    auto const end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), x, std::chars_format::scientific, decimals);
    std::from_chars(buffer.data(), end.ptr, nearest);
  }
  return std::abs(nearest - x) <= 4.0 * std::numeric_limits<double>::epsilon() * largest ? nearest : x;
}

std::string format_quantity(double si, Dimension dimension) {
  std::string const natural = unit_of(dimension);
  std::span<std::string_view const> const usual = usual_units(dimension);
  std::vector<std::string_view> units(usual.begin(), usual.end());
  units.push_back(natural);
  return best_text(si, units);
}

std::string format_temperature(double kelvin) { return best_text(kelvin, scales); }

}  // namespace thermotwin::thermal
