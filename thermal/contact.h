#pragma once

#include <cmath>

#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Heat through joints and fits: film coefficients per nominal area of contact [W/(m² K)].
/// A joint matters only where its conductance is comparable with the conduction in series. Of a bolted joint, take
/// pressure and area of the pressure cone, 2.5 to 3 bolt heads wide. Sources: physics.md §2.2, §2.3.

/// Two rough surfaces in contact.
struct RoughContact {
  double conductivity1 = 0.0;  ///< k₁ [W/(m K)]
  double conductivity2 = 0.0;  ///< k₂ [W/(m K)]
  double roughness = 0.8e-6;   ///< σ = √(σ₁² + σ₂²), rms heights [m]
  double slope = 0.1;          ///< m = √(m₁² + m₂²), rms asperity slope, 0.05 to 0.2
  double hardness = 2.5e9;     ///< H_c of the softer surface, 1.5 to 3 GPa for cast iron and steel [Pa]
};

inline constexpr Validity contact_relative_pressure{0.0, 2.3e-2, "pressure over hardness at a joint"};

/// h_c = 1.25 (k_s m/σ)(p/H_c)^0.95, k_s = 2k₁k₂/(k₁+k₂) (2.1): the spots that touch; p nominal pressure [Pa],
/// positive. Sources: Cooper, Mikic & Yovanovich 1969; Yovanovich 1982.
template <class S>
S contact_film(RoughContact const& c, S const& pressure) {
  using std::pow;
  within<S>(contact_relative_pressure, S(pressure / c.hardness));
  double const k = 2.0 * c.conductivity1 * c.conductivity2 / (c.conductivity1 + c.conductivity2);
  return 1.25 * k * c.slope / c.roughness * pow(S(pressure / c.hardness), 0.95);
}

inline constexpr double air_gas_parameter = 0.37e-6;  ///< M_g of air between metals at 1 bar [m]

/// h_g = k_g/(Y + M_g), Y = 1.53 σ (p/H_c)^{−0.097}: what fills the gaps; k_g [W/(m K)], M_g gas parameter [m], 0 for a
/// liquid, p/H_c 1e-5 to 2e-2.
template <class S>
S gap_film(RoughContact const& c, S const& pressure, S const& gap_conductivity, double gas_parameter) {
  using std::pow;
  S const separation = 1.53 * c.roughness * pow(S(pressure / c.hardness), -0.097);
  return gap_conductivity / (separation + gas_parameter);
}

/// h_j = h_c + h_g: a flat joint. Design values: 2 to 5 kW/(m² K) dry and lightly loaded, 5 to 15 bolted, 3 times with
/// oil.
template <class S>
S joint_film(RoughContact const& c, S const& pressure, S const& gap_conductivity, double gas_parameter) {
  return contact_film<S>(c, pressure) + gap_film<S>(c, pressure, gap_conductivity, gas_parameter);
}

/// Ten-point heights R_z of machined surfaces [m].
namespace ten_point_height {
inline constexpr double milling = 6.3e-6;
inline constexpr double grinding = 0.6e-6;
inline constexpr double scraping = 2.5e-6;
inline constexpr double turning = 25e-6;
}  // namespace ten_point_height

inline constexpr double fine_joint_height = 15e-6;    ///< ΣR_z [m]
inline constexpr double coarse_joint_height = 30e-6;  ///< ΣR_z [m]
inline constexpr Validity jungnickel_joint_pressure{1e5, 2e7, "pressure at a joint after Jungnickel [Pa]"};

/// κ = 15 µm/ΣR_z below ΣR_z = 15 µm, (30 µm/ΣR_z)^0.33 up to 30 µm, 1 above. The source jumps by 26 % at 15 µm.
template <class S>
S joint_roughness_factor(S const& height_sum) {
  using std::pow;
  S const medium = pow(S(coarse_joint_height / height_sum), 0.33);
  S const upper = change_of_regime<S>(medium, S(1.0), height_sum, coarse_joint_height);
  return change_of_regime<S>(fine_joint_height / height_sum, upper, height_sum, fine_joint_height);
}

/// h = 6.7 [k_g/ΣR_z + 928 k₁k₂/(k₁+k₂) (κp/σ_B)^0.86]: joint of two metals; ΣR_z sum of both ten-point heights [m],
/// σ_B tensile strength of the softer one [Pa], p > 0 [Pa]. R_z 6.3 + 6.3 µm: 14 to 16 kW/(m² K) in air, 70 with oil.
/// Source: Jungnickel 2010.
template <class S>
S jungnickel_joint_film(S const& gap_conductivity, S const& k1, S const& k2, S const& height_sum, S const& pressure,
                        S const& tensile_strength) {
  using std::pow;
  within<S>(jungnickel_joint_pressure, pressure);
  S const loaded = joint_roughness_factor<S>(height_sum) * pressure / tensile_strength;
  return 6.7 * (gap_conductivity / height_sum + 928.0 * k1 * k2 / (k1 + k2) * pow(loaded, 0.86));
}

/// A ring in a bore (or on a seat): cylinders of one nominal diameter.
struct Fit {
  double diameter = 0.0;        ///< D, nominal [m]
  double inner_bore = 0.0;      ///< d, bore of the inner part [m]
  double outer_diameter = 0.0;  ///< D_o, outside of the outer part [m]
  double inner_youngs_modulus = 208e9;
  double inner_poisson_ratio = 0.30;
  double outer_youngs_modulus = 120e9;
  double outer_poisson_ratio = 0.26;
  double separation = 1.5e-6;  ///< ξ, mean distance of surfaces that touch without pressure [m]
  RoughContact contact;
};

/// g = g₀ − D [α_r θ_r − α_h θ_h] (2.2) [m]: diametral gap, positive = clearance; θ rises since g₀ was measured [K], r
/// the inner part, h the outer one. 110 mm: a ring 5 K hotter than its housing closes 6.5 µm.
template <class S>
S fit_gap(S const& cold_gap, S const& diameter, S const& inner_expansion, S const& inner_rise, S const& outer_expansion,
          S const& outer_rise) {
  return cold_gap - diameter * (inner_expansion * inner_rise - outer_expansion * outer_rise);
}

/// [m] Of diametral gap, over which clearance turns into interference.
inline constexpr double fit_blend = 0.1e-6;
inline constexpr Validity fit_gap_range{-50e-6, 100e-6, "gap of a fit [m]"};

/// p = −g/{D [(C_o + ν_o)/E_o + (C_i − ν_i)/E_i]}, C_o = (D_o² + D²)/(D_o² − D²), C_i = (D² + d²)/(D² − d²) (2.4) [Pa]:
/// Lamé's pressure of an interference; next to 0 with clearance.
template <class S>
S fit_pressure(Fit const& f, S const& gap) {
  auto const ratio = [](double outer, double inner) {
    return (outer * outer + inner * inner) / (outer * outer - inner * inner);
  };
  double const outer = (ratio(f.outer_diameter, f.diameter) + f.outer_poisson_ratio) / f.outer_youngs_modulus;
  double const inner = (ratio(f.diameter, f.inner_bore) - f.inner_poisson_ratio) / f.inner_youngs_modulus;
  return smooth_positive<S>(-gap, fit_blend) / (f.diameter * (outer + inner));
}

/// h = k_g/(½ max(g, 0) + ξ) + h_c(p) (2.3): with clearance the medium in the gap conducts (air; oil or grease 5 times
/// as well), with interference the spots that touch besides. Smooth in g. k_g [W/(m K)]. Air, radial gap 2, 5, 10, 30
/// µm: 7.4, 4.0, 2.3, 0.8 kW/(m² K).
template <class S>
S fit_film(Fit const& f, S const& gap, S const& gap_conductivity) {
  within<S>(fit_gap_range, gap);
  S const clearance = smooth_positive<S>(gap, fit_blend);
  return gap_conductivity / (0.5 * clearance + f.separation) + contact_film<S>(f.contact, fit_pressure<S>(f, gap));
}

}  // namespace thermotwin::thermal
