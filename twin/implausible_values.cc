#include "twin/implausible_values.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "thermal/units.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

constexpr double rounding = 1e-9;  ///< of a bound that is written in another unit

/// A point on the temperature scale [K]; none for what is no text.
std::optional<double> temperature_of(Value const& value) {
  if (!value.is_text()) return {};
  return thermal::parse_temperature(std::get<std::string>(value.content));
}

/// In SI; none for what is no number.
std::optional<double> number_of(Value const& value, thermal::Dimension dimension) {
  Value const table{value.where, Value::Table{{"", value.where, value}}};
  return number_in(table, "", dimension);
}

void find_implausible(Value const& table, std::vector<FieldRecord> const& fields, std::vector<std::string>& found) {
  for (auto const& entry : std::get<Value::Table>(table.content)) {
    auto const field = std::find_if(fields.begin(), fields.end(), [&](auto const& f) { return f.key == entry.key; });
    if (field == fields.end()) continue;
    for (auto const* item : items_of(entry.value)) {
      if (item->is_table()) find_implausible(*item, field->nested, found);
      if (field->range.empty()) continue;
      auto const number = field->is_temperature() ? temperature_of(*item) : number_of(*item, field->dimension);
      double const low = field->plausible.low, high = field->plausible.high;
      if (number && (*number < low - rounding * std::abs(low) || *number > high + rounding * std::abs(high)))
        found.push_back(fmt::format(
            "{}: '{}' is {}; outside what is plausible: {}{}", item->where.text(), entry.key, item->text(),
            field->range, item->is_text() ? thermal::doubt_of_unit(std::get<std::string>(item->content)) : ""));
    }
  }
}

}  // namespace

std::vector<std::string> implausible_values(Value const& document, std::vector<FieldRecord> const& fields) {
  std::vector<std::string> found;
  find_implausible(document, fields, found);
  return found;
}

}  // namespace thermotwin::twin
