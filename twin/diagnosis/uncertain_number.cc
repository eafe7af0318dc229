#include "twin/diagnosis/uncertain_number.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "thermal/lubricant.h"
#include "twin/effect.h"
#include "twin/file/document.h"
#include "twin/sensitivity.h"
#include "twin/uncertain_range.h"

namespace thermotwin::twin {
namespace {

namespace dimension = thermal::dimension;

constexpr double inlet_deviation = 0.3;  // [K]
constexpr char const* viscous_exponent = "viscous_exponent";

std::optional<double> deviation_of(std::string const& table, std::string const& key, thermal::Dimension const& of) {
  bool const friction = key == "grease_factor" || (table == "ball_nut" && key == "preload");
  if (friction || of == dimension::torque) return 0.25;
  if (of == dimension::volume_flow || key == "resistance") return 0.20;
  if (table == "film" && (key == "area" || key == "coefficient" || key == "factor")) return 0.20;
  if (of == dimension::conductance || of == dimension::film_coefficient) return 0.30;
  if (of == dimension::power) return 0.25;
  if (key == "viscosity_temperature") return 0.04;
  if (key == viscous_exponent) return 0.30;
  if (key == "mass" || key == "heat_capacity" || key == "capacity_factor" || key == "growth_factor") return 0.10;
  return std::nullopt;
}

/// "W/K" of "9 W/K".
std::string unit_of(Value const& value) {
  if (!value.is_text()) return "";
  auto const& text = std::get<std::string>(value.content);
  auto const space = text.find(' ');
  return space == std::string::npos ? "" : text.substr(space + 1);
}

bool is_list_of_tables(Value const& value) {
  return value.is_list() && !std::get<Value::List>(value.content).empty() &&
         std::get<Value::List>(value.content).front().is_table();
}

void add_numbers(Value const& document, std::string const& kind, Value const& table,
                 std::vector<UncertainNumber>& numbers) {
  Value const* name = table.find("name");
  if (!name || !name->is_text()) return;
  std::string const prefix = kind + "." + std::get<std::string>(name->content) + ".";
  for (auto const& entry : std::get<Value::Table>(table.content)) {
    Parameter parameter;
    try {
      parameter = find_number(document, prefix + entry.key);
    } catch (thermal::InputError const&) {
      continue;  // a text, a list
    }
    if (entry.key == "inlet_offset")
      numbers.push_back({.path = parameter.path,
                         .nominal = parameter.value,
                         .dimension = parameter.dimension,
                         .deviation = inlet_deviation,
                         .unit = unit_of(entry.value),
                         .of_either_sign = true});
    auto const deviation = deviation_of(kind, entry.key, parameter.dimension);
    if (deviation && parameter.value > 0.0 && !parameter.absolute_temperature)
      numbers.push_back({.path = parameter.path,
                         .nominal = parameter.value,
                         .dimension = parameter.dimension,
                         .deviation = *deviation,
                         .unit = unit_of(entry.value),
                         .of_law = entry.key == "viscosity_temperature" || entry.key == viscous_exponent});
  }
}

bool is_nothing(Value const& value) {
  auto const* number = std::get_if<double>(&value.content);
  auto const* whole = std::get_if<std::int64_t>(&value.content);
  return (number && *number == 0.0) || (whole && *whole == 0);
}

void add_factor(Value& table, char const* key, double factor = 1.0) {
  if (!table.find(key)) std::get<Value::Table>(table.content).push_back({key, table.where, {table.where, factor}});
}

/// A grease has a slope of viscosity of its own and drags with a power of its own, the lower the more it is sheared
/// (SKF: 0.6 while cold and slow, 0.3 at full speed); balls that roll conduct otherwise than balls at rest.
void add_of_bearing(Value const& document, Value& table, std::vector<UncertainNumber>& numbers) {
  Value const* oil = table.find("oil");
  auto const* grade = oil ? std::get_if<std::int64_t>(&oil->content) : nullptr;
  if (!table.find("viscosity_temperature"))
    set_key(table, "viscosity_temperature",
            thermal::format_quantity(thermal::mineral_oil_viscosity(grade ? int(*grade) : 22).temperature,
                                     dimension::temperature_difference));
  add_factor(table, viscous_exponent, 2.0 / 3.0);
  std::string const path = "bearing." + name_in(table) + ".conductance";
  double const conductance = find_number(document, path).value;
  if (conductance <= 0.0 || table.find("conductance_speed")) return;
  set_key(table, "conductance_speed", "0 W/K");
  numbers.push_back({.path = path + "_speed",
                     .nominal = 0.0,
                     .dimension = dimension::conductance,
                     .deviation = 0.1 * conductance,
                     .unit = "W/K",
                     .of_either_sign = true,
                     .lower = -0.8 * conductance,
                     .of_law = true});
}

/// What is left to its default, of conductances.
void add_defaults(Effect const& effect, Value& table) {
  for (auto const& field : effect.parameters)
    if (field.dimension == dimension::conductance && !field.initial.empty() && field.initial != "required" &&
        !table.find(field.key))
      set_key(table, field.key, field.initial);
}

/// Every step of the structural loop may do more or less than it was computed to.
void add_growth(Value& channel, std::string const& kind, Value const& document, std::vector<UncertainNumber>& numbers) {
  Value* segments = channel.find("segment");
  Value const* name = channel.find("name");
  if (!segments || !is_list_of_tables(*segments) || !name) return;
  auto& list = std::get<Value::List>(segments->content);
  for (std::size_t i = 0; i < list.size(); ++i) {
    Value* weight = list[i].find("weight");
    bool const unknown = weight && is_nothing(*weight);
    if (unknown) weight->content = 0.0;  // not a whole number: it can change
    char const* key = unknown ? "weight" : "growth_factor";
    add_factor(list[i], key);
    UncertainNumber number;
    number.path = fmt::format("{}.{}.segment.{}.{}", kind, std::get<std::string>(name->content), i, key);
    number.nominal = unknown ? 0.0 : find_number(document, number.path).value;
    number.deviation = unknown ? 1.0 : 0.10;
    number.of_either_sign = unknown;
    numbers.push_back(std::move(number));
  }
}

void set_range(Value& document, RangedNumber const& range, std::vector<UncertainNumber>& numbers) {
  auto it = std::find_if(numbers.begin(), numbers.end(), [&](auto const& n) { return n.path == range.number.path; });
  if (it == numbers.end()) {
    if (range.number.absolute_temperature) return;
    auto const [table, key] = find_parameter(document, range.number.path);
    it = numbers.insert(
        it, {range.number.path, range.number.value, range.number.dimension, 0.0, unit_of(*table->find(key))});
    it->of_any_kind = true;
  }
  it->of_either_sign = it->of_either_sign || range.low <= 0.0;
  auto const end = [&](double at) { return it->of_either_sign ? at - it->nominal : std::log(at / it->nominal); };
  it->lower = end(range.low);
  it->upper = end(range.high);
  it->of_law = false;
  it->deviation = (it->upper - it->lower) / std::sqrt(12.0);
}

}  // namespace

double UncertainNumber::value(double x) const { return of_either_sign ? nominal + x : nominal * std::exp(x); }

double UncertainNumber::slope(double x) const { return of_either_sign ? 1.0 : value(x); }

std::vector<UncertainNumber> uncertain_numbers(Value& document) {
  std::vector<UncertainNumber> numbers;
  auto const with_tables = [&](std::string const& kind, auto action) {
    Value* tables = document.find(kind);
    if (tables && is_list_of_tables(*tables))
      for (auto& table : std::get<Value::List>(tables->content)) action(table);
  };
  for (std::string const kind : {"bar", "hollow_cylinder"})
    with_tables(kind, [](Value& table) { add_factor(table, "capacity_factor"); });
  for (std::string const kind : {"lump", "bar", "hollow_cylinder", "block"})
    with_tables(kind, [&](Value& table) { add_numbers(document, kind, table, numbers); });
  with_tables("film", [](Value& film) {  // as uncertain as its correlation
    if (!film.find("area") && !film.find("coefficient")) add_factor(film, "factor");
  });
  with_tables("bearing", [&](Value& table) { add_of_bearing(document, table, numbers); });
  for (auto const& entry : effect_catalogue()) {
    with_tables(entry.name, [&](Value& table) { add_defaults(entry, table); });
    with_tables(entry.name, [&](Value& table) { add_numbers(document, entry.name, table, numbers); });
  }
  for (std::string const kind : {"rotation", "displacement"})
    with_tables(kind, [&](Value& table) { add_growth(table, kind, document, numbers); });
  with_tables("ball_screw", [&](Value& table) {
    add_factor(table, "growth_factor");
    add_numbers(document, "ball_screw", table, numbers);
  });
  if (!has_drawings(numbers))
    std::erase_if(numbers, [](auto const& number) { return number.path.ends_with(viscous_exponent); });
  for (auto const& range : ranged_numbers(document)) set_range(document, range, numbers);
  return numbers;
}

bool has_drawings(std::vector<UncertainNumber> const& numbers) {
  return std::none_of(numbers.begin(), numbers.end(), [](auto const& number) { return number.is_any_step(); });
}

}  // namespace thermotwin::twin
