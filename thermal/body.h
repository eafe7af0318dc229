#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "thermal/geometry.h"
#include "thermal/material.h"
#include "thermal/network.h"

namespace thermotwin::thermal {

/// The part of a body's face that belongs to one cell.
struct Facet {
  int cell = 0;
  double area = 0.0;             ///< [m²]
  double half_resistance = 0.0;  ///< from the cell's node to the surface [m² K/W]: Δ/(2k) (physics.md 0.2, 0.3)
  Eigen::Vector3d centre{0.0, 0.0, 0.0};
  Eigen::Vector3d normal{0.0, 0.0, 0.0};          ///< outwards; zero where it turns around an axis
  double low = 0.0, high = 0.0;                   ///< interval along the body's axis [m]
  double inner_radius = 0.0, outer_radius = 0.0;  ///< of the end faces of a bar or a cylinder [m]
};

/// A solid, discretised into finite volumes: cells with a capacity each, links between neighbours, faces to the
/// outside. It knows nothing of a network; `add_to` makes nodes of its cells, in the same order.
///
/// The cells form a grid: along the axis (bar, channel), axis × radius (hollow cylinder), x × y × z (block); the first
/// direction of a block and the radius of a cylinder run fastest. A lump is a grid of one.
struct Body {
  enum class Shape { lump, axial, block };
  struct Link {
    int a, b;
    double conductance;  ///< at 20 °C [W/K]
  };

  std::string name;
  Shape shape = Shape::lump;
  Eigen::Vector3d origin{0.0, 0.0, 0.0};        ///< start of the axis; corner of a block
  Eigen::Vector3d axis{0.0, 0.0, 1.0};          ///< unit vector
  std::array<std::vector<double>, 3> edges;     ///< of the grid, from the origin [m]: axis, radius, – or x, y, z
  std::array<std::vector<double>, 3> stations;  ///< where the nodes stand between the edges [m]

  double conductivity_slope = 0.0;  ///< [1/K]
  double capacity_slope = 0.0;      ///< [1/K]
  std::vector<Cell> cells;
  std::vector<double> capacities;  ///< at 20 °C [J/K]
  std::vector<Link> links;
  std::map<std::string, std::vector<Facet>> faces;

  [[nodiscard]] int nodes() const { return int(capacities.size()); }
  /// Cells along direction d of the grid, at least 1.
  [[nodiscard]] int count(int d) const { return std::max(1, int(stations[std::size_t(d)].size())); }
  /// Index of a cell from its place in the grid.
  [[nodiscard]] int cell(int i, int j = 0, int k = 0) const;
  /// InputError with the names of the faces that there are.
  [[nodiscard]] std::vector<Facet> const& face(std::string const& face_name) const;
};

/// Makes nodes of the cells and conduction of the links; returns the port of the first node.
Port add_to(NetworkBuilder& builder, int part, Body const& body);

/// The body as the fields show it, once its nodes start at `first_node`.
[[nodiscard]] BodyGeometry geometry_of(Body const& body, int first_node);

/// InputError "<body>: the <what> is <value> m; it must be positive".
void require_positive(std::string const& body, std::string const& what, double value);

/// n equal parts of a length: n + 1 edges.
[[nodiscard]] std::vector<double> equal_edges(double length, int n);
/// Middles between the edges.
[[nodiscard]] std::vector<double> middles(std::vector<double> const& edges);

}  // namespace thermotwin::thermal
