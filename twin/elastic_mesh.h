#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "twin/elastic_block.h"

namespace thermotwin::twin {

/// The grid of a block as quadratic bricks, one per cell and in the same order, with corner and mid-edge nodes; it
/// stands with its corner at zero.
///
/// Numbering from 1. Nodes of an element: the four corners below, the four above, their edges below, above, upright.
class ElasticMesh {
 public:
  explicit ElasticMesh(thermal::Body const& block);

  [[nodiscard]] std::map<int, Eigen::Vector3d> const& nodes() const { return nodes_; }
  [[nodiscard]] std::vector<std::array<int, 20>> const& elements() const { return elements_; }

  /// Three corners of the block that do not stand in line, to hold it without restraint: all of the first, y and z of
  /// the second, z of the third.
  [[nodiscard]] std::array<int, 3> corners() const;

  /// The forces on nodes [N] that do the same work as a unit load's traction on the loaded face and its reaction on
  /// the fixed one, by exact integration over the part of each cell's face that belongs to it.
  [[nodiscard]] std::map<int, Eigen::Vector3d> forces(ElasticBlock const& block, Load const& load) const;

 private:
  [[nodiscard]] int node(std::array<int, 3> const& place) const;
  [[nodiscard]] std::array<int, 3> place_of(int cell) const;
  void add_traction(std::map<int, Eigen::Vector3d>& forces, thermal::Site const& face, Load const& at_centre) const;

  Eigen::Vector3d corner_;
  std::array<std::vector<double>, 3> edges_;
  std::map<int, Eigen::Vector3d> nodes_;
  std::vector<std::array<int, 20>> elements_;
};

}  // namespace thermotwin::twin
