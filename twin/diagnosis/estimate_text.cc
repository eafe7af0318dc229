#include "twin/diagnosis/estimate_text.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

#include "thermal/units.h"

namespace thermotwin::twin {

std::string readable_unit(double si, thermal::Dimension dimension) {
  if (dimension == thermal::Dimension{}) return "";
  for (auto const unit : thermal::usual_units(dimension)) {
    double const number = std::abs(thermal::to_unit(si, unit));
    if (number >= 0.1 && number < 1e4) return std::string(unit);
  }
  return thermal::unit_of(dimension);
}

std::string written_value(double si, std::string const& unit, int digits) {
  double const number = unit.empty() ? si : thermal::to_unit(si, unit);
  std::string const text = thermal::format_number(std::strtod(fmt::format("{:.{}g}", number, digits).c_str(), nullptr));
  return unit.empty() ? text : text + ' ' + unit;
}

std::string written_interval(double standard_error, std::string const& unit) {
  return "± " + written_value(two_sided_95 * standard_error, unit, 2);
}

ChangedValue changed_value(UncertainNumber const& number, double x, double deviation) {
  double const value = number.value(x);
  return {number.path, written_value(value, number.unit),
          written_interval(std::abs(number.slope(x)) * deviation, number.unit)};
}

}  // namespace thermotwin::twin
