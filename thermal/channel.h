#pragma once

#include "thermal/body.h"

namespace thermotwin::thermal {

/// A line of fluid (coolant jacket, pipe): cells in the order of the flow, each well mixed, C = ρ c A Δ. Conduction
/// along the fluid is neglected; the upwind scheme spreads a front like a diffusivity ½ v Δ (1 − v Δt/Δ).
struct Channel {
  Eigen::Vector3d origin{0.0, 0.0, 0.0};  ///< inlet [m]
  Eigen::Vector3d axis{0.0, 0.0, 1.0};    ///< from inlet to outlet, any length
  double length = 0.0;                    ///< [m]
  double section_area = 0.0;              ///< [m²]
  double wetted_perimeter = 0.0;          ///< [m]
  double density = 0.0;                   ///< [kg/m³]
  double specific_heat = 0.0;             ///< [J/(kg K)]
  int cells = 10;
};

/// d_h = 4A/P [m] (physics.md 2.7).
[[nodiscard]] double hydraulic_diameter(Channel const& channel);

/// Face: "wall".
[[nodiscard]] Body make_body(std::string const& name, Channel const& channel);

/// The fluid's movement: inlet → first cell → … → last cell → outlet, upwind; `mass_flow` is an input [kg/s], ≥ 0.
/// The heat that the line carries away is then the loss into `outlet` less the gain from `inlet`.
void add_flow(NetworkBuilder& builder, int part, Body const& channel, double specific_heat, int mass_flow, Port inlet,
              Port outlet);

}  // namespace thermotwin::thermal
