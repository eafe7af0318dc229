#pragma once

#include <cmath>
#include <string>

#include "thermal/operating_point.h"
#include "thermal/units.h"

namespace thermotwin::twin {

/// In which unit an input channel is shown where people see it: rpm, degC, mm/min, mm.
inline std::string edge_unit(thermal::InputChannel const& channel) {
  if (channel.unit == "rad/s") return "rpm";
  if (channel.unit == "K") return channel.name.ends_with("offset") ? "K" : "degC";
  if (channel.unit == "m/s") return "mm/min";
  return channel.unit == "m" ? "mm" : channel.unit;
}

/// In that unit, without the last bits that two conversions leave: 4000 rpm, not 3999.9999999999995.
inline double edge_value(double si, std::string const& unit) {
  if (unit == "1") return si;
  double const number = thermal::to_unit(si, unit), given = std::round(1e9 * number) / 1e9;
  return thermal::from_unit(given, unit) == si ? given : number;
}

}  // namespace thermotwin::twin
