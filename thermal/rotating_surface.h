#pragma once

#include <cmath>

#include "thermal/fluid.h"
#include "thermal/natural_convection.h"
#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Convection from rotating cylinders, discs and flanges. Re, Pr, Nu are positive numbers without unit.
/// Source: physics.md §2.5.

/// Re = |ω| D²/(2ν) of a cylinder: peripheral speed and diameter. ω of either sign [rad/s].
template <class S>
S cylinder_reynolds(S const& angular_speed, S const& diameter, S const& viscosity) {
  constexpr double rest = 1e-9;
  return smooth_abs<S>(angular_speed, rest) * diameter * diameter / (2.0 * viscosity);
}

/// The ranges of Re begin at 0, where free convection takes over (assisting_convection), not where their sources begin.

inline constexpr Validity becker_reynolds{0.0, 4.3e5, "Re of a rotating cylinder after Becker"};

/// Nu_D = 0.133 Re^{2/3} Pr^{1/3} (2.6). Source: Becker 1963 (water, from 800), commonly used for air up to Re = 4.3e5.
template <class S>
S becker_nusselt(S const& reynolds, S const& prandtl) {
  using std::cbrt;
  using std::pow;
  within<S>(becker_reynolds, reynolds);
  return 0.133 * pow(reynolds, 2.0 / 3.0) * cbrt(prandtl);
}

inline constexpr Validity slow_cylinder_reynolds{0.0, 2.5e4, "Re of a slowly rotating cylinder"};

/// Nu_D = 0.683 Re^0.466 Pr^{1/3}: alternative for slow rotation; 30 % below Becker's at the end of its range.
template <class S>
S slow_cylinder_nusselt(S const& reynolds, S const& prandtl) {
  using std::cbrt;
  using std::pow;
  within<S>(slow_cylinder_reynolds, reynolds);
  return 0.683 * pow(reynolds, 0.466) * cbrt(prandtl);
}

inline constexpr Validity anderson_saunders_reynolds{0.0, 1e5, "Re of a rotating cylinder after Anderson & Saunders"};

/// Nu_D = 0.10 Re^{2/3}, air, Re above 1.1 Gr^{1/2}. Source: Anderson & Saunders 1953.
template <class S>
S anderson_saunders_nusselt(S const& reynolds) {
  using std::pow;
  within<S>(anderson_saunders_reynolds, reynolds);
  return 0.10 * pow(reynolds, 2.0 / 3.0);
}

/// h = 3.75 |ω|^0.7 R^0.4 [W/(m² K)], cylinder in air; ω [rad/s], R radius [m]. Source: Jungnickel 2010.
inline constexpr Validity jungnickel_angular_speed{-2500.0, 2500.0, "angular speed after Jungnickel [rad/s]"};
inline constexpr double jungnickel_rest = 1e-3;  ///< [rad/s] no rotation, no forced convection

template <class S>
S jungnickel_cylinder_film(S const& angular_speed, S const& radius) {
  using std::pow;
  within<S>(jungnickel_angular_speed, angular_speed);
  return 3.75 * vanishing_power<S>(angular_speed, 0.7, jungnickel_rest) * pow(radius, 0.4);
}

/// h = 2.73 |ω|^0.8 R^0.6 [W/(m² K)], disc in air, turbulent. Source: Jungnickel 2010.
template <class S>
S jungnickel_disc_film(S const& angular_speed, S const& radius) {
  using std::pow;
  within<S>(jungnickel_angular_speed, angular_speed);
  return 2.73 * vanishing_power<S>(angular_speed, 0.8, jungnickel_rest) * pow(radius, 0.6);
}

/// Nu_R = 0.36 Re^{1/2} for Re = ωR²/ν below 2e5, 0.015 Re^0.8 above: mean over a disc's face. Source: Cobb & Saunders
/// 1956.
inline constexpr double disc_film_turbulence_reynolds = 2e5;
inline constexpr Validity disc_film_reynolds{0.0, 6e5, "Re of a rotating disc"};

template <class S>
S disc_nusselt(S const& reynolds) {
  using std::pow;
  using std::sqrt;
  within<S>(disc_film_reynolds, reynolds);
  return change_of_regime<S>(0.36 * sqrt(reynolds), 0.015 * pow(reynolds, 0.8), reynolds,
                             disc_film_turbulence_reynolds);
}

/// h [W/(m² K)] of a disc's face that rotates, forced convection alone: 0 at rest, where the free film of a plate takes
/// over (assisting_convection). T_s surface, T_f fluid [K], R radius [m], ω [rad/s] of either sign.
template <class S, class Medium = Air>
S rotating_disc_film(S const& surface, S const& fluid, S const& radius, S const& angular_speed,
                     Medium const& medium = {}) {
  constexpr double rest = 1e-9;
  FluidProperties<S> const film = properties(medium, S(0.5 * (surface + fluid)));
  S const reynolds = smooth_abs<S>(angular_speed, rest) * radius * radius / film.kinematic_viscosity;
  return disc_nusselt<S>(reynolds) * film.conductivity / radius;
}

/// hA = (hA)_r |n/n_r|^m [W/K]: flange, pulley or chuck as a fan; m = 0.5 (laminar) to 0.8 (turbulent).
template <class S>
S fan_conductance(S const& reference, S const& speed_ratio, double exponent) {
  constexpr double rest = 1e-4;
  return reference * vanishing_power<S>(speed_ratio, exponent, rest);
}

/// G = ρ c V̇_r |n/n_r| (2.7) [W/K]: air drawn through a pulley, of which q = G (T_air,in − T_air,out).
template <class S>
S fan_enthalpy_conductance(S const& volumetric_heat, S const& reference_flow, S const& speed_ratio) {
  constexpr double rest = 1e-6;
  return volumetric_heat * reference_flow * vanishing_power<S>(speed_ratio, 1.0, rest);
}

/// Free and forced convection together; a, b their Nusselt numbers or film coefficients.
/// Assisting flow: (a³ + b³)^{1/3}.
template <class S>
S assisting_convection(S const& a, S const& b) {
  using std::cbrt;
  return cbrt(S(a * a * a + b * b * b));
}

/// Transverse flow: (a⁴ + b⁴)^{1/4}.
template <class S>
S transverse_convection(S const& a, S const& b) {
  using std::sqrt;
  return sqrt(S(sqrt(S(a * a * a * a + b * b * b * b))));
}

/// Opposing flow: |a³ − b³|^{1/3}; where they cancel, a rest of 27 % is left, and with it a finite slope.
template <class S>
S opposing_convection(S const& a, S const& b) {
  using std::pow;
  S const a3 = a * a * a;
  S const b3 = b * b * b;
  S const rest = 0.01 * (a3 + b3);
  return pow(S((a3 - b3) * (a3 - b3) + rest * rest), 1.0 / 6.0);
}

/// h [W/(m² K)] of a horizontal cylinder that rotates in a fluid: Becker's Nu (2.6) and Churchill & Chu's free Nu as
/// assisting flows, fluid properties at ½(T_s + T_f). T_s surface, T_f fluid [K], D [m], ω [rad/s] of either sign.
/// This is `h_rot_cyl` of the prototypes behind physics.md §6.
template <class S, class Medium = Air>
S rotating_cylinder_film(S const& surface, S const& fluid, S const& diameter, S const& angular_speed,
                         Medium const& medium = {}) {
  FluidProperties<S> const film = properties(medium, S(0.5 * (surface + fluid)));
  S const reynolds = cylinder_reynolds<S>(angular_speed, diameter, film.kinematic_viscosity);
  S const forced = becker_nusselt<S>(reynolds, film.prandtl);
  S const free = horizontal_cylinder_nusselt<S>(rayleigh<S>(film, surface - fluid, diameter), film.prandtl);
  return assisting_convection<S>(forced, free) * film.conductivity / diameter;
}

}  // namespace thermotwin::thermal
