#pragma once

#include <cmath>
#include <numbers>

namespace thermotwin::thermal {

/// Steady conductances of simple bodies [W/K]; k in W/(m K), lengths in m, areas in m².
/// Sources: Incropera; Carslaw & Jaeger 1959; physics.md §0, §2.1.

/// G = kA/L: bar or plate of section A and length L.
template <class S>
S bar_conductance(S const& k, S const& area, S const& length) {
  return k * area / length;
}

/// G = 2πkL/ln(r_o/r_i): hollow cylinder or ring of length L, from bore to outside.
template <class S>
S radial_conductance(S const& k, S const& length, S const& inner_radius, S const& outer_radius) {
  using std::log;
  return 2.0 * std::numbers::pi * k * length / log(S(outer_radius / inner_radius));
}

/// G = kπ(r_o² − r_i²)/L: hollow cylinder from end to end.
template <class S>
S axial_conductance(S const& k, S const& length, S const& inner_radius, S const& outer_radius) {
  return k * std::numbers::pi * (outer_radius * outer_radius - inner_radius * inner_radius) / length;
}

/// G = 8πkL: solid cylinder of length L, from its mean temperature to its surface, evenly heated (exact: T̄ − T_s =
/// q'''R²/8k).
template <class S>
S cylinder_mean_to_surface(S const& k, S const& length) {
  return 8.0 * std::numbers::pi * k * length;
}

/// G = 3kA/L: plate insulated at one face, of thickness L, from its mean temperature to the other face, evenly heated.
/// A plate cooled on both faces: two of these, each with half its thickness.
template <class S>
S plate_mean_to_surface(S const& k, S const& area, S const& thickness) {
  return 3.0 * k * area / thickness;
}

/// G = 4ka: disc of radius a, at one temperature, into a half space.
template <class S>
S spreading_conductance(S const& k, S const& radius) {
  return 4.0 * k * radius;
}

/// G = A/(Δx₁/2k₁ + 1/h_c + Δx₂/2k₂) (0.2): between the centres of two cells, with a contact film h_c [W/(m² K)].
template <class S>
S cell_conductance(S const& area, S const& width1, S const& k1, S const& contact_film, S const& width2, S const& k2) {
  return area / (0.5 * width1 / k1 + 1.0 / contact_film + 0.5 * width2 / k2);
}

/// G = A/(Δx/2k + 1/h) (0.3): from the centre of a surface cell to the fluid; h film [W/(m² K)].
template <class S>
S surface_cell_conductance(S const& area, S const& width, S const& k, S const& film) {
  return area / (0.5 * width / k + 1.0 / film);
}

}  // namespace thermotwin::thermal
