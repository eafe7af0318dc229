#pragma once

#include <Eigen/Core>
#include <string>

#include "thermal/geometry.h"

namespace thermotwin::tests {

/// A block of nx × ny × nz equal boxes, x running fastest.
inline thermal::BodyGeometry block(std::string name, int first_node, Eigen::Vector3d const& corner,
                                   Eigen::Vector3d const& size, Eigen::Vector3i const& cells) {
  thermal::BodyGeometry body{std::move(name), first_node, {}};
  Eigen::Vector3d const edge = size.cwiseQuotient(cells.cast<double>());
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        body.cells.push_back(thermal::BoxCell{corner + edge.cwiseProduct(Eigen::Vector3d(i, j, k)), edge.asDiagonal()});
  return body;
}

/// A cylinder cut into `axial` × `radial` rings, the radius running fastest.
inline thermal::BodyGeometry cylinder(std::string name, int first_node, thermal::RingCell const& whole, int axial,
                                      int radial) {
  thermal::BodyGeometry body{std::move(name), first_node, {}};
  double const height = whole.height / axial;
  double const width = (whole.outer_radius - whole.inner_radius) / radial;
  for (int k = 0; k < axial; ++k)
    for (int i = 0; i < radial; ++i)
      body.cells.push_back(thermal::RingCell{whole.origin + k * height * whole.axis, whole.axis, height,
                                             whole.inner_radius + i * width, whole.inner_radius + (i + 1) * width});
  return body;
}

inline int n_nodes(thermal::Geometry const& geometry) {
  int count = 0;
  for (auto const& body : geometry) count = std::max(count, body.first_node + static_cast<int>(body.cells.size()));
  return count;
}

inline Eigen::Matrix3Xd centres(thermal::Geometry const& geometry) {
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, n_nodes(geometry));
  for (auto const& body : geometry)
    for (std::size_t i = 0; i < body.cells.size(); ++i)
      points.col(body.first_node + static_cast<int>(i)) = thermal::centre(body.cells[i]);
  return points;
}

/// A vertical machining centre: bed, column, head, two spindle rings and a solid shaft; 1 m wide, 1.9 m high.
inline thermal::Geometry machine(int refinement = 1) {
  int const n = refinement;
  thermal::Geometry geometry;
  auto const add = [&](thermal::BodyGeometry body) { geometry.push_back(std::move(body)); };
  add(block("bed", 0, {-0.5, -0.9, 0.0}, {1.0, 1.6, 0.4}, {4 * n, 6 * n, 2 * n}));
  add(block("table", n_nodes(geometry), {-0.4, -0.8, 0.42}, {0.8, 0.5, 0.12}, {4 * n, 3 * n, n}));
  add(block("column", n_nodes(geometry), {-0.3, 0.1, 0.4}, {0.6, 0.5, 1.5}, {3 * n, 3 * n, 8 * n}));
  add(block("head", n_nodes(geometry), {-0.2, -0.5, 1.15}, {0.4, 0.58, 0.5}, {3 * n, 4 * n, 4 * n}));
  Eigen::Vector3d const nose(0.0, -0.62, 0.95);
  Eigen::Vector3d const up = Eigen::Vector3d::UnitZ();
  add(cylinder("cartridge", n_nodes(geometry), {nose, up, 0.75, 0.06, 0.11}, 8 * n, 2 * n));
  add(cylinder("shaft", n_nodes(geometry), {nose - 0.06 * up, up, 0.75, 0.0, 0.045}, 10 * n, 2 * n));
  add({"motor",
       n_nodes(geometry),
       {thermal::BoxCell{{-0.13, -0.75, 1.72}, Eigen::Vector3d(0.26, 0.26, 0.28).asDiagonal()}}});
  return geometry;
}

}  // namespace thermotwin::tests
