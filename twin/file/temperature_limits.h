#pragma once

#include <algorithm>
#include <fmt/format.h>
#include <vector>

#include "thermal/physical_constant.h"
#include "twin/file/schema.h"

namespace thermotwin::twin {

/// FileError for a temperature of a table, or of one in it, outside its field's range; `fields`: of the struct that it
/// fills.
inline void check_temperatures(Value const& table, std::vector<FieldRecord> const& fields) {
  constexpr double rounding = 1e-9;  // of a bound that is written in another unit [K]
  for (auto const& [key, where, value] : std::get<Value::Table>(table.content)) {
    auto const field = std::find_if(fields.begin(), fields.end(), [&key = key](auto const& f) { return f.key == key; });
    if (field == fields.end()) continue;
    if (value.is_table()) check_temperatures(value, field->nested);
    if (value.is_list())
      for (auto const& item : std::get<Value::List>(value.content))
        if (item.is_table()) check_temperatures(item, field->nested);
    if (!field->is_temperature() || !value.is_text()) continue;
    auto const& text = std::get<std::string>(value.content);
    double const kelvin = thermal::parse_temperature(text);
    if (kelvin < field->plausible.low - rounding || kelvin > field->plausible.high + rounding)
      throw FileError(value.where, fmt::format("'{}': '{}' is {:.6g} degC; allowed is {}; is its unit right?", key,
                                               text, kelvin - thermal::zero_celsius, field->range));
  }
}

}  // namespace thermotwin::twin
