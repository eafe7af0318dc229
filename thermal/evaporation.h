#pragma once

#include <cmath>

#include "thermal/physical_constant.h"
#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Evaporation of coolant from wet surfaces and tanks; wet surfaces settle 2 to 5 K below the room.
/// Source: physics.md §2.14.

inline constexpr Validity magnus_temperature{273.15, 333.15, "temperature of vapour [K]"};

/// p_s = 611.2 exp(17.62 T/(243.12 + T)) [Pa], T in °C here, in kelvin at the function. Source: Magnus.
template <class S>
S saturation_pressure(S const& temperature) {
  using std::exp;
  within<S>(magnus_temperature, temperature);
  S const t = temperature - zero_celsius;
  return 611.2 * exp(17.62 * t / (243.12 + t));
}

/// ρ = p_s/(461.5 T) [kg/m³]: water vapour at saturation.
template <class S>
S saturated_vapour_density(S const& temperature) {
  return saturation_pressure<S>(temperature) / (gas_constant_water_vapour * temperature);
}

/// Le^{−2/3} of water vapour in air, Le = 0.87; the reference machine with a tank (Set C) uses 0.9.
inline constexpr double lewis_factor = 1.0973;
inline constexpr double latent_heat_water = 2.45e6;         ///< h_fg [J/kg]
inline constexpr double volumetric_heat_air = 1.19 * 1007;  ///< ρ_a c_a [J/(m³ K)]

/// q = A h/(ρ_a c_a) Λ h_fg (ρ_s(T_w) − φ ρ_s(T_a)) (2.12) [W], Λ = Le^{−2/3}: heat that leaves the water; negative
/// when vapour condenses. A wet area [m²], h convective film [W/(m² K)], T_w, T_a [K], φ relative humidity 0…1.
template <class S>
S evaporation_heat(S const& area, S const& film, S const& lewis, S const& water, S const& air, S const& humidity) {
  S const excess = saturated_vapour_density<S>(water) - humidity * saturated_vapour_density<S>(air);
  return area * film / volumetric_heat_air * lewis * latent_heat_water * excess;
}

/// q'' = √((2.7 ΔT^{1/3})² + (3.8 v)²) (p_s(T_w) − φ p_s(T_a)) [W/m²], pressures in hPa, ΔT = max(T_w − T_a, 0), v wind
/// speed [m/s]: free and forced evaporation from a warm pond or tank. Source: Adams 1990.
inline constexpr Validity adams_wind{0.0, 5.0, "wind over a tank [m/s]"};

template <class S>
S pond_evaporation_flux(S const& water, S const& air, S const& humidity, S const& wind) {
  using std::cbrt;
  using std::sqrt;
  constexpr double kelvin_blend = 0.01;
  within<S>(adams_wind, wind);
  S const free = 2.7 * cbrt(smooth_positive<S>(water - air, kelvin_blend));
  S const forced = 3.8 * wind;
  S const excess_hPa = 0.01 * (saturation_pressure<S>(water) - humidity * saturation_pressure<S>(air));
  return sqrt(S(free * free + forced * forced)) * excess_hPa;
}

}  // namespace thermotwin::thermal
