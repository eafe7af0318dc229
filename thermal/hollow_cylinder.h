#pragma once

#include "thermal/body.h"

namespace thermotwin::thermal {

/// An axisymmetric body, cells along the axis and along the radius; solid where the inner diameter is 0.
///
/// A node carries the mean temperature of its ring a ≤ r ≤ b. The mean of T = A + B ln r over the ring equals T at
///   ln r_c = (b² ln b − a² ln a)/(b² − a²) − ½,
/// so that G = 2πkL/ln(r_c2/r_c1) between rings and r_b ln(r_b/r_c)/k to a surface of radius r_b are exact for steady
/// radial flow at any number of cells, and of second order with sources or transients. Axially: G = kA/Δ, C = ρ c V.
struct HollowCylinder {
  Material material;
  Eigen::Vector3d origin{0.0, 0.0, 0.0};  ///< centre of the start face [m]
  Eigen::Vector3d axis{0.0, 0.0, 1.0};    ///< from start to end, any length
  double length = 0.0;                    ///< [m]
  double outer_diameter = 0.0;            ///< [m]
  double inner_diameter = 0.0;            ///< [m]
  int axial_cells = 10;
  int radial_cells = 3;
};

/// Faces: "outer", "inner" (unless solid), "start", "end".
[[nodiscard]] Body make_body(std::string const& name, HollowCylinder const& cylinder);

/// r_c of the ring a ≤ r ≤ b, see above [m].
[[nodiscard]] double mean_radius(double a, double b);

}  // namespace thermotwin::thermal
