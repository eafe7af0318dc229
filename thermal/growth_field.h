#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "thermal/body.h"

namespace thermotwin::thermal {

/// A body as it grows: its grid, its expansion, and where it is held by the body that carries it.
struct GrowingBody {
  Body::Shape shape = Body::Shape::lump;
  Eigen::Vector3d origin{0.0, 0.0, 0.0}, axis{0.0, 0.0, 1.0};
  std::array<std::vector<double>, 3> stations;  ///< of the nodes, from the origin [m]
  std::vector<double> weights;                  ///< of the nodes in means
  int first_node = 0;
  double expansion = 0.0;                  ///< α [1/K]
  int carrier = -1;                        ///< index of a body before this one; −1: it stands on the floor
  Eigen::Vector3d held_at{0.0, 0.0, 0.0};  ///< [m]
};

/// The grid of a body whose nodes start at `first_node`, held nowhere yet.
[[nodiscard]] GrowingBody growing_body(Body const& body, int first_node, double expansion);

/// The middle of the side of a body's box that faces the floor; `up`: unit vector along an axis [m].
[[nodiscard]] Eigen::Vector3d lower_face(Body const& body, Eigen::Vector3d const& up);

/// Where a body meets the one that carries it, if nobody says: in each direction the middle of what their boxes share,
/// or, if there is a gap, the side of the body's box that faces the carrier [m].
[[nodiscard]] Eigen::Vector3d contact_centre(Body const& body, Body const& carrier);

/// Displacement [m] of the centre of every cell, from the rise of every node θ [K]; 3 × nodes. For looking at: a field
/// to draw and to write; the numbers of the displacement channels come from their own integrals and influence weights.
///
/// A body moves like a rigid one with the place of its carrier where it is held, h, and grows from there. Sections
/// across each direction d of its grid have the mean rise θ̄ and, in a block, the gradients κ/α along both e ≠ d:
///
///   u_d = ∫ α θ̄ ds + Σₑ (xₑ − cₑ) ∫ κₑ ds,   uₑ = −∫∫ κₑ ds ds,   ω = Σₑ ∫ κₑ ds (ê × d̂),
///
/// all from h_d to x_d, cₑ the middle of the section. Exact for a temperature that is linear over the body, which
/// bends it without stress; for others the sections stay plane (physics.md 3.1, 3.5). A cylinder grows along its axis.
[[nodiscard]] Eigen::Matrix3Xd growth_field(std::vector<GrowingBody> const& bodies, std::span<double const> rise);

}  // namespace thermotwin::thermal
