#pragma once

#include <string>

#include "thermal/operating_point.h"
#include "thermal/unit.h"
#include "thermal/units.h"

namespace thermotwin::twin {

/// In which unit an input channel is shown where people see it: rpm, degC, mm/min, mm.
inline std::string edge_unit(thermal::InputChannel const& channel) {
  if (channel.unit == "rad/s") return "rpm";
  if (channel.unit == "K") return channel.name.ends_with("offset") ? "K" : "degC";
  if (channel.unit == "m/s") return "mm/min";
  return channel.unit == "m" ? "mm" : channel.unit;
}

/// The same as a factor; read it once, not for every sample.
inline thermal::Unit read_edge_unit(std::string const& unit) {
  return unit == "1" ? thermal::Unit{} : thermal::read_unit(unit, unit);
}

/// In that unit, without the last bits that two conversions leave: 4000 rpm, not 3999.9999999999995.
inline double edge_value(double si, thermal::Unit const& unit) {
  return thermal::without_rounding(unit.number(si), unit.zero);
}

}  // namespace thermotwin::twin
