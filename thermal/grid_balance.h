#pragma once

#include <algorithm>
#include <array>

#include "thermal/grid.h"

namespace thermotwin::thermal {

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
