#include "twin/diagnosis/estimate_text.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

#include "thermal/units.h"

namespace thermotwin::twin {

std::string readable_unit(double si, thermal::Dimension dimension) {
  if (dimension == thermal::Dimension{}) return "";
  double const least = dimension == thermal::dimension::time ? 1.0 : 0.1;  // no tenths of a minute
  for (auto const unit : thermal::usual_units(dimension)) {
    double const number = std::abs(thermal::to_unit(si, unit));
    if (number >= least && number < 1e4) return std::string(unit);
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

std::vector<ChangedValue> changed_numbers(Estimation const& estimation, Fit const& fit) {
  std::vector<ChangedValue> changes;
  for (std::size_t u = 0; u < estimation.unknowns().size(); ++u) {
    auto const& unknown = estimation.unknowns()[u];
    auto const i = Eigen::Index(u);
    if (unknown.kind == Unknown::Kind::number)
      changes.push_back(changed_value(estimation.numbers()[unknown.index], fit.x[i], std::sqrt(fit.covariance(i, i))));
  }
  return changes;
}

std::vector<ChangedValue> changed_lags(Estimation const& estimation, Fit const& fit) {
  auto const sensors = estimation.machine_at(fit.x).sensors;
  std::vector<ChangedValue> changes;
  for (std::size_t u = 0; u < estimation.unknowns().size(); ++u) {
    auto const& unknown = estimation.unknowns()[u];
    auto const i = Eigen::Index(u);
    if (unknown.kind != Unknown::Kind::lag) continue;
    auto const& channel = estimation.channels()[unknown.index];
    for (auto const& sensor : sensors)
      if (sensor.description.name == channel)
        changes.push_back({"temperature_sensor." + channel + ".lag", written_value(*sensor.description.lag, "s"),
                           written_interval(std::sqrt(fit.covariance(i, i)), "s")});
  }
  return changes;
}

}  // namespace thermotwin::twin
