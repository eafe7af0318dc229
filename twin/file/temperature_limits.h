#pragma once

#include <algorithm>
#include <fmt/format.h>
#include <vector>

#include "thermal/machine_temperature.h"
#include "twin/file/schema.h"

namespace thermotwin::twin {

/// FileError for a temperature of a table, or of one in it, that no machine has; `fields`: of the struct that it fills.
inline void check_temperatures(Value const& table, std::vector<FieldRecord> const& fields) {
  for (auto const& [key, where, value] : std::get<Value::Table>(table.content)) {
    auto const field = std::find_if(fields.begin(), fields.end(), [&key = key](auto const& f) { return f.key == key; });
    if (field == fields.end()) continue;
    if (value.is_table()) check_temperatures(value, field->nested);
    if (value.is_list())
      for (auto const& item : std::get<Value::List>(value.content))
        if (item.is_table()) check_temperatures(item, field->nested);
    if (!field->is_temperature() || !value.is_text()) continue;
    auto const& text = std::get<std::string>(value.content);
    try {
      thermal::require_machine_temperature(thermal::parse_temperature(text), text);
    } catch (thermal::InputError const& error) {
      throw FileError(value.where, fmt::format("'{}': {}", key, error.what()));
    }
  }
}

}  // namespace thermotwin::twin
