#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "thermal/physical_constant.h"

namespace thermotwin::thermal {

/// A solid. Properties at 20 °C; conductivity and specific heat are linear in temperature:
///   k(T) = k₂₀ (1 + b_k (T − 20 °C)),  c(T) = c₂₀ (1 + b_c (T − 20 °C)),  20…60 °C.
///
/// Source: physics.md §5. Where that table gives a range, its middle or the value that it says to use stands here;
/// Poisson ratios and emissivities that it leaves open are those of the nearest relative in the table. Spread of real
/// batches: 5 to 10 %. What carries no load (winding, grease) has a Young's modulus of 0.
struct Material {
  std::string name;
  double conductivity = 0.0;         ///< k₂₀ [W/(m K)]
  double conductivity_slope = 0.0;   ///< b_k [1/K]
  double density = 0.0;              ///< [kg/m³]
  double specific_heat = 0.0;        ///< c₂₀ [J/(kg K)]
  double specific_heat_slope = 0.0;  ///< b_c [1/K]
  double expansion = 0.0;            ///< linear [1/K]
  double youngs_modulus = 0.0;       ///< [Pa]
  double poisson_ratio = 0.0;        ///< [1]
  double emissivity = 0.0;           ///< of the usual surface: machined, cast and painted, bare [1]
  std::string meaning = {};          ///< what people call it, where the name does not say
};

/// k(T) [W/(m K)] at T [K].
template <class S>
S conductivity(Material const& material, S const& temperature) {
  return material.conductivity * (1.0 + material.conductivity_slope * (temperature - reference_temperature));
}

/// c(T) [J/(kg K)] at T [K].
template <class S>
S specific_heat(Material const& material, S const& temperature) {
  return material.specific_heat * (1.0 + material.specific_heat_slope * (temperature - reference_temperature));
}

/// a = k/(ρ c) at 20 °C [m²/s].
[[nodiscard]] inline double diffusivity(Material const& material) {
  return material.conductivity / (material.density * material.specific_heat);
}

/// The solid of this name, case ignored. Throws InputError naming the nearest known ones.
[[nodiscard]] Material const& material(std::string_view name);

[[nodiscard]] std::vector<std::string> const& material_names();

}  // namespace thermotwin::thermal
