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
  /// An angle equals a number, and is called an angle where one is due: of a part that turns, or of one slightly askew.
  enum class Turn { none, wide, slight } turn = Turn::none;

  constexpr bool operator==(Dimension const& other) const {
    return length == other.length && mass == other.mass && time == other.time && temperature == other.temperature &&
           current == other.current;
  }
};

/// Dimensions by the names of the field. Those that share exponents are equal: torque = energy, viscosity =
/// diffusivity.
namespace dimension {
inline constexpr Dimension dimensionless{};
inline constexpr Dimension angle{0, 0, 0, 0, 0, Dimension::Turn::wide};
inline constexpr Dimension tilt{0, 0, 0, 0, 0, Dimension::Turn::slight};
inline constexpr Dimension length{1, 0, 0, 0, 0};
inline constexpr Dimension area{2, 0, 0, 0, 0};
inline constexpr Dimension volume{3, 0, 0, 0, 0};
inline constexpr Dimension curvature{-1, 0, 0, 0, 0};  ///< 1/m
inline constexpr Dimension second_moment{4, 0, 0, 0, 0};
inline constexpr Dimension mass{0, 1, 0, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0, 0};
inline constexpr Dimension angular_speed{0, 0, -1, 0, 0};  ///< rad/s; 1/s and Hz count revolutions
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

/// What messages call a dimension: "conductance", its SI unit "W/K", and a text to imitate, "9 W/K".
std::string name_of(Dimension dimension);
std::string unit_of(Dimension dimension);
std::string example_of(Dimension dimension);

/// The units in which people write such a quantity, best first; empty for a dimension without a name.
std::span<std::string_view const> usual_units(Dimension dimension);

}  // namespace thermotwin::thermal
