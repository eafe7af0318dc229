#include "thermal/bounding_box.h"

namespace thermotwin::thermal {

Eigen::AlignedBox3d bounding_box(std::vector<Cell> const& cells) {
  using Eigen::Vector3d;
  Eigen::AlignedBox3d box;
  for (auto const& cell : cells) {
    if (auto const* brick = std::get_if<BoxCell>(&cell)) {
      box.extend(brick->corner);
      box.extend(brick->corner + brick->edges.rowwise().sum());
    } else {
      auto const& ring = std::get<RingCell>(cell);
      Vector3d const reach = ring.outer_radius * (Vector3d::Ones() - ring.axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
      for (double const height : {0.0, ring.height})
        for (double const side : {-1.0, 1.0}) box.extend(ring.origin + height * ring.axis + side * reach);
    }
  }
  return box;
}

}  // namespace thermotwin::thermal
