#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

namespace thermotwin::thermal {

/// Where a cell is, in machine coordinates [m]: right-handed, Z up for vertical machines.

/// A rectangular cell: origin at one corner, three edge vectors.
struct BoxCell {
  Eigen::Vector3d corner;
  Eigen::Matrix3d edges;  ///< columns are the three edges
};

/// A full ring about an axis: the cell of a hollow cylinder or, with inner radius 0, of a solid one.
struct RingCell {
  Eigen::Vector3d origin;  ///< centre of the lower face
  Eigen::Vector3d axis;    ///< unit vector; the ring spans [0, height] along it
  double height = 0.0;
  double inner_radius = 0.0;
  double outer_radius = 0.0;
};

using Cell = std::variant<BoxCell, RingCell>;

[[nodiscard]] Eigen::Vector3d centre(Cell const& cell);
[[nodiscard]] double volume(Cell const& cell);

/// One body as the fields show it: a name and one cell per node, `first_node` onwards in the network's order.
struct BodyGeometry {
  std::string name;
  int first_node = 0;
  std::vector<Cell> cells;
};

using Geometry = std::vector<BodyGeometry>;

/// One past the last node with a cell.
[[nodiscard]] int count_nodes(Geometry const& geometry);

}  // namespace thermotwin::thermal
