#include "thermal/geometry.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace thermotwin::thermal {
namespace {

struct Centre {
  Eigen::Vector3d operator()(BoxCell const& box) const { return box.corner + 0.5 * box.edges.rowwise().sum(); }
  Eigen::Vector3d operator()(RingCell const& ring) const { return ring.origin + 0.5 * ring.height * ring.axis; }
};

struct Volume {
  double operator()(BoxCell const& box) const { return std::abs(box.edges.determinant()); }
  double operator()(RingCell const& ring) const {
    double const radii = ring.outer_radius * ring.outer_radius - ring.inner_radius * ring.inner_radius;
    return std::numbers::pi * radii * ring.height;
  }
};

}  // namespace

Eigen::Vector3d centre(Cell const& cell) { return std::visit(Centre{}, cell); }
double volume(Cell const& cell) { return std::visit(Volume{}, cell); }

int count_nodes(Geometry const& geometry) {
  int count = 0;
  for (auto const& body : geometry) count = std::max(count, body.first_node + static_cast<int>(body.cells.size()));
  return count;
}

}  // namespace thermotwin::thermal
