#pragma once

#include <span>
#include <string>
#include <string_view>

namespace thermotwin::thermal {

/// Exponents of the base units m, kg, s, K, A. An angle has none: rad = 1.
struct Dimension {
  int length = 0;
  int mass = 0;
  int time = 0;
  int temperature = 0;
  int current = 0;

  bool operator==(Dimension const&) const = default;
};

/// Dimensions by the names of the field. Those that share exponents are equal: torque = energy, viscosity =
/// diffusivity.
namespace dimension {
inline constexpr Dimension dimensionless{};
inline constexpr Dimension angle{};
inline constexpr Dimension length{1, 0, 0, 0, 0};
inline constexpr Dimension area{2, 0, 0, 0, 0};
inline constexpr Dimension volume{3, 0, 0, 0, 0};
inline constexpr Dimension curvature{-1, 0, 0, 0, 0};  ///< 1/m
inline constexpr Dimension second_moment{4, 0, 0, 0, 0};
inline constexpr Dimension mass{0, 1, 0, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0, 0};
inline constexpr Dimension angular_speed{0, 0, -1, 0, 0};  ///< rad/s, also Hz
inline constexpr Dimension speed{1, 0, -1, 0, 0};
inline constexpr Dimension acceleration{1, 0, -2, 0, 0};
inline constexpr Dimension density{-3, 1, 0, 0, 0};
inline constexpr Dimension force{1, 1, -2, 0, 0};
inline constexpr Dimension torque{2, 1, -2, 0, 0};
inline constexpr Dimension energy = torque;
inline constexpr Dimension power{2, 1, -3, 0, 0};
inline constexpr Dimension stiffness{0, 1, -2, 0, 0};  ///< N/m
inline constexpr Dimension pressure{-1, 1, -2, 0, 0};
inline constexpr Dimension stress = pressure;
inline constexpr Dimension viscosity{2, 0, -1, 0, 0};  ///< kinematic [m2/s]
inline constexpr Dimension dynamic_viscosity{-1, 1, -1, 0, 0};
inline constexpr Dimension volume_flow{3, 0, -1, 0, 0};
inline constexpr Dimension mass_flow{0, 1, -1, 0, 0};
inline constexpr Dimension temperature_difference{0, 0, 0, 1, 0};
inline constexpr Dimension temperature_gradient{-1, 0, 0, 1, 0};  ///< K/m
inline constexpr Dimension temperature_rate{0, 0, -1, 1, 0};      ///< K/s
inline constexpr Dimension expansion{0, 0, 0, -1, 0};             ///< 1/K
inline constexpr Dimension growth_per_kelvin{1, 0, 0, -1, 0};     ///< m/K
inline constexpr Dimension conductance{2, 1, -3, -1, 0};          ///< W/K
inline constexpr Dimension conductivity{1, 1, -3, -1, 0};         ///< W/(m K)
inline constexpr Dimension film_coefficient{0, 1, -3, -1, 0};     ///< W/(m2 K)
inline constexpr Dimension heat_flux{0, 1, -3, 0, 0};             ///< W/m2
inline constexpr Dimension heat_density{-1, 1, -3, 0, 0};         ///< W/m3
inline constexpr Dimension heat_capacity{2, 1, -2, -1, 0};        ///< J/K
inline constexpr Dimension specific_heat{2, 0, -2, -1, 0};        ///< J/(kg K)
inline constexpr Dimension latent_heat{2, 0, -2, 0, 0};           ///< J/kg
inline constexpr Dimension current{0, 0, 0, 0, 1};
inline constexpr Dimension voltage{2, 1, -3, 0, -1};
inline constexpr Dimension resistance{2, 1, -3, 0, -2};       ///< electric [ohm]
inline constexpr Dimension torque_constant{2, 1, -2, 0, -1};  ///< N m/A
}  // namespace dimension

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
/// Hz V ohm rad bar; besides cm hPa cSt min h day rpm deg arcsec L % ppm. degC stands alone. Text without a unit is
/// dimensionless. Throws InputError: "'8000 mm/mim': unknown unit 'mim'; did you mean 'min'?"
Quantity parse_quantity(std::string_view text);

/// As parse_quantity, and the value must have this dimension; a degC is refused where a difference is due.
/// Throws InputError with an example of what to write: "600 has no unit; write for example \"600 mm\"".
double parse_value(std::string_view text, Dimension expected);

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

/// What messages call a dimension: "conductance", its SI unit "W/K", and a text to imitate, "9 W/K".
std::string name_of(Dimension dimension);
std::string unit_of(Dimension dimension);
std::string example_of(Dimension dimension);

/// The error for a bare number where a unit is due: "600 has no unit; write for example \"600 mm\"".
std::string missing_unit(std::string_view number, Dimension expected);

/// Readable text that parses back to the same double: 0.6 m → "600 mm", 471.2… rad/s → "4500 rpm".
std::string format_quantity(double si, Dimension dimension);
/// The same for a point on the temperature scale: 295.15 K → "22 degC".
std::string format_temperature(double kelvin);

/// The shortest digits that read back as the same double: "0.1", "1e-05".
std::string format_number(double value);

}  // namespace thermotwin::thermal
