#pragma once

#include <cmath>

#include "thermal/fluid.h"
#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Heat through the annular gap between a rotor and its stator, or a shaft and its housing. Source: physics.md §2.8.

/// Ta_m = (|ω| r_m δ/ν)(δ/r_m)^{1/2}: Taylor number of the gap δ [m] at mean radius r_m [m].
template <class S>
S taylor_number(S const& angular_speed, S const& mean_radius, S const& gap, S const& viscosity) {
  using std::sqrt;
  constexpr double rest = 1e-6;
  return smooth_abs<S>(angular_speed, rest) * mean_radius * gap / viscosity * sqrt(S(gap / mean_radius));
}

/// Nu = 2 below Ta = 41.3 (conduction), 0.202 Ta^0.63 Pr^0.27 up to 100, 0.386 Ta^{1/2} Pr^0.27 above (2.9); h = Nu k/δ
/// from one wall to the air of the gap. Sources: Becker & Kaye 1962; Staton & Cavagnino 2008.
inline constexpr double vortex_taylor = 41.3;
inline constexpr double turbulent_vortex_taylor = 100.0;
inline constexpr Validity annular_gap_taylor{0.0, 3e3, "Ta of an annular gap"};

template <class S>
S annular_gap_nusselt(S const& taylor, S const& prandtl) {
  using std::pow;
  using std::sqrt;
  within<S>(annular_gap_taylor, taylor);
  S const pr = pow(prandtl, 0.27);
  S const vortices = 0.202 * pow(taylor, 0.63) * pr;
  S const turbulent = 0.386 * sqrt(taylor) * pr;
  S const flow = change_of_regime<S>(vortices, turbulent, taylor, turbulent_vortex_taylor);
  return change_of_regime<S>(S(2.0), flow, taylor, vortex_taylor);
}

/// Nu = 2 below Ta² = 1700, 0.128 (Ta²)^0.367 up to 1e4, 0.409 (Ta²)^0.241 above, air. Source: Becker & Kaye 1962.
inline constexpr double becker_kaye_vortex = 1700.0;         ///< Ta²
inline constexpr double becker_kaye_turbulent_vortex = 1e4;  ///< Ta²
inline constexpr Validity becker_kaye_taylor_squared{0.0, 1e7, "Ta² of an annular gap"};

template <class S>
S becker_kaye_nusselt(S const& taylor) {
  using std::pow;
  S const squared = taylor * taylor;
  within<S>(becker_kaye_taylor_squared, squared);
  S const flow = change_of_regime<S>(0.128 * pow(squared, 0.367), 0.409 * pow(squared, 0.241), squared,
                                     becker_kaye_turbulent_vortex);
  return change_of_regime<S>(S(2.0), flow, squared, becker_kaye_vortex);
}

/// U = ½ Nu k/δ [W/(m² K)]: surface to surface, two walls in series; at rest U = k/δ. T₁, T₂ walls [K].
template <class S, class Medium = Air>
S annular_gap_film(S const& wall1, S const& wall2, S const& mean_radius, S const& gap, S const& angular_speed,
                   Medium const& medium = {}) {
  FluidProperties<S> const film = properties(medium, S(0.5 * (wall1 + wall2)));
  S const taylor = taylor_number<S>(angular_speed, mean_radius, gap, film.kinematic_viscosity);
  return 0.5 * annular_gap_nusselt<S>(taylor, film.prandtl) * film.conductivity / gap;
}

inline constexpr Validity jungnickel_gap_speed{-150.0, 150.0, "rim speed at an annular gap after Jungnickel [m/s]"};

/// U = 0.765 (|ω|R)^{2/3} δ^{−1/3} [W/(m² K)], surface to surface, air. Source: Jungnickel 2010.
template <class S>
S jungnickel_gap_film(S const& radius, S const& gap, S const& angular_speed) {
  using std::pow;
  constexpr double rest = 1e-4;
  within<S>(jungnickel_gap_speed, angular_speed * radius);
  return 0.765 * vanishing_power<S>(angular_speed * radius, 2.0 / 3.0, rest) * pow(gap, -1.0 / 3.0);
}

}  // namespace thermotwin::thermal
