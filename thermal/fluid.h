#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "thermal/lubricant.h"
#include "thermal/physical_constant.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// What a film correlation needs to know of a fluid at one temperature.
template <class S>
struct FluidProperties {
  S conductivity;         ///< k [W/(m K)]
  S density;              ///< ρ [kg/m³]
  S specific_heat;        ///< c_p [J/(kg K)]
  S kinematic_viscosity;  ///< ν [m²/s]
  S prandtl;              ///< Pr = ν ρ c_p/k [1]
  S expansion;            ///< volumetric, β [1/K]
};

/// Properties whose Prandtl number follows from the others.
template <class S>
FluidProperties<S> with_prandtl(S const& k, S const& density, S const& c, S const& nu, S const& expansion) {
  return {k, density, c, nu, nu * density * c / k, expansion};
}

/// Air at 1 bar: k = 0.02425 + 7.493e-5 T, ν = 1.35e-5 + 9.707e-8 T (T in °C), Pr = 0.71, ideal gas, c_p = 1007.
/// Source: chords of the VDI table between 0 and 75 °C, as in the prototypes of physics.md §6; 1 % in ν, 0.5 % in k.
struct Air {};
inline constexpr Validity air_temperature{263.15, 353.15, "temperature of air at a wall [K]"};

template <class S>
FluidProperties<S> properties(Air, S const& temperature) {
  within<S>(air_temperature, temperature);
  S const t = temperature - zero_celsius;
  return {0.02425 + (0.02987 - 0.02425) / 75.0 * t,
          1e5 / (gas_constant_air * temperature),
          S(1007.0),
          1.35e-5 + (2.078e-5 - 1.35e-5) / 75.0 * t,
          S(0.71),
          1.0 / temperature};
}

/// Water at 1 bar. Sources: density Kell 1975; conductivity Ramires et al. 1995; viscosity Kestin, Sokolov & Wakeham
/// 1978; specific heat NIST Shomate (Chase 1998). Within 0.5 % of the VDI table, 2 % in ν above 80 °C.
struct Water {};
inline constexpr Validity water_temperature{273.15, 363.15, "temperature of water [K]"};

template <class S>
FluidProperties<S> properties(Water, S const& temperature) {
  using std::exp;
  within<S>(water_temperature, temperature);
  S const t = temperature - zero_celsius;
  S const mass =
      999.83952 + t * (16.945176 + t * (-7.9870401e-3 + t * (-46.170461e-6 + t * (105.56302e-9 - t * 280.54253e-12))));
  S const mass_slope =
      16.945176 + t * (-2 * 7.9870401e-3 + t * (-3 * 46.170461e-6 + t * (4 * 105.56302e-9 - t * 5 * 280.54253e-12)));
  S const volume = 1.0 + 16.879850e-3 * t;
  S const density = mass / volume;
  S const expansion = 16.879850e-3 / volume - mass_slope / mass;

  S const reduced = temperature / 298.15;
  S const k = 0.6065 * (-1.48445 + reduced * (4.12292 - 1.63866 * reduced));

  S const kilo = temperature / 1000.0;
  S const molar = -203.6060 + kilo * (1523.290 + kilo * (-3196.413 + kilo * 2474.455)) + 3.855326 / (kilo * kilo);
  S const c = molar / 0.01801528;

  S const d = 20.0 - t;
  S const decades = d / (t + 96.0) * (1.2364 + d * (-1.37e-3 + d * 5.7e-6));
  S const nu = 1.002e-3 * exp(2.302585092994045684 * decades) / density;
  return with_prandtl<S>(k, density, c, nu, expansion);
}

/// Cooling emulsion, 5 to 8 % concentrate in water: water, scaled to k 0.58, ρ 1000, c 4050, ν 1.2e-6 at 20 °C
/// (physics.md §5).
struct Emulsion {};
inline constexpr Validity emulsion_temperature{278.15, 323.15, "temperature of cooling emulsion [K]"};

template <class S>
FluidProperties<S> properties(Emulsion, S const& temperature) {
  within<S>(emulsion_temperature, temperature);
  FluidProperties<S> const water = properties(Water{}, temperature);
  return with_prandtl<S>(water.conductivity * (0.58 / 0.600), water.density * (1000.0 / 998.2),
                         water.specific_heat * (4050.0 / 4185.0), water.kinematic_viscosity * (1.2 / 1.003),
                         water.expansion);
}

/// A liquid with linear ρ = ρ₂₀ (1 − β (T − 20 °C)) and c = c₂₀ + c' (T − 20 °C), constant k, and Vogel's ν.
struct Liquid {
  double conductivity = 0.0;         ///< k [W/(m K)]
  double density = 0.0;              ///< ρ₂₀ [kg/m³]
  double expansion = 0.0;            ///< β, volumetric at 20 °C [1/K]
  double specific_heat = 0.0;        ///< c₂₀ [J/(kg K)]
  double specific_heat_slope = 0.0;  ///< c' [J/(kg K²)]
  Vogel viscosity;
};

template <class S>
FluidProperties<S> properties(Liquid const& liquid, S const& temperature) {
  S const rise = temperature - reference_temperature;
  S const relative_density = 1.0 - liquid.expansion * rise;
  return with_prandtl<S>(S(liquid.conductivity), liquid.density * relative_density,
                         liquid.specific_heat + liquid.specific_heat_slope * rise,
                         viscosity(liquid.viscosity, temperature), liquid.expansion / relative_density);
}

/// Mineral oil: k 0.13, ρ 870, β 6.5e-4, c 1900 + 4 (T − 20 °C), ν by its ISO grade; 0…100 °C (physics.md §1.3, §5).
[[nodiscard]] Liquid mineral_oil(int iso_grade);

/// Water with 30 vol % ethylene glycol: k 0.48, ρ 1045, c 3650, ν 2.2e-6 at 20 and 1.3e-6 at 40 °C; 0…60 °C
/// (physics.md §5).
[[nodiscard]] Liquid water_glycol();

/// Pure ethylene glycol: Vogel law through ν = 37.3e-6, 14.1e-6, 3.98e-6 at 7, 27, 67 °C; 0…67 °C (Incropera, tab.
/// A.5).
[[nodiscard]] Liquid ethylene_glycol();

using Fluid = std::variant<Air, Water, Emulsion, Liquid>;

template <class S>
FluidProperties<S> properties(Fluid const& fluid, S const& temperature) {
  return std::visit([&](auto const& kind) { return properties(kind, temperature); }, fluid);
}

/// The fluid of this name: air, water, emulsion, water-glycol, ethylene glycol, oil VG10 … oil VG100; case ignored.
/// Throws InputError naming the nearest known ones.
[[nodiscard]] Fluid fluid(std::string_view name);

[[nodiscard]] std::vector<std::string> const& fluid_names();

}  // namespace thermotwin::thermal
