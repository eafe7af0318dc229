#pragma once

#include <span>
#include <string>
#include <string_view>

#include "thermal/dimension.h"

namespace thermotwin::thermal {

/// A number that was written with its unit.
struct Quantity {
  double value = 0.0;  ///< in SI base units; a temperature in kelvin
  Dimension dimension;
  bool absolute_temperature = false;  ///< written in degC: a point on the scale, never a difference
};

/// Reads "600 mm", "8000 mm/min", "8 W/(m2 K)", "6000 rpm", "22 degC", "25 %", "1e-4 1/K", "1.2 kN/um", "0.8".
///
/// Unit: symbols joined by a space or `*` (product) and `/` (quotient), parentheses, integer exponents (m2, m^2, s^-1).
/// A product after a quotient needs parentheses: "W/m2 K" is refused. Prefixes n u µ m k M G before m g s K A W J N Pa
/// Hz V ohm rad bar; besides cm hPa cSt min h day rpm rev U deg arcsec L % ppm. degC stands alone. Text without a unit
/// is dimensionless. What is only per time counts revolutions, since nothing else here is: "3000 1/min", "3000 min-1"
/// and "3000 U/min" are 3000 rpm, "50 Hz" and "50 1/s" are 50 rev/s. Throws InputError: "'8000 mm/mim': unknown unit
/// 'mim'; did you mean 'min'?"
Quantity parse_quantity(std::string_view text);

/// As parse_quantity, and the value must have this dimension; a degC is refused where a difference is due.
/// Throws InputError with an example of what to write: "600 has no unit; write for example \"600 mm\"".
double parse_value(std::string_view text, Dimension expected);

/// The end of a message about a quantity per mK, which is a millikelvin, where metre and kelvin may be meant:
/// "; mK is a millikelvin: per metre and kelvin is \"80 W/(m K)\""; empty for any other.
std::string doubt_of_unit(std::string_view text);

/// A point on the temperature scale [K], from "22 degC" or "295.15 K"; not below absolute zero.
double parse_temperature(std::string_view text);

/// The number that stands before `unit` for a value in SI, and back: to_unit(6e-4, "um") = 600, to_unit(293.15, "degC")
/// = 20.
double to_unit(double si, std::string_view unit);
double from_unit(double number, std::string_view unit);
/// The same for a whole column, in place.
void to_unit(std::span<double> values, std::string_view unit);
void from_unit(std::span<double> numbers, std::string_view unit);

Dimension dimension_of(std::string_view unit);

/// InputError, which offers the dimension's usual units, for a unit of another one.
void require_unit(std::string_view unit, Dimension expected);

/// The error for a bare number where a unit is due: "600 has no unit; write for example \"600 mm\"".
std::string missing_unit(std::string_view number, Dimension expected);

/// Readable text that parses back to the same double: 0.6 m → "600 mm", 471.2… rad/s → "4500 rpm".
std::string format_quantity(double si, Dimension dimension);
/// The same for a point on the temperature scale: 295.15 K → "22 degC".
std::string format_temperature(double kelvin);

/// The shortest digits that read back as the same double: "0.1", "1e-05".
std::string format_number(double value);

/// x without the last bits that arithmetic leaves, 20.33 for 20.330000000000002: the nearest number of twelve digits,
/// where it is within 4 ε of x, and x itself elsewhere. A difference has the last bits of its parts: `size` is theirs.
double without_rounding(double x, double size = 0.0);

}  // namespace thermotwin::thermal
