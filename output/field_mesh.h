#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "thermal/geometry.h"

namespace thermotwin::output {

/// A hexahedron or, at the axis of a solid cylinder, a wedge; corners in VTK's order.
struct Element {
  std::array<int, 8> corners{};
  int n_corners = 8;  ///< 6: a wedge
  int node = 0;       ///< whose values it shows
  int body = 0;
};

/// The machine as solids that fields can be drawn on.
///
/// A box cell is one hexahedron, a ring cell `segments` hexahedra or wedges around its axis. Corners are shared within
/// a body and never between bodies. The polygon through a ring's corners has the area of the circle: corners stand at
/// the radius times sqrt(φ / sin φ), φ = 2π / segments (0.6 % outside), so that the elements of a node have together
/// exactly the volume of its cell.
class FieldMesh {
 public:
  static constexpr int segments = 24;

  explicit FieldMesh(thermal::Geometry const& geometry);

  [[nodiscard]] Eigen::Matrix3Xd const& points() const { return points_; }  ///< [m]
  [[nodiscard]] std::vector<Element> const& elements() const { return elements_; }
  [[nodiscard]] std::vector<std::string> const& body_names() const { return body_names_; }
  [[nodiscard]] Eigen::VectorXd const& node_volumes() const { return node_volumes_; }  ///< [m³], 0 without a cell
  [[nodiscard]] Eigen::Index n_nodes() const { return node_volumes_.size(); }  ///< one past the last with a cell

  /// Mean of the nodes whose cells meet at each point.
  [[nodiscard]] Eigen::VectorXd mean_at_points(Eigen::VectorXd const& of_nodes) const;

  /// A vector known at the cells' centres, continued to the points: u(p) = mean over the cells at p of
  /// u_i + G_i (p − x_i), with the gradient G_i of least squares over the cells of the same body that touch cell i (in
  /// a direction without neighbours: 0). Exact where u is linear.
  [[nodiscard]] Eigen::Matrix3Xd continued_to_points(Eigen::Matrix3Xd const& of_nodes) const;

 private:
  /// Gradient at a cell: Σ (u_neighbour − u_cell) weightᵀ.
  struct Neighbour {
    int node;
    Eigen::Vector3d weight;
  };

  void add_body(thermal::BodyGeometry const& body, int number);
  void find_neighbours(std::size_t first_element);

  Eigen::Matrix3Xd points_;
  std::vector<Element> elements_;
  std::vector<std::string> body_names_;
  Eigen::VectorXd node_volumes_;
  Eigen::Matrix3Xd node_centres_;
  std::vector<std::vector<Neighbour>> neighbours_;  ///< per node
};

}  // namespace thermotwin::output
