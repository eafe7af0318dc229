#pragma once

#include <cmath>
#include <numbers>

#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Air friction of rotors: in the gap of a motor, and of discs in free air. Heat into the air and the walls [W].

/// Re_δ = ω r δ/ν of a gap [1].
template <class S>
S gap_reynolds(S const& angular_speed, S const& radius, S const& gap, S const& viscosity) {
  return angular_speed * radius * gap / viscosity;
}

inline constexpr Validity gap_windage_reynolds{0.0, 1e6, "Re of air friction in a gap"};

/// 1/√C_f = 2.04 + 1.768 ln(Re_δ √C_f): skin friction of a smooth rotor in a smooth turbulent gap. Source: Vrancik
/// 1968, NASA TN D-4849. Solved for z = ln(1/√C_f), e^z + 1.768 z = 2.04 + 1.768 ln Re_δ, by Newton: the left side is
/// convex and rises, so that eight steps from z = 2 give every digit for 1 < Re_δ < 1e8.
template <class S>
S vrancik_friction(S const& reynolds) {
  using std::exp;
  using std::log;
  S const right = 2.04 + 1.768 * log(reynolds);
  S z(2.0);
  for (int step = 0; step < 8; ++step) {
    S const inverse_root = exp(z);
    z -= (inverse_root + 1.768 * z - right) / (inverse_root + 1.768);
  }
  return exp(-2.0 * z);
}

/// Re_δ at which laminar Couette friction meets Vrancik's.
inline constexpr double gap_turbulence_reynolds = 87.0;

/// C_f of an annular gap: 2/Re_δ (laminar Couette, exact) below Re_δ = 87, Vrancik's above.
template <class S>
S gap_friction(S const& reynolds) {
  S const positive = smooth_abs<S>(reynolds, 1e-3);
  within<S>(gap_windage_reynolds, positive);
  S const turbulent = vrancik_friction<S>(smooth_abs<S>(reynolds, 5.0));
  return change_of_regime<S>(2.0 / positive, turbulent, positive, gap_turbulence_reynolds);
}

/// P = π C_f ρ |ω|³ r⁴ L [W]; r rotor radius, L its length, δ radial gap [m], ρ [kg/m³] and ν [m²/s] of the air.
template <class S>
S gap_windage(S const& angular_speed, S const& radius, S const& length, S const& gap, S const& density,
              S const& viscosity) {
  S const speed = smooth_abs<S>(angular_speed, 1e-9);
  S const friction = gap_friction<S>(gap_reynolds<S>(speed, radius, gap, viscosity));
  S const r2 = radius * radius;
  return std::numbers::pi * friction * density * speed * speed * speed * r2 * r2 * length;
}

inline constexpr double disc_turbulence_reynolds = 3e5;
inline constexpr Validity disc_windage_reynolds{0.0, 1e7, "Re of air friction at a disc"};

/// C_M = 3.87 Re^{−1/2} below Re = 3e5, 0.146 Re^{−1/5} above: moment of a disc wetted on both sides.
/// Sources: Dorfman 1963; Schlichting.
template <class S>
S disc_moment_coefficient(S const& reynolds) {
  using std::pow;
  within<S>(disc_windage_reynolds, reynolds);
  S const laminar = 3.87 * pow(reynolds, -0.5);
  S const turbulent = 0.146 * pow(reynolds, -0.2);
  return change_of_regime<S>(laminar, turbulent, reynolds, disc_turbulence_reynolds);
}

/// P = ½ C_M ρ |ω|³ r⁵ [W], both sides of a disc or chuck in free air (1.12); a chuck Ø250 mm at 4500 rpm: about 20 W.
template <class S>
S disc_windage(S const& angular_speed, S const& radius, S const& density, S const& viscosity) {
  S const speed = smooth_abs<S>(angular_speed, 1e-9);
  S const r2 = radius * radius;
  S const moment = disc_moment_coefficient<S>(speed * r2 / viscosity);
  return 0.5 * moment * density * speed * speed * speed * r2 * r2 * radius;
}

}  // namespace thermotwin::thermal
