#pragma once

#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace thermotwin::thermal {

/// Seals: their torque does not depend on speed, so their heat M ω is linear in it (bearing_friction.h: friction_heat).
/// Source: physics.md §1.6.

/// Contact seals of a bearing, both together: M = K₁ d^β + K₂ in N mm and mm.
struct BearingSeal {
  double k1 = 0.0;
  double beta = 2.0;
  double k2 = 0.0;

  /// [N m], d diameter of the counterface [m].
  [[nodiscard]] double torque(double counterface_diameter) const;
};

/// Constants by bearing type (bearing_seal_types()) and outer diameter [m], which matters for deep groove ball bearings
/// alone. Source: SKF 2006. Throws InputError naming the nearest known type.
[[nodiscard]] BearingSeal bearing_seal(std::string_view bearing_type, double outer_diameter);

[[nodiscard]] std::vector<std::string> const& bearing_seal_types();

/// M = ½π μ p_l d² [N m]: radial lip seal; friction coefficient μ 0.2 to 0.4, line force p_l 50 to 200 N/m, d shaft
/// diameter [m].
template <class S>
S lip_seal_torque(S const& friction, S const& line_force, S const& diameter) {
  return 0.5 * std::numbers::pi * friction * line_force * diameter * diameter;
}

/// q = V̇ ρ c (T_air − T) [W] into the body at T: purge air of a labyrinth, 10 to 60 L/min; ρc [J/(m³ K)].
template <class S>
S purge_air_heat(S const& volume_flow, S const& volumetric_heat, S const& air_temperature, S const& temperature) {
  return volume_flow * volumetric_heat * (air_temperature - temperature);
}

}  // namespace thermotwin::thermal
