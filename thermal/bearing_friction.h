#pragma once

#include <cmath>
#include <string_view>

#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Friction of rolling bearings after Palmgren and Harris, in SI: M = M₀ + M₁, Q = M |ω|.
///
/// Holds for moderate load (P/C < 0.1), full lubrication and n d_m below about 1e6 mm/min; typically ±50 % before f₀ is
/// fitted. Sources: Palmgren 1957; Harris & Kotzalas 2006; Schaeffler; physics.md §1.1.

/// [rad/s] Below this a shaft stands still as far as friction heat is concerned.
inline constexpr double standstill_speed = 1e-3;

/// Q = M |ω| [W]: friction torque M [N m], angular speed ω [rad/s] of either sign; exactly 0 at standstill.
template <class S>
S friction_heat(S const& torque, S const& angular_speed) {
  return torque * vanishing_power<S>(angular_speed, 1.0, standstill_speed);
}

/// [m²/s²] νω from which the viscous torque grows with speed.
inline constexpr double palmgren_threshold = 2.0944e-4;
/// n d_m = 1e6 mm/min.
inline constexpr Validity palmgren_speed_times_diameter{-105.0, 105.0,
                                                        "angular speed times diameter of a bearing [m/s]"};

/// M₀ = 4500.9 f₀ (νω)^{2/3} d_m³ for νω above 2.0944e-4 m²/s², 16 f₀ d_m³ below (1.2) [N m].
/// f₀ [1], ν kinematic viscosity at the bearing's temperature [m²/s], ω [rad/s], d_m pitch diameter [m].
/// The two pieces differ by 0.8 % at the threshold and are blended over 5 % of it.
template <class S>
S palmgren_viscous_torque(S const& f0, S const& viscosity, S const& angular_speed, S const& mean_diameter) {
  using std::pow;
  within<S>(palmgren_speed_times_diameter, angular_speed * mean_diameter);
  S const flow = viscosity * smooth_abs<S>(angular_speed, standstill_speed);
  S const growing = 4500.9 * pow(flow, 2.0 / 3.0);
  S const per_volume = blend<S>(S(16.0), growing, flow, palmgren_threshold, 0.05 * palmgren_threshold);
  return f0 * per_volume * mean_diameter * mean_diameter * mean_diameter;
}

/// M₁ = f₁ P₁ d_m, f₁ = z (P₀/C₀)^y (1.1, 1.3) [N m]; P₁ [N], P₀/C₀ static load ratio [1].
template <class S>
S load_torque(S const& z, S const& y, S const& load_ratio, S const& torque_load, S const& mean_diameter) {
  using std::pow;
  constexpr double unloaded = 1e-9;
  return z * pow(smooth_abs<S>(load_ratio, unloaded), y) * torque_load * mean_diameter;
}

/// z and y of f₁ = z (P₀/C₀)^y.
struct HarrisCoefficients {
  double z = 0.0;
  double y = 0.0;
};

/// Harris' table over the contact angle α [rad], linear between its rows. Throws InputError outside 10° to 90°: below,
/// the sources contradict each other; a deep-groove bearing states z and y itself.
[[nodiscard]] HarrisCoefficients harris_coefficients(double contact_angle);

enum class Arrangement { single, duplex };  ///< one bearing or tandem; face to face or back to back

/// Y₀ of ISO 76 over the contact angle α [rad], linear between its rows. Throws InputError outside 15° to 40°.
[[nodiscard]] double static_axial_factor(double contact_angle, Arrangement arrangement);

/// [N] over which the larger of two loads is chosen smoothly.
inline constexpr double load_blend = 1.0;

/// P₀ = max(½F_r + Y₀F_a, F_r) for a single bearing, F_r + Y₀F_a for a pair [N] (ISO 76).
template <class S>
S static_equivalent_load(S const& radial, S const& axial, S const& axial_factor, Arrangement arrangement) {
  if (arrangement == Arrangement::duplex) return radial + axial_factor * axial;
  return smooth_max<S>(0.5 * radial + axial_factor * axial, radial, load_blend);
}

/// P₁ = max(0.9 F_a cot α − 0.1 F_r, F_r) [N]: Harris' torque load of a ball bearing, α contact angle [rad].
/// At α = 15° it is 3.4 times Schaeffler's; z of (1.3) belongs to this one.
template <class S>
S harris_torque_load(S const& radial, S const& axial, S const& contact_angle) {
  using std::tan;
  return smooth_max<S>(0.9 * axial / tan(contact_angle) - 0.1 * radial, radial, load_blend);
}

/// P₁ = max(F_a − 0.1 F_r, F_r) for one bearing, max(1.4 F_a − 0.1 F_r, F_r) for a pair [N]: Schaeffler's torque load.
template <class S>
S schaeffler_torque_load(S const& radial, S const& axial, Arrangement arrangement) {
  double const axial_share = arrangement == Arrangement::duplex ? 1.4 : 1.0;
  return smooth_max<S>(axial_share * axial - 0.1 * radial, radial, load_blend);
}

/// f₀ by type and lubrication (Jungnickel 2010, after FAG). Lubrications: grease, oil bath,
/// oil bath vertical shaft, oil injection (both twice the bath), oil-air (half of it). A small, run-in grease fill of a
/// spindle bearing: 0.4 to 1.0. Throws InputError naming the nearest known type or lubrication.
[[nodiscard]] double viscous_torque_factor(std::string_view bearing_type, std::string_view lubrication);

/// φ_i = 0.5 + 1.08 (r_b/r_m)(1 − sin α)^0.37 (1.4): share of the friction heat that enters the inner ring.
/// r_b ball radius, r_m pitch radius [m], α contact angle [rad]; r_m/r_b > 3. Source: Jungnickel 2010.
/// (Bossmanns & Tu 1999 take one half.)
template <class S>
S inner_ring_share(S const& ball_radius, S const& pitch_radius, S const& contact_angle) {
  using std::pow;
  using std::sin;
  return 0.5 + 1.08 * ball_radius / pitch_radius * pow(S(1.0 - sin(contact_angle)), 0.37);
}

}  // namespace thermotwin::thermal
