#pragma once

#include <algorithm>
#include <array>

#include "thermal/grid.h"

namespace thermotwin::thermal {

/// For each node i of [begin, end), all of one grid: visit(i, Σ_j g_ij (x_j − x_i)) over its neighbours j. `g[d][i]`
/// belongs to i and its next neighbour along d, and is zero where there is none. Where an index would leave the grid, a
/// node is its own neighbour, so that all nodes are vectors of one loop.
template <class G, class X, class Visit>
void for_balances(Grid const& grid, std::array<G const*, 3> const& g, X const* x, int begin, int end,
                  Visit const& visit) {
  std::array<int, 8> bounds{begin, end};
  for (int d = 0; d < 3; ++d) {
    bounds[std::size_t(2 + d)] = std::clamp(grid.first + grid.stride(d), begin, end);
    bounds[std::size_t(5 + d)] = std::clamp(grid.end() - grid.stride(d), begin, end);
  }
  std::sort(bounds.begin(), bounds.end());
  G const *gx = g[0], *gy = g[1], *gz = g[2];
  for (std::size_t piece = 0; piece + 1 < bounds.size(); ++piece) {
    int const from = bounds[piece], to = bounds[piece + 1];
    if (from == to) continue;
    std::array<int, 3> back{}, ahead{};
    for (int d = 0; d < 3; ++d) {
      int const stride = grid.n[std::size_t(d)] > 1 ? grid.stride(d) : 0;
      if (from - stride >= grid.first) back[std::size_t(d)] = stride;
      if (from + stride < grid.end()) ahead[std::size_t(d)] = stride;
    }
    int const bx = back[0], by = back[1], bz = back[2], ax = ahead[0], ay = ahead[1], az = ahead[2];
#pragma omp simd
    for (int i = from; i < to; ++i) {
      X const here = x[i];
      X const along = gx[i] * (x[i + ax] - here) + gx[i - bx] * (x[i - bx] - here);
      X const across = gy[i] * (x[i + ay] - here) + gy[i - by] * (x[i - by] - here);
      visit(i, along + across + (gz[i] * (x[i + az] - here) + gz[i - bz] * (x[i - bz] - here)));
    }
  }
}

}  // namespace thermotwin::thermal
