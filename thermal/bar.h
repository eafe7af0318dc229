#pragma once

#include <optional>

#include "thermal/body.h"

namespace thermotwin::thermal {

/// A slender body whose temperature varies along its axis only (shaft, screw, test bar): G = kA/Δ between cells,
/// C = ρ c A Δ (physics.md 2.1). Δ ≤ ½ √(a t) resolves an input that changes within t (physics.md §0).
struct Bar {
  Material material;
  Eigen::Vector3d origin{0.0, 0.0, 0.0};  ///< centre of the start face [m]
  Eigen::Vector3d axis{0.0, 0.0, 1.0};    ///< from start to end, any length
  double length = 0.0;                    ///< [m]
  double outer_diameter = 0.0;            ///< of the perimeter that meets the air [m]
  double inner_diameter = 0.0;            ///< [m]
  std::optional<double> section_area;     ///< that conducts and stores, e.g. of a ball screw at its core [m²]
  int cells = 20;
};

/// Faces: "surface" (the perimeter), "start", "end".
[[nodiscard]] Body make_body(std::string const& name, Bar const& bar);

}  // namespace thermotwin::thermal
