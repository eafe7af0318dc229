#pragma once

#include <vector>

#include "thermal/site.h"

namespace thermotwin::thermal {

/// Two nodes that touch in a joint between two sites.
struct Pair {
  int a = 0, b = 0;         ///< nodes of the two bodies, from 0
  double share = 0.0;       ///< of the joint, Σ = 1
  double area = 0.0;        ///< of contact [m²]; 0 where neither site has an area
  double resistance = 0.0;  ///< r_a/A_a + r_b/A_b from the nodes to their surfaces [K/W]
};

/// Which nodes of two sites touch, and how much of the joint each pair carries:
/// - one node with anything: the product of the shares;
/// - two plane faces in one plane: the overlap of their rectangles;
/// - two coaxial mantles: the overlap of their intervals along the axis, each layer by its shares;
/// - a mantle in a block whose edges are parallel to the axis: likewise, layer by layer;
/// - the end of a cylinder on a plane face or on another end: the overlap of ring and rectangle, ring and ring.
/// All overlaps are exact. InputError, by the names of both bodies, if the sites do not touch.
[[nodiscard]] std::vector<Pair> pair(Site const& a, Site const& b);

/// A joint of conductance G [W/K] between the surfaces: 1/(r_a/A + 1/(G share) + r_b/A) for each pair (physics.md 0.2).
void connect(NetworkBuilder& builder, int part, Site const& a, Site const& b, double conductance);

/// A joint with h [W/(m² K)] over the area of contact: 1/(r_a/A + 1/(hA) + r_b/A). InputError without an area.
void connect_by_area(NetworkBuilder& builder, int part, Site const& a, Site const& b, double coefficient);

/// Two surfaces that are one: only the half cells resist, 1/(r_a/A + r_b/A). InputError if neither has a resistance.
void weld(NetworkBuilder& builder, int part, Site const& a, Site const& b);

}  // namespace thermotwin::thermal
