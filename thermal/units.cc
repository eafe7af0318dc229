#include "thermal/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::thermal {
namespace {

constexpr double zero_degC = 273.15;

/// SI value = number · numerator / denominator: two factors, so that "250 um" is the double nearest to 250e-6.
struct Unit {
  Dimension dimension;
  double numerator = 1.0;
  double denominator = 1.0;
  bool absolute = false;
};

struct NamedUnit {
  std::string_view symbol;
  Unit unit;
  bool takes_prefix = false;
};

struct Prefix {
  std::string_view symbol;
  double numerator;
  double denominator;
};

/// How one dimension is spoken of; `usual` are the units offered by format_quantity, best first.
struct Usage {
  Dimension dimension;
  std::string_view name;
  std::string_view unit;
  std::string_view example;
  std::vector<std::string_view> usual;
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
    NamedUnit{"rad", {dim::angle}, true},
    NamedUnit{"bar", {dim::pressure, 1e5, 1}, true},
    NamedUnit{"cm", {dim::length, 1, 100}},
    NamedUnit{"hPa", {dim::pressure, 100, 1}},
    NamedUnit{"cSt", {dim::viscosity, 1, 1e6}},
    NamedUnit{"min", {dim::time, 60, 1}},
    NamedUnit{"h", {dim::time, 3600, 1}},
    NamedUnit{"day", {dim::time, 86400, 1}},
    NamedUnit{"rpm", {dim::angular_speed, 2 * std::numbers::pi, 60}},
    NamedUnit{"deg", {dim::angle, std::numbers::pi, 180}},
    NamedUnit{"arcsec", {dim::angle, std::numbers::pi, 648000}},
    NamedUnit{"L", {dim::volume, 1, 1000}},
    NamedUnit{"l", {dim::volume, 1, 1000}},
    NamedUnit{"%", {dim::dimensionless, 1, 100}},
    NamedUnit{"ppm", {dim::dimensionless, 1, 1e6}},
};

constexpr std::array prefixes = {Prefix{"n", 1, 1e9}, Prefix{"u", 1, 1e6}, Prefix{"m", 1, 1e3},
                                 Prefix{"k", 1e3, 1}, Prefix{"M", 1e6, 1}, Prefix{"G", 1e9, 1}};

constexpr std::array usual_prefixed = {"mm",  "um",  "kg",  "ms",  "mK", "mA",   "kW",   "mW",   "kJ",  "kN",
                                       "kPa", "MPa", "GPa", "kHz", "mV", "mbar", "mrad", "urad", "degC"};

Unit times(Unit const& a, Unit const& b, int power) {
  auto const raised = [power](double x) { return std::pow(x, std::abs(power)); };
  Dimension const& d = b.dimension;
  Dimension const product{a.dimension.length + power * d.length, a.dimension.mass + power * d.mass,
                          a.dimension.time + power * d.time, a.dimension.temperature + power * d.temperature,
                          a.dimension.current + power * d.current};
  double const over = power > 0 ? b.numerator : b.denominator;
  double const under = power > 0 ? b.denominator : b.numerator;
  return {product, a.numerator * raised(over), a.denominator * raised(under)};
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

/// Reads one unit, left to right; `text` is the whole quantity, for messages.
class UnitReader {
 public:
  UnitReader(std::string_view text, std::string_view unit) : text_(text), rest_(unit) {}

  Unit read() {
    if (rest_ == "degC") return {dim::temperature_difference, 1, 1, true};
    Unit const unit = product();
    if (!rest_.empty()) fail("unexpected '" + std::string(rest_) + "'");
    return unit;
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
    if (accept('1')) return {};
    std::size_t length = 0;
    while (length < rest_.size() && (std::isalpha(static_cast<unsigned char>(rest_[length])) || rest_[length] == '%')) {
      ++length;
    }
    if (length == 0) fail(rest_.empty() ? "the unit ends too early" : "unexpected '" + std::string(rest_) + "'");
    std::string_view const name = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return look_up(name);
  }

  Unit look_up(std::string_view name) const {
    if (name == "degC") fail("degC is a point on the scale; in a compound unit write K");
    if (NamedUnit const* named = find_symbol(name)) return named->unit;
    for (Prefix const& prefix : prefixes) {
      if (!name.starts_with(prefix.symbol)) continue;
      NamedUnit const* named = find_symbol(name.substr(prefix.symbol.size()));
      if (named == nullptr || !named->takes_prefix) continue;
      return times(named->unit, {dim::dimensionless, prefix.numerator, prefix.denominator}, 1);
    }
    fail("unknown unit '" + std::string(name) + "'; " + did_you_mean(name, known_symbols()));
  }

  int exponent() {
    bool const marked = accept('^');
    int power = 1;
    auto const [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), power);
    if (error != std::errc() && marked) fail("an integer is due after '^'");
    if (error == std::errc()) rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    if (power == 0 || std::abs(power) > 6) fail("an exponent is 1 to 6 or -6 to -1");
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
};

/// Writes the usual non-ASCII signs in letters: µ, °C, ², ³, ·, Ω.
std::string plain(std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> signs = {{{"\u00b5", "u"},
                                                                                          {"\u03bc", "u"},
                                                                                          {"\u00b0C", "degC"},
                                                                                          {"\u00b0", "deg"},
                                                                                          {"\u00b2", "2"},
                                                                                          {"\u00b3", "3"},
                                                                                          {"\u00b7", "*"},
                                                                                          {"\u03a9", "ohm"},
                                                                                          {"\u2126", "ohm"}}};
  std::string result(text);
  for (auto const& [sign, letters] : signs) {
    for (auto at = result.find(sign); at != std::string::npos; at = result.find(sign, at + letters.size())) {
      result.replace(at, sign.size(), letters);
    }
  }
  return result;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

Unit read_unit(std::string_view unit) {
  std::string const letters = plain(unit);
  return UnitReader(unit, trimmed(letters)).read();
}

double apply(Unit const& unit, double number) {
  return unit.absolute ? number + zero_degC : number * unit.numerator / unit.denominator;
}

double apply_inverse(Unit const& unit, double si) {
  return unit.absolute ? si - zero_degC : si * unit.denominator / unit.numerator;
}

std::vector<Usage> const& usages() {
  static std::vector<Usage> const table = {
      {dim::dimensionless, "number", "1", "0.8", {"1"}},
      {dim::length, "length", "m", "600 mm", {"mm", "um", "m"}},
      {dim::area, "area", "m2", "0.06 m2", {"m2", "mm2"}},
      {dim::volume, "volume", "m3", "200 L", {"L", "m3", "mm3"}},
      {dim::curvature, "curvature", "1/m", "1e-6 1/m", {"1/m"}},
      {dim::second_moment, "second moment of area", "m4", "1e-4 m4", {"m4", "mm4"}},
      {dim::mass, "mass", "kg", "14 kg", {"kg", "g"}},
      {dim::time, "time", "s", "15 min", {"min", "s", "h", "day"}},
      {dim::angular_speed, "angular speed", "rad/s", "6000 rpm", {"rpm", "rad/s"}},
      {dim::speed, "speed", "m/s", "8000 mm/min", {"mm/min", "m/s"}},
      {dim::acceleration, "acceleration", "m/s2", "9.81 m/s2", {"m/s2"}},
      {dim::density, "density", "kg/m3", "7850 kg/m3", {"kg/m3"}},
      {dim::force, "force", "N", "1500 N", {"N", "kN"}},
      {dim::torque, "torque", "N m", "0.45 N m", {"N m"}},
      {dim::power, "power", "W", "40 W", {"W", "kW", "mW"}},
      {dim::stiffness, "stiffness", "N/m", "0.9 kN/um", {"kN/um", "N/um", "N/m"}},
      {dim::pressure, "pressure", "Pa", "210 GPa", {"bar", "GPa", "MPa", "kPa", "Pa"}},
      {dim::viscosity, "kinematic viscosity", "m2/s", "32 mm2/s", {"mm2/s", "m2/s"}},
      {dim::dynamic_viscosity, "dynamic viscosity", "Pa s", "1 mPa s", {"mPa s", "Pa s"}},
      {dim::volume_flow, "volume flow", "m3/s", "8 L/min", {"L/min", "L/h", "m3/s"}},
      {dim::mass_flow, "mass flow", "kg/s", "1.2 kg/s", {"kg/s", "g/s"}},
      {dim::temperature_difference, "temperature difference", "K", "0.2 K", {"K", "mK"}},
      {dim::temperature_gradient, "temperature gradient", "K/m", "1.5 K/m", {"K/m"}},
      {dim::temperature_rate, "temperature rate", "K/s", "3 K/day", {"K/h", "K/day", "K/min", "K/s"}},
      {dim::expansion, "thermal expansion", "1/K", "11.8 um/(m K)", {"um/(m K)", "1/K"}},
      {dim::growth_per_kelvin, "growth per kelvin", "m/K", "0.5 um/K", {"um/K", "m/K"}},
      {dim::conductance, "conductance", "W/K", "9 W/K", {"W/K"}},
      {dim::conductivity, "conductivity", "W/(m K)", "42 W/(m K)", {"W/(m K)"}},
      {dim::film_coefficient, "film coefficient", "W/(m2 K)", "8 W/(m2 K)", {"W/(m2 K)", "kW/(m2 K)"}},
      {dim::heat_flux, "heat flux", "W/m2", "100 W/m2", {"W/m2", "kW/m2"}},
      {dim::heat_density, "heat density", "W/m3", "1e5 W/m3", {"W/m3", "kW/m3"}},
      {dim::heat_capacity, "heat capacity", "J/K", "169 J/K", {"J/K", "kJ/K"}},
      {dim::specific_heat, "specific heat", "J/(kg K)", "460 J/(kg K)", {"J/(kg K)"}},
      {dim::latent_heat, "latent heat", "J/kg", "2450 kJ/kg", {"kJ/kg", "J/kg"}},
      {dim::current, "current", "A", "1.6 A", {"A", "mA"}},
      {dim::voltage, "voltage", "V", "24 V", {"V", "mV"}},
      {dim::resistance, "resistance", "ohm", "0.8 ohm", {"ohm"}},
      {dim::torque_constant, "torque constant", "N m/A", "1.6 N m/A", {"N m/A"}},
  };
  return table;
}

Usage const* usage_of(Dimension dimension) {
  auto const found =
      std::find_if(usages().begin(), usages().end(), [&](Usage const& usage) { return usage.dimension == dimension; });
  return found == usages().end() ? nullptr : &*found;
}

std::string base_units(Dimension const& d) {
  std::array<std::pair<std::string_view, int>, 5> const bases = {
      {{"m", d.length}, {"kg", d.mass}, {"s", d.time}, {"K", d.temperature}, {"A", d.current}}};
  std::string text;
  for (auto const& [symbol, power] : bases) {
    if (power == 0) continue;
    text += (text.empty() ? "" : " ") + std::string(symbol) + (power == 1 ? "" : "^" + std::to_string(power));
  }
  return text;
}

/// Fewest digits before `unit` that give back `si` exactly; empty if even 17 do not.
std::string exact_number(double si, Unit const& unit) {
  double const number = apply_inverse(unit, si);
  std::array<char, 64> buffer{};
  for (int digits = 1; digits <= 17; ++digits) {
    auto const end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, std::chars_format::general, digits).ptr;
    double back = 0.0;
    std::from_chars(buffer.data(), end, back);
    if (apply(unit, back) == si) return format_number(back);
  }
  return {};
}

std::string best_text(double si, std::span<std::string_view const> units) {
  std::string best;
  std::size_t best_cost = 1000;
  for (std::string_view const symbol : units) {
    Unit const unit = read_unit(symbol);
    std::string const number = exact_number(si, unit);
    if (number.empty()) continue;
    double const size = std::abs(apply_inverse(unit, si));
    bool const handy = size >= 1.0 && size < 1e5;
    std::size_t const cost = number.size() + (handy || unit.absolute ? 0 : 3);
    if (cost >= best_cost) continue;
    best_cost = cost;
    best = symbol == "1" ? number : number + " " + std::string(symbol);
  }
  return best;
}

std::string mismatch(std::string_view text, Quantity const& quantity, Dimension expected) {
  if (quantity.dimension == dim::dimensionless) return missing_unit(text, expected);
  return "'" + std::string(text) + "' is a " + name_of(quantity.dimension) + "; a " + name_of(expected) +
         " is due, for example \"" + example_of(expected) + "\"";
}

}  // namespace

Quantity parse_quantity(std::string_view text) {
  std::string const letters = plain(text);
  std::string_view rest = trimmed(letters);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double number = 0.0;
  auto const [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::result_out_of_range)
    throw InputError("'" + std::string(text) + "': beyond what a double holds");
  if (error != std::errc()) {
    throw InputError("'" + std::string(text) + "': a number with a unit is due, for example \"600 mm\"");
  }
  if (!std::isfinite(number)) throw InputError("'" + std::string(text) + "': a finite number is due");
  rest = trimmed(rest.substr(static_cast<std::size_t>(end - rest.data())));
  if (rest.empty()) return {number, dim::dimensionless, false};
  Unit const unit = UnitReader(text, rest).read();
  return {apply(unit, number), unit.dimension, unit.absolute};
}

double parse_value(std::string_view text, Dimension expected) {
  Quantity const quantity = parse_quantity(text);
  if (quantity.dimension != expected) throw InputError(mismatch(text, quantity, expected));
  if (quantity.absolute_temperature) {
    throw InputError("'" + std::string(text) +
                     "' is a point on the temperature scale; a difference is due, for example \"" +
                     example_of(expected) + "\"");
  }
  return quantity.value;
}

double parse_temperature(std::string_view text) {
  Quantity const quantity = parse_quantity(text);
  if (quantity.dimension == dim::dimensionless) {
    throw InputError(std::string(text) + " has no unit; write for example \"22 degC\"");
  }
  if (quantity.dimension != dim::temperature_difference) {
    throw InputError("'" + std::string(text) + "' is a " + name_of(quantity.dimension) +
                     "; a temperature is due, for example \"22 degC\"");
  }
  if (quantity.value < 0.0) throw InputError("'" + std::string(text) + "' is below absolute zero (-273.15 degC)");
  return quantity.value;
}

double to_unit(double si, std::string_view unit) { return apply_inverse(read_unit(unit), si); }

double from_unit(double number, std::string_view unit) { return apply(read_unit(unit), number); }

void to_unit(std::span<double> values, std::string_view unit) {
  Unit const read = read_unit(unit);
  for (double& value : values) value = apply_inverse(read, value);
}

void from_unit(std::span<double> numbers, std::string_view unit) {
  Unit const read = read_unit(unit);
  for (double& number : numbers) number = apply(read, number);
}

Dimension dimension_of(std::string_view unit) { return read_unit(unit).dimension; }

std::string name_of(Dimension dimension) {
  Usage const* usage = usage_of(dimension);
  return usage != nullptr ? std::string(usage->name) : "quantity in " + base_units(dimension);
}

std::string unit_of(Dimension dimension) {
  Usage const* usage = usage_of(dimension);
  return usage != nullptr ? std::string(usage->unit) : base_units(dimension);
}

std::string example_of(Dimension dimension) {
  Usage const* usage = usage_of(dimension);
  return usage != nullptr ? std::string(usage->example) : "1 " + base_units(dimension);
}

std::string missing_unit(std::string_view number, Dimension expected) {
  return std::string(number) + " has no unit; write for example \"" + example_of(expected) + "\"";
}

std::string format_number(double value) {
  std::array<char, 64> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string format_quantity(double si, Dimension dimension) {
  std::string const natural = unit_of(dimension);
  std::vector<std::string_view> units;
  if (Usage const* usage = usage_of(dimension)) units = usage->usual;
  units.push_back(natural);
  return best_text(si, units);
}

std::string format_temperature(double kelvin) {
  static constexpr std::array<std::string_view, 2> units = {"degC", "K"};
  return best_text(kelvin, units);
}

}  // namespace thermotwin::thermal
