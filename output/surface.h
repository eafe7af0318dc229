#pragma once

#include <array>
#include <vector>

#include "output/field_mesh.h"

namespace thermotwin::output {

/// What is seen of a mesh: the faces that belong to one element of their body only, as triangles, and the lines along
/// which they meet at more than 40° (the sides of a ring's polygon meet at 15°).
struct Surface {
  /// What a body has of the lists below; they follow one another, body by body.
  struct Extent {
    int first_point = 0, points = 0;
    int first_triangle = 0, triangles = 0;
    int first_edge = 0, edges = 0;
  };

  std::vector<int> points;                    ///< of the mesh; the surface's own numbers count along this list
  std::vector<std::array<int, 3>> triangles;  ///< own numbers, anticlockwise from outside
  std::vector<std::array<int, 2>> edges;      ///< own numbers
  std::vector<Extent> bodies;
};

[[nodiscard]] Surface surface_of(FieldMesh const& mesh);

}  // namespace thermotwin::output
