#include "thermal/unit.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::thermal {
namespace {

namespace dim = dimension;

constexpr double turn = 2 * std::numbers::pi;  ///< [rad]
constexpr Unit celsius = {dim::temperature_difference, 1, 1, true, 273.15};
constexpr Unit fahrenheit = {dim::temperature_difference, 5, 9, true, 459.67};

/// What helps whoever writes "2h30" or "2 h 30 min".
constexpr std::string_view one_of_each = "a quantity is one number with one unit, for example \"2.5 h\" or \"150 min\"";

struct NamedUnit {
  std::string_view symbol;
  Unit unit;
  bool takes_prefix = false;
  bool of_angle = false;  ///< says how far something turns
};

struct Prefix {
  std::string_view symbol;
  double numerator;
  double denominator;
};

namespace dim = dimension;

constexpr std::array named_units = {
    NamedUnit{"m", {dim::length}, true},
    NamedUnit{"g", {dim::mass, 1, 1000}, true},
    NamedUnit{"s", {dim::time}, true},
    NamedUnit{"K", {dim::temperature_difference}, true},
    NamedUnit{"A", {dim::current}, true},
    NamedUnit{"W", {dim::power}, true},
    NamedUnit{"J", {dim::energy}, true},
    NamedUnit{"N", {dim::force}, true},
    NamedUnit{"Pa", {dim::pressure}, true},
    NamedUnit{"Hz", {dim::angular_speed}, true},
    NamedUnit{"V", {dim::voltage}, true},
    NamedUnit{"ohm", {dim::resistance}, true},
    NamedUnit{"rad", {dim::angle}, true, true},
    NamedUnit{"bar", {dim::pressure, 1e5, 1}, true},
    NamedUnit{"cm", {dim::length, 1, 100}},
    NamedUnit{"hPa", {dim::pressure, 100, 1}},
    NamedUnit{"cSt", {dim::viscosity, 1, 1e6}},
    NamedUnit{"min", {dim::time, 60, 1}},
    NamedUnit{"h", {dim::time, 3600, 1}},
    NamedUnit{"day", {dim::time, 86400, 1}},
    NamedUnit{"rpm", {dim::angular_speed, turn, 60}, false, true},
    NamedUnit{"rev", {dim::angle, turn, 1}, false, true},
    NamedUnit{"U", {dim::angle, turn, 1}, false, true},
    NamedUnit{"deg", {dim::angle, std::numbers::pi, 180}, false, true},
    NamedUnit{"arcsec", {dim::angle, std::numbers::pi, 648000}, false, true},
    NamedUnit{"L", {dim::volume, 1, 1000}},
    NamedUnit{"l", {dim::volume, 1, 1000}},
    NamedUnit{"%", {dim::dimensionless, 1, 100}},
    NamedUnit{"ppm", {dim::dimensionless, 1, 1e6}},
};

constexpr std::array prefixes = {Prefix{"n", 1, 1e9}, Prefix{"u", 1, 1e6}, Prefix{"m", 1, 1e3},
                                 Prefix{"k", 1e3, 1}, Prefix{"M", 1e6, 1}, Prefix{"G", 1e9, 1}};

constexpr std::array usual_prefixed = {"mm",  "um",  "kg",  "ms",  "mK", "mA",   "kW",   "mW",   "kJ",   "kN",
                                       "kPa", "MPa", "GPa", "kHz", "mV", "mbar", "mrad", "urad", "degC", "degF"};

Unit times(Unit const& a, Unit const& b, int power) {
  auto const raised = [power](double x) { return std::pow(x, std::abs(power)); };
  Dimension const& d = b.dimension;
  Dimension const product{a.dimension.length + power * d.length, a.dimension.mass + power * d.mass,
                          a.dimension.time + power * d.time, a.dimension.temperature + power * d.temperature,
                          a.dimension.current + power * d.current};
  double const over = power > 0 ? b.numerator : b.denominator;
  double const under = power > 0 ? b.denominator : b.numerator;
  double const numerator = a.numerator * raised(over), denominator = a.denominator * raised(under);
  if (numerator == denominator) return {product, 1.0, 1.0};  // kg: no rounding on the way to and from SI
  return {product, numerator, denominator};
}

std::vector<std::string> known_symbols() {
  std::vector<std::string> symbols;
  for (NamedUnit const& named : named_units) symbols.emplace_back(named.symbol);
  symbols.insert(symbols.end(), usual_prefixed.begin(), usual_prefixed.end());
  return symbols;
}

NamedUnit const* find_symbol(std::string_view symbol) {
  auto const found = std::find_if(named_units.begin(), named_units.end(),
                                  [&](NamedUnit const& named) { return named.symbol == symbol; });
  return found == named_units.end() ? nullptr : &*found;
}

/// A symbol and its prefix, or null; without a symbol it is no unit.
struct PrefixedUnit {
  NamedUnit const* named = nullptr;
  Prefix const* prefix = nullptr;
};

PrefixedUnit find_unit(std::string_view name) {
  if (NamedUnit const* named = find_symbol(name)) return {named};
  for (Prefix const& prefix : prefixes) {
    if (!name.starts_with(prefix.symbol)) continue;
    NamedUnit const* named = find_symbol(name.substr(prefix.symbol.size()));
    if (named != nullptr && named->takes_prefix) return {named, &prefix};
  }
  return {};
}

/// Reads one unit, left to right; `text` is the whole quantity, for messages.
class UnitReader {
 public:
  UnitReader(std::string_view text, std::string_view unit, std::span<std::string_view const> usual)
      : text_(text), rest_(unit), usual_(usual) {}

  Unit read() {
    skip_spaces();
    whole_ = rest_;
    if (rest_ == "degC") return celsius;
    if (rest_ == "degF") return fahrenheit;
    Unit const unit = product();
    if (!rest_.empty()) fail("unexpected '" + std::string(rest_) + "'");
    bool const counts_turns = unit.dimension == dim::angular_speed && !of_angle_;
    return counts_turns ? times(unit, {dim::angle, turn}, 1) : unit;
  }

 private:
  Unit product() {
    Unit result = factor(Unit{}, 1);
    bool divided = false;
    for (skip_spaces(); !rest_.empty() && rest_.front() != ')'; skip_spaces()) {
      bool const over = accept('/');
      if (!over) accept('*');
      if (!over && divided) fail("put what is below the line in parentheses, as in \"8 W/(m2 K)\"");
      divided = divided || over;
      result = factor(result, over ? -1 : 1);
    }
    return result;
  }

  Unit factor(Unit const& left, int sign) {
    skip_spaces();
    Unit base;
    if (accept('(')) {
      base = product();
      if (!accept(')')) fail("a ')' is missing");
    } else {
      base = symbol();
    }
    return times(left, base, sign * exponent());
  }

  Unit symbol() {
    std::string_view const here = rest_;
    bool const one = accept('1');
    if (!rest_.empty() && std::string_view(one ? "0123456789.^-" : "0123456789").find(rest_.front()) != here.npos)
      fail("unexpected '" + std::string(here) + "'; " +
           std::string(here.size() == whole_.size() ? "a number is written without spaces" : one_of_each));
    if (one) return {};
    std::size_t length = 0;
    while (length < rest_.size() && (std::isalpha(static_cast<unsigned char>(rest_[length])) || rest_[length] == '%')) {
      ++length;
    }
    if (length == 0) fail(rest_.empty() ? "the unit ends too early" : "unexpected '" + std::string(rest_) + "'");
    std::string_view const name = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return look_up(name);
  }

  Unit look_up(std::string_view name) {
    if (name == "degC" || name == "degF")
      fail(std::string(name) + " is a point on the scale; in a compound unit write K");
    if (auto const [named, prefix] = find_unit(name); named != nullptr)
      return prefix ? times(taken(*named), {dim::dimensionless, prefix->numerator, prefix->denominator}, 1)
                    : taken(*named);
    std::string_view const before_kelvin = name.substr(0, name.size() - 1);
    if (name.size() < whole_.size() && name.ends_with('K') && find_unit(before_kelvin).named)
      fail("unknown unit '" + std::string(name) + "'; per both is '/(" + std::string(before_kelvin) + " K)'");
    fail("unknown unit '" + std::string(name) + "'; " + offer(name));
  }

  Unit taken(NamedUnit const& named) {
    of_angle_ = of_angle_ || named.of_angle;
    return named.unit;
  }

  std::string offer(std::string_view name) const {
    bool const alone = name == whole_ && !usual_.empty();
    auto const known = alone ? std::vector<std::string>(usual_.begin(), usual_.end()) : known_symbols();
    std::string const scale = "deg" + std::string(name);
    bool const on_scale = std::find(known.begin(), known.end(), scale) != known.end();
    return on_scale ? "did you mean '" + scale + "'?" : did_you_mean(name, known);
  }

  int exponent() {
    bool const marked = accept('^');
    int power = 1;
    auto const [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), power);
    if (error != std::errc() && marked) fail("an integer is due after '^'");
    if (error == std::errc()) rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    if (power == 0 || power < -6 || power > 6)
      fail("an exponent is 1 to 6 or -6 to -1" + (marked ? "" : "; " + std::string(one_of_each)));
    return power;
  }

  bool accept(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void skip_spaces() {
    while (accept(' ')) {
    }
  }

  [[noreturn]] void fail(std::string const& why) const { throw InputError("'" + std::string(text_) + "': " + why); }

  std::string_view text_;
  std::string_view rest_;
  std::string_view whole_;
  std::span<std::string_view const> usual_;
  bool of_angle_ = false;  ///< one of its symbols is
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

}  // namespace

double Unit::si(double number) const { return (number + zero) * numerator / denominator; }

double Unit::number(double si) const { return si * denominator / numerator - zero; }

Unit read_unit(std::string_view unit, std::string_view text, std::span<std::string_view const> usual) {
  return UnitReader(text, unit, usual).read();
}

std::string in_ascii(std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 13> signs = {{{"\u00b5", "u"},
                                                                                           {"\u03bc", "u"},
                                                                                           {"\u00b0C", "degC"},
                                                                                           {"\u00b0", "deg"},
                                                                                           {"\u00b2", "2"},
                                                                                           {"\u00b3", "3"},
                                                                                           {"\u207b", "-"},
                                                                                           {"\u00b9", "1"},
                                                                                           {"\u00b7", "*"},
                                                                                           {"\u03a9", "ohm"},
                                                                                           {"\u2126", "ohm"},
                                                                                           {"\u00a0", " "},
                                                                                           {"\u202f", " "}}};
  std::string result(text);
  for (auto const& [sign, letters] : signs) {
    for (auto at = result.find(sign); at != std::string::npos; at = result.find(sign, at + letters.size())) {
      result.replace(at, sign.size(), letters);
    }
  }
  return std::string(trimmed(result));
}

}  // namespace thermotwin::thermal
