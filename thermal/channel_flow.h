#pragma once

#include <cmath>

#include "thermal/fluid.h"
#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Forced convection in channels, pipes and cooling jackets. Re and Nu with the hydraulic diameter d_h = 4A/P.
/// Source: physics.md §2.7.

/// Re = |V̇| d_h/(A ν); V̇ [m³/s] of either sign.
template <class S>
S channel_reynolds(S const& volume_flow, S const& area, S const& hydraulic_diameter, S const& viscosity) {
  constexpr double rest = 1e-12;
  return smooth_abs<S>(volume_flow, rest) * hydraulic_diameter / (area * viscosity);
}

/// Nu = (3.66³ + 1.615³ Re Pr d/L)^{1/3}, laminar, constant wall temperature, mean over the length L.
/// It has both asymptotes of max(3.66, 1.615 (Re Pr d/L)^{1/3}) without its kink. Re up to 2300. Source: Schlünder;
/// VDI Heat Atlas.
template <class S>
S laminar_nusselt(S const& reynolds, S const& prandtl, S const& diameter_to_length) {
  using std::cbrt;
  constexpr double developed = 3.66 * 3.66 * 3.66;
  constexpr double entry = 1.615 * 1.615 * 1.615;
  return cbrt(S(developed + entry * reynolds * prandtl * diameter_to_length));
}

/// Nu = 1.86 (Re Pr d/L)^{1/3} (η/η_w)^0.14, laminar entry; only where it exceeds 3.66, η/η_w 0.0044 to 9.75. Source:
/// Sieder & Tate 1936.
template <class S>
S sieder_tate_nusselt(S const& reynolds, S const& prandtl, S const& diameter_to_length, S const& viscosity_ratio) {
  using std::cbrt;
  using std::pow;
  return 1.86 * cbrt(S(reynolds * prandtl * diameter_to_length)) * pow(viscosity_ratio, 0.14);
}

/// Nu = (ξ/8) Re Pr/(1 + 12.7 √(ξ/8)(Pr^{2/3} − 1)): the form that every turbulent law below shares.
template <class S>
S petukhov_nusselt(S const& friction, S const& reynolds, S const& prandtl) {
  using std::pow;
  using std::sqrt;
  S const eighth = friction / 8.0;
  return eighth * reynolds * prandtl / (1.0 + 12.7 * sqrt(eighth) * (pow(prandtl, 2.0 / 3.0) - 1.0));
}

/// ξ = (1.8 log₁₀ Re − 1.5)^{−2}, smooth pipe, Re 3e3 to 1e7. Source: Konakov 1946.
template <class S>
S smooth_pipe_friction(S const& reynolds) {
  using std::log10;
  S const root = 1.8 * log10(reynolds) - 1.5;
  return 1.0 / (root * root);
}

inline constexpr Validity gnielinski_prandtl{0.1, 1000.0, "Pr of a fluid in a channel"};

/// Nu = petukhov(ξ, Re, Pr) [1 + (d/L)^{2/3}], turbulent, Re 1e4 to 1e6. Source: Gnielinski 1975, VDI Heat Atlas.
template <class S>
S gnielinski_nusselt(S const& reynolds, S const& prandtl, S const& diameter_to_length) {
  using std::pow;
  within<S>(gnielinski_prandtl, prandtl);
  return petukhov_nusselt<S>(smooth_pipe_friction<S>(reynolds), reynolds, prandtl) *
         (1.0 + pow(diameter_to_length, 2.0 / 3.0));
}

/// The variant with Re − 1000 instead of Re in the numerator, Re 3e3 to 5e6. Source: Gnielinski 1976.
template <class S>
S gnielinski_1976_nusselt(S const& reynolds, S const& prandtl, S const& diameter_to_length) {
  return gnielinski_nusselt<S>(reynolds, prandtl, diameter_to_length) * (1.0 - 1000.0 / reynolds);
}

enum class FluidIs { heated, cooled };

/// Nu = 0.023 Re^0.8 Pr^n, n = 0.4 when the fluid is heated, 0.3 when it is cooled, Re 1e4 to 1.2e5, Pr 0.7 to 160.
/// Source: Dittus & Boelter 1930.
template <class S>
S dittus_boelter_nusselt(S const& reynolds, S const& prandtl, FluidIs fluid_is) {
  using std::pow;
  return 0.023 * pow(reynolds, 0.8) * pow(prandtl, fluid_is == FluidIs::heated ? 0.4 : 0.3);
}

/// `laminar` below Re_l, `turbulent` above Re_t, between them linear from the value at one end to that at the other,
/// with both kinks rounded over `regime_width`. The laws are callables of Re.
template <class S, class Laminar, class Turbulent>
S transition(S const& reynolds, S const& laminar_end, double turbulent_start, Laminar const& laminar,
             Turbulent const& turbulent) {
  S const first = laminar(laminar_end);
  S const last = turbulent(S(turbulent_start));
  S const between = first + (last - first) * ((reynolds - laminar_end) / (turbulent_start - laminar_end));
  S const lower = change_of_regime<S>(laminar(reynolds), between, reynolds / laminar_end, 1.0);
  S const fast = laminar_end * smooth_max<S>(reynolds / laminar_end, S(1.0), 0.01);
  return change_of_regime<S>(lower, turbulent(fast), reynolds, turbulent_start);
}

inline constexpr double laminar_end_reynolds = 2300.0;
inline constexpr double turbulent_start_reynolds = 1e4;
inline constexpr Validity channel_reynolds_range{0.0, 1e6, "Re in a channel"};

/// Nu(Re) of a straight channel: laminar, Gnielinski's transition from 2300 to 1e4, turbulent.
template <class S>
S channel_nusselt(S const& reynolds, S const& prandtl, S const& diameter_to_length) {
  within<S>(channel_reynolds_range, reynolds);
  return transition<S>(
      reynolds, S(laminar_end_reynolds), turbulent_start_reynolds,
      [&](S const& re) { return laminar_nusselt<S>(re, prandtl, diameter_to_length); },
      [&](S const& re) { return gnielinski_nusselt<S>(re, prandtl, diameter_to_length); });
}

/// D = D_w (1 + (p/(π D_w))²): diameter of curvature of a helix of winding diameter D_w and pitch p [m].
template <class S>
S helix_curvature_diameter(S const& winding_diameter, S const& pitch) {
  S const slope = pitch / (3.141592653589793 * winding_diameter);
  return winding_diameter * (1.0 + slope * slope);
}

/// Re_cr = 2300 [1 + 8.6 (d/D)^0.45]: end of laminar flow in a helix of curvature diameter D. Source: VDI Heat Atlas
/// Gc.
template <class S>
S helix_laminar_end(S const& curvature) {
  using std::pow;
  return 2300.0 * (1.0 + 8.6 * pow(curvature, 0.45));
}
inline constexpr double helix_turbulent_start = 2.2e4;
inline constexpr Validity helix_reynolds_range{0.0, 1e5, "Re in a helical channel"};

/// Nu(Re) of a helical jacket, `curvature` = d_h/D: laminar 3.66 + 0.08 [1 + 0.8 (d/D)^0.9] Re^m Pr^{1/3},
/// m = 0.5 + 0.2903 (d/D)^0.194, up to Re_cr; turbulent petukhov(0.3164 Re^{−1/4} + 0.03 √(d/D)) from 2.2e4.
template <class S>
S helix_nusselt(S const& reynolds, S const& prandtl, S const& curvature) {
  using std::cbrt;
  using std::pow;
  using std::sqrt;
  within<S>(helix_reynolds_range, reynolds);
  S const exponent = 0.5 + 0.2903 * pow(curvature, 0.194);
  S const swirl = 0.08 * (1.0 + 0.8 * pow(curvature, 0.9));
  S const bend = 0.03 * sqrt(curvature);
  return transition<S>(
      reynolds, helix_laminar_end<S>(curvature), helix_turbulent_start,
      [&](S const& re) { return 3.66 + swirl * pow(re, exponent) * cbrt(prandtl); },
      [&](S const& re) { return petukhov_nusselt<S>(0.3164 * pow(re, -0.25) + bend, re, prandtl); });
}

/// (Pr/Pr_w)^n: property variation near the wall; n = 0.11 in a straight channel, 0.14 in a helix.
template <class S>
S wall_correction(S const& prandtl, S const& wall_prandtl, double exponent) {
  using std::pow;
  return pow(S(prandtl / wall_prandtl), exponent);
}
inline constexpr double channel_wall_exponent = 0.11;
inline constexpr double helix_wall_exponent = 0.14;

/// h [W/(m² K)] in a straight channel; T_w wall, T_f fluid [K], V̇ [m³/s], A cross-section [m²], d_h, length [m].
template <class S, class Medium>
S channel_film(Medium const& medium, S const& wall, S const& fluid, S const& volume_flow, S const& area,
               S const& hydraulic_diameter, S const& length) {
  FluidProperties<S> const bulk = properties(medium, fluid);
  S const reynolds = channel_reynolds<S>(volume_flow, area, hydraulic_diameter, bulk.kinematic_viscosity);
  S const nusselt = channel_nusselt<S>(reynolds, bulk.prandtl, hydraulic_diameter / length);
  S const near_wall = wall_correction<S>(bulk.prandtl, properties(medium, wall).prandtl, channel_wall_exponent);
  return nusselt * near_wall * bulk.conductivity / hydraulic_diameter;
}

/// h [W/(m² K)] in a helical jacket; D curvature diameter [m].
template <class S, class Medium>
S helix_film(Medium const& medium, S const& wall, S const& fluid, S const& volume_flow, S const& area,
             S const& hydraulic_diameter, S const& curvature_diameter) {
  FluidProperties<S> const bulk = properties(medium, fluid);
  S const reynolds = channel_reynolds<S>(volume_flow, area, hydraulic_diameter, bulk.kinematic_viscosity);
  S const nusselt = helix_nusselt<S>(reynolds, bulk.prandtl, S(hydraulic_diameter / curvature_diameter));
  S const near_wall = wall_correction<S>(bulk.prandtl, properties(medium, wall).prandtl, helix_wall_exponent);
  return nusselt * near_wall * bulk.conductivity / hydraulic_diameter;
}

/// G = ṁc (1 − e^{−NTU}), NTU = hA/(ṁc) [W/K]: conductance between a wall of one temperature and the stream's
/// **inlet**, q = G (T_w − T_in), exact for every NTU. ṁc and hA [W/K], ṁc > 0. With a fluid node at ½(T_in + T_out)
/// instead, q = 2 ṁc (T_f − T_in) holds for NTU < 1; above, use four cells or more.
template <class S>
S ntu_conductance(S const& capacity_rate, S const& film_conductance) {
  using std::expm1;
  return -capacity_rate * expm1(S(-film_conductance / capacity_rate));
}

/// V̇/V̇₀ = (ν₀/ν)^γ: flow of a pump of constant pressure; γ = 1 laminar, 0 when a volume is displaced.
template <class S>
S viscous_flow_ratio(S const& reference_viscosity, S const& viscosity, S const& exponent) {
  using std::pow;
  return pow(S(reference_viscosity / viscosity), exponent);
}

}  // namespace thermotwin::thermal
