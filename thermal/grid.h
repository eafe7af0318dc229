#pragma once

#include <Eigen/SparseCore>
#include <array>

namespace thermotwin::thermal {

/// Consecutive nodes that stand in rows, columns and layers and conduct to their neighbours: node first + i + n₀ (j +
/// n₁ k). A lump is a grid of one.
struct Grid {
  int first = 0;
  std::array<int, 3> n{1, 1, 1};

  [[nodiscard]] int count() const { return n[0] * n[1] * n[2]; }
  [[nodiscard]] int end() const { return first + count(); }
  /// From a node to its neighbour along direction d.
  [[nodiscard]] int stride(int d) const { return d == 0 ? 1 : d == 1 ? n[0] : n[0] * n[1]; }
  /// Of the node `from` and its neighbour at a distance of `offset` > 0 nodes; −1 if they are not neighbours.
  [[nodiscard]] int direction(int from, int offset) const;
};

/// The grid that the links inside `count` nodes starting at `first` form, read off their pattern (symmetric): a row if
/// they form none.
[[nodiscard]] Grid find_grid(Eigen::SparseMatrix<double> const& pattern, int first, int count);

}  // namespace thermotwin::thermal
