#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "thermal/error.h"
#include "thermal/physical_constant.h"

namespace thermotwin::thermal {

/// What a room, a coolant or a machine may have [K], and what is said where it is not: a number with the unit of
/// another scale, "22 K", lies far outside.
inline constexpr double coldest_machine = 213.15, hottest_machine = 423.15;
inline constexpr std::string_view machine_temperatures = "allowed is -60 degC to 150 degC; is its unit right?";

[[nodiscard]] inline bool is_machine_temperature(double kelvin) {
  return kelvin >= coldest_machine && kelvin <= hottest_machine;
}

/// InputError "'22 K' is -251.15 degC; allowed is …" for a temperature that no machine has; `text`: as it was written.
inline void require_machine_temperature(double kelvin, std::string const& text) {
  if (is_machine_temperature(kelvin)) return;
  char celsius[32];
  std::snprintf(celsius, sizeof celsius, "%.6g", kelvin - zero_celsius);
  throw InputError("'" + text + "' is " + celsius + " degC; " + std::string(machine_temperatures));
}

}  // namespace thermotwin::thermal
