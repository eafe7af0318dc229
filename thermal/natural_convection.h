#pragma once

#include <cmath>

#include "thermal/fluid.h"
#include "thermal/physical_constant.h"
#include "thermal/radiation.h"
#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Free convection from plates and cylinders, in closed gaps, and to a workshop. Source: physics.md §2.6.

/// [K] |ΔT| is sqrt(ΔT² + ε²), so that no film has an infinite slope at ΔT = 0.
inline constexpr double temperature_blend = 0.01;

/// Ra = g β |ΔT| L³ Pr/ν²; ΔT of either sign [K], L [m].
template <class S>
S rayleigh(FluidProperties<S> const& film, S const& difference, S const& length) {
  S const nu = film.kinematic_viscosity;
  S const drive = gravity * film.expansion * smooth_abs<S>(difference, temperature_blend);
  return drive * length * length * length * film.prandtl / (nu * nu);
}

inline constexpr Validity churchill_chu_plate_rayleigh{0.1, 1e12, "Ra of a vertical plate"};

/// Nu = {0.825 + 0.387 Ra^{1/6}/[1 + (0.492/Pr)^{9/16}]^{8/27}}², vertical plate. Source: Churchill & Chu 1975.
template <class S>
S vertical_plate_nusselt(S const& rayleigh_number, S const& prandtl) {
  using std::pow;
  within<S>(churchill_chu_plate_rayleigh, rayleigh_number);
  S const shape = pow(S(1.0 + pow(S(0.492 / prandtl), 9.0 / 16.0)), 8.0 / 27.0);
  S const root = 0.825 + 0.387 * pow(rayleigh_number, 1.0 / 6.0) / shape;
  return root * root;
}

/// Nu = 0.55 Ra^{1/4} up to Ra = 5e8, 0.14 Ra^{1/3} above, vertical plate. Source: Jungnickel 2010.
inline constexpr double jungnickel_plate_turbulence_rayleigh = 5e8;
inline constexpr Validity jungnickel_plate_rayleigh{1e4, 1e12, "Ra of a vertical plate after Jungnickel"};

template <class S>
S jungnickel_vertical_plate_nusselt(S const& rayleigh_number) {
  using std::cbrt;
  using std::pow;
  within<S>(jungnickel_plate_rayleigh, rayleigh_number);
  return change_of_regime<S>(0.55 * pow(rayleigh_number, 0.25), 0.14 * cbrt(rayleigh_number), rayleigh_number,
                             jungnickel_plate_turbulence_rayleigh);
}

/// Nu = 0.54 Ra^{1/4} up to Ra = 2e7, 0.14 Ra^{1/3} above, L = area/perimeter: hot face up or cold face down.
/// Source: McAdams; EMod.
inline constexpr double horizontal_plate_turbulence_rayleigh = 2e7;
inline constexpr Validity unstable_plate_rayleigh{1e4, 3e10, "Ra of a hot face that looks up or a cold one down"};

template <class S>
S unstable_plate_nusselt(S const& rayleigh_number) {
  using std::cbrt;
  using std::pow;
  return change_of_regime<S>(0.54 * pow(rayleigh_number, 0.25), 0.14 * cbrt(rayleigh_number), rayleigh_number,
                             horizontal_plate_turbulence_rayleigh);
}

inline constexpr Validity stable_plate_rayleigh{1e5, 1e10, "Ra of a hot face that looks down or a cold one up"};

/// Nu = 0.27 Ra^{1/4}, L = area/perimeter: hot face down or cold face up.
template <class S>
S stable_plate_nusselt(S const& rayleigh_number) {
  using std::pow;
  return 0.27 * pow(rayleigh_number, 0.25);
}

inline constexpr Validity churchill_chu_cylinder_rayleigh{1e-5, 1e12, "Ra of a horizontal cylinder"};

/// Nu = {0.60 + 0.387 Ra^{1/6}/[1 + (0.559/Pr)^{9/16}]^{8/27}}², horizontal cylinder, L = D. Source: Churchill & Chu
/// 1975.
template <class S>
S horizontal_cylinder_nusselt(S const& rayleigh_number, S const& prandtl) {
  using std::pow;
  within<S>(churchill_chu_cylinder_rayleigh, rayleigh_number);
  S const shape = pow(S(1.0 + pow(S(0.559 / prandtl), 9.0 / 16.0)), 8.0 / 27.0);
  S const root = 0.60 + 0.387 * pow(rayleigh_number, 1.0 / 6.0) / shape;
  return root * root;
}

/// h [W/(m² K)] of a vertical face of height L [m]; properties at ½(T_s + T_f); T_s surface, T_f fluid [K].
template <class S, class Medium = Air>
S vertical_plate_film(S const& surface, S const& fluid, S const& height, Medium const& medium = {}) {
  FluidProperties<S> const film = properties(medium, S(0.5 * (surface + fluid)));
  return vertical_plate_nusselt<S>(rayleigh<S>(film, surface - fluid, height), film.prandtl) * film.conductivity /
         height;
}

/// Which way a horizontal face looks.
enum class Facing { up, down };

/// [K] Over which a horizontal face changes between stable and unstable layering as T_s passes T_f.
inline constexpr double layering_blend = 0.1;

/// h [W/(m² K)] of a horizontal face; L = area/perimeter [m]. Unstable when hot and facing up or cold and facing down.
template <class S, class Medium = Air>
S horizontal_plate_film(Facing facing, S const& surface, S const& fluid, S const& length, Medium const& medium = {}) {
  FluidProperties<S> const film = properties(medium, S(0.5 * (surface + fluid)));
  S const difference = surface - fluid;
  S const number = rayleigh<S>(film, difference, length);
  S const upward = facing == Facing::up ? difference : S(-difference);
  within<S>(unstable_plate_rayleigh, number, upward, S(0.0));
  within<S>(stable_plate_rayleigh, number, S(0.0), upward);
  S const nusselt =
      blend<S>(stable_plate_nusselt<S>(number), unstable_plate_nusselt<S>(number), upward, 0.0, layering_blend);
  return nusselt * film.conductivity / length;
}

/// h [W/(m² K)] of a horizontal cylinder at rest; D [m].
template <class S, class Medium = Air>
S horizontal_cylinder_film(S const& surface, S const& fluid, S const& diameter, Medium const& medium = {}) {
  FluidProperties<S> const film = properties(medium, S(0.5 * (surface + fluid)));
  return horizontal_cylinder_nusselt<S>(rayleigh<S>(film, surface - fluid, diameter), film.prandtl) *
         film.conductivity / diameter;
}

/// h = 1.7 χ |ΔT|^{1/3} + ε 0.8 · 4σT_m³ (2.8) [W/(m² K)]: a surface of a machine in a workshop, turbulent free
/// convection with χ = 1.3 for the air's own motion, and radiation to walls of emissivity 0.8; T_m = ½(T_s + T_a), 0 to
/// 100 °C. ε = 0.9: about 8 W/(m² K) at 5 K, 9 at 10 K. Surfaces above 1 m; smaller ones lose more. Source: Jungnickel
/// 2010.
inline constexpr Validity room_film_temperature{273.15, 373.15, "temperature of a surface in a room [K]"};
inline constexpr double room_air_motion = 1.3;     ///< χ
inline constexpr double painted_emissivity = 0.9;  ///< ε

template <class S>
S room_film(S const& surface, S const& room, S const& emissivity = S(painted_emissivity),
            S const& air_motion = S(room_air_motion)) {
  within<S>(room_film_temperature, surface);
  S const mean = 0.5 * (surface + room);
  S const convection = 1.7 * air_motion * smooth_power<S>(surface - room, 1.0 / 3.0, temperature_blend);
  return convection + room_radiation_film<S>(emissivity, mean);
}

/// Closed gaps: h refers to the temperature difference between the two walls.

/// Nu = 0.42 Pr^0.012 Ra^{1/4} (H/w)^{−1/4} below Ra = 1e7, 0.049 Ra^{1/3} above, at least 1 (conduction): vertical gap
/// of width w and height H, Ra with L = w. Source: VDI Heat Atlas.
inline constexpr double vertical_gap_turbulence_rayleigh = 1e7;
inline constexpr Validity vertical_gap_rayleigh{0.0, 1e9, "Ra of a vertical gap"};
inline constexpr Validity vertical_gap_aspect{10.0, 40.0, "height over width of a vertical gap"};

template <class S>
S vertical_gap_nusselt(S const& rayleigh_number, S const& prandtl, S const& aspect) {
  using std::cbrt;
  using std::pow;
  within<S>(vertical_gap_rayleigh, rayleigh_number);
  within<S>(vertical_gap_aspect, aspect);
  S const laminar = 0.42 * pow(prandtl, 0.012) * pow(S(rayleigh_number / aspect), 0.25);
  S const flow =
      change_of_regime<S>(laminar, 0.049 * cbrt(rayleigh_number), rayleigh_number, vertical_gap_turbulence_rayleigh);
  return smooth_max<S>(flow, S(1.0), 0.05);
}

/// Nu = 1 below Ra = 1708 (conduction), 0.208 Ra^{1/4} up to 2.2e4, 0.092 Ra^{1/3} above: horizontal gap heated from
/// below, Ra with L = height. Source: VDI Heat Atlas.
inline constexpr double horizontal_gap_onset_rayleigh = 1708.0;
inline constexpr double horizontal_gap_turbulence_rayleigh = 2.2e4;
inline constexpr Validity horizontal_gap_rayleigh{0.0, 1e9, "Ra of a horizontal gap"};

template <class S>
S horizontal_gap_nusselt(S const& rayleigh_number) {
  using std::cbrt;
  using std::pow;
  within<S>(horizontal_gap_rayleigh, rayleigh_number);
  S const rolls = change_of_regime<S>(0.208 * pow(rayleigh_number, 0.25), 0.092 * cbrt(rayleigh_number),
                                      rayleigh_number, horizontal_gap_turbulence_rayleigh);
  return change_of_regime<S>(S(1.0), rolls, rayleigh_number, horizontal_gap_onset_rayleigh);
}

/// h [W/(m² K)] between the walls of a closed vertical gap [m].
template <class S, class Medium = Air>
S vertical_gap_film(S const& wall1, S const& wall2, S const& width, S const& height, Medium const& medium = {}) {
  FluidProperties<S> const film = properties(medium, S(0.5 * (wall1 + wall2)));
  S const number = rayleigh<S>(film, wall1 - wall2, width);
  return vertical_gap_nusselt<S>(number, film.prandtl, height / width) * film.conductivity / width;
}

/// h [W/(m² K)] between bottom and top of a closed horizontal gap; conduction alone when the top is the hotter one.
template <class S, class Medium = Air>
S horizontal_gap_film(S const& bottom, S const& top, S const& height, Medium const& medium = {}) {
  FluidProperties<S> const film = properties(medium, S(0.5 * (bottom + top)));
  S const difference = bottom - top;
  S const flow = horizontal_gap_nusselt<S>(rayleigh<S>(film, difference, height));
  return blend<S>(S(1.0), flow, difference, 0.0, layering_blend) * film.conductivity / height;
}

}  // namespace thermotwin::thermal
