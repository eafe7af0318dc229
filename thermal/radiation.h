#pragma once

#include "thermal/physical_constant.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Radiation between grey diffuse surfaces; temperatures in kelvin. Source: physics.md §2.9.

/// ε₁₂ = ε₁ε₂/(1 − (1 − ε₁)(1 − ε₂) F₁₂F₂₁); a small body in a room:
/// F₂₁ → 0, and all walls together are black, ε₂ = 1: ε₁₂ = ε₁.
template <class S>
S exchange_emissivity(S const& emissivity1, S const& emissivity2, S const& view12, S const& view21) {
  return emissivity1 * emissivity2 / (1.0 - (1.0 - emissivity1) * (1.0 - emissivity2) * view12 * view21);
}

/// h = σ ε (T₁² + T₂²)(T₁ + T₂) [W/(m² K)]: exact, q = A F₁₂ h (T₂ − T₁) into body 1 is σ ε A F₁₂ (T₂⁴ − T₁⁴).
template <class S>
S radiation_film(S const& emissivity, S const& temperature1, S const& temperature2) {
  return stefan_boltzmann * emissivity * (temperature1 * temperature1 + temperature2 * temperature2) *
         (temperature1 + temperature2);
}

/// q = σ ε₁₂ A F₁₂ (T₂⁴ − T₁⁴) [W] into body 1; A its area [m²]. With a resistance R [K/W] between its surface and the
/// node of which T₁ is known: q = g (T₂ − T₁)/(1 + g R), g = A F₁₂ h(T₁, T₂), which is exact for R → 0.
template <class S>
S radiation_heat(S const& emissivity, S const& area, S const& view12, S const& temperature1, S const& temperature2,
                 S const& resistance = S(0.0)) {
  S const g = area * view12 * radiation_film<S>(emissivity, temperature1, temperature2);
  return g * (temperature2 - temperature1) / (1.0 + g * resistance);
}

/// h = 4σ ε 0.8 T_m³ [W/(m² K)]: a machine's surface of emissivity ε to the walls of a workshop, T_m mean of both [K].
inline constexpr Validity room_radiation_temperature{273.15, 373.15, "mean of surface and room, radiating [K]"};
inline constexpr double room_wall_emissivity = 0.8;

template <class S>
S room_radiation_film(S const& emissivity, S const& mean_temperature) {
  within<S>(room_radiation_temperature, mean_temperature);
  S const cube = mean_temperature * mean_temperature * mean_temperature;
  return 4.0 * stefan_boltzmann * room_wall_emissivity * emissivity * cube;
}

}  // namespace thermotwin::thermal
