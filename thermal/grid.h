#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <vector>

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

/// For each node i of [begin, end), all of one grid: visit(i, Σ_j g_ij (x_j − x_i)) over its neighbours j. `g[d][i]`
/// belongs to i and its next neighbour along d, and is zero where there is none.
template <class G, class X, class Visit>
void for_balances(Grid const& grid, std::array<G const*, 3> const& g, X const* x, int begin, int end,
                  Visit const& visit) {
  int const sy = grid.stride(1), sz = grid.stride(2), last = grid.end();
  int const reach = grid.n[2] > 1 ? sz : grid.n[1] > 1 ? sy : 1;
  G const *gx = g[0], *gy = g[1], *gz = g[2];
  auto const near_border = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      X sum = 0;
      for (int d = 0; d < 3; ++d) {
        int const s = grid.stride(d);
        if (grid.n[std::size_t(d)] == 1) continue;
        if (i + s < last) sum += g[std::size_t(d)][i] * (x[i + s] - x[i]);
        if (i - s >= grid.first) sum += g[std::size_t(d)][i - s] * (x[i - s] - x[i]);
      }
      visit(i, sum);
    }
  };
  int const inner_begin = std::clamp(grid.first + reach, begin, end);
  int const inner_end = std::clamp(last - reach, inner_begin, end);
  near_border(begin, inner_begin);
  if (grid.n[2] > 1) {
#pragma omp simd
    for (int i = inner_begin; i < inner_end; ++i) {
      X const here = x[i];
      X const along = gx[i] * (x[i + 1] - here) + gx[i - 1] * (x[i - 1] - here);
      X const across = gy[i] * (x[i + sy] - here) + gy[i - sy] * (x[i - sy] - here);
      visit(i, along + across + (gz[i] * (x[i + sz] - here) + gz[i - sz] * (x[i - sz] - here)));
    }
  } else {
    for (int i = inner_begin; i < inner_end; ++i) {
      X sum = gx[i] * (x[i + 1] - x[i]) + gx[i - 1] * (x[i - 1] - x[i]);
      if (grid.n[1] > 1) sum += gy[i] * (x[i + sy] - x[i]) + gy[i - sy] * (x[i - sy] - x[i]);
      visit(i, sum);
    }
  }
  near_border(inner_end, end);
}

}  // namespace thermotwin::thermal
