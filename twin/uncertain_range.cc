#include "twin/uncertain_range.h"

#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"
#include "twin/file/tables.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

constexpr double written_digits = 1e-3;  // of an end: a number that a fit left there is written with few digits

double end_of(std::string const& text, Parameter const& number) {
  if (!number.absolute_temperature) return thermal::parse_value(text, number.dimension);
  auto const quantity = thermal::parse_quantity(text);
  if (!quantity.absolute_temperature)
    throw InputError(fmt::format("'{}' is no temperature; write for example \"20 degC\"", text));
  return quantity.value;
}

RangedNumber ranged(Value const& document, UncertainRange const& range) {
  auto const number = find_number(document, range.name);
  RangedNumber const result{number, end_of(range.from, number), end_of(range.to, number)};
  if (!(result.low < result.high))
    throw InputError(
        fmt::format("the range from '{}' to '{}' is empty; 'from' is the lower end", range.from, range.to));
  if (number.value < result.low - written_digits * std::abs(result.low) ||
      number.value > result.high + written_digits * std::abs(result.high))
    throw InputError(fmt::format("'{}' is {} in this file, outside its range from '{}' to '{}'", range.name,
                                 number.absolute_temperature ? thermal::format_temperature(number.value)
                                                             : thermal::format_quantity(number.value, number.dimension),
                                 range.from, range.to));
  return result;
}

}  // namespace

std::vector<RangedNumber> ranged_numbers(Value const& document) {
  std::vector<RangedNumber> ranges;
  Tables tables(document);
  for (auto const& [range, table] : tables.read<UncertainRange>("uncertain")) {
    try {
      ranges.push_back(ranged(document, range));
    } catch (InputError const& error) {
      auto const place = place_of(*table, error.what());  // never that of the name
      throw FileError(place.line == table->where.line ? table->find("name")->where : place, error.what());
    }
  }
  return ranges;
}

}  // namespace thermotwin::twin
