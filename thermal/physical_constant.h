#pragma once

namespace thermotwin::thermal {

inline constexpr double zero_celsius = 273.15;              ///< [K]
inline constexpr double reference_temperature = 293.15;     ///< 20 °C, where tables of properties are anchored [K]
inline constexpr double stefan_boltzmann = 5.670374419e-8;  ///< CODATA 2018 [W/(m² K⁴)]
inline constexpr double gravity = 9.81;                     ///< [m/s²]
inline constexpr double gas_constant_air = 287.06;          ///< of dry air [J/(kg K)]
inline constexpr double gas_constant_water_vapour = 461.5;  ///< [J/(kg K)]

}  // namespace thermotwin::thermal
