#pragma once

#include <string>

#include "thermal/operating_point.h"

namespace thermotwin::twin {

/// In which unit an input channel is shown where people see it: rpm, degC, mm/min, mm.
inline std::string edge_unit(thermal::InputChannel const& channel) {
  if (channel.unit == "rad/s") return "rpm";
  if (channel.unit == "K") return channel.name.ends_with("offset") ? "K" : "degC";
  if (channel.unit == "m/s") return "mm/min";
  return channel.unit == "m" ? "mm" : channel.unit;
}

}  // namespace thermotwin::twin
