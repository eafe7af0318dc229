#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "thermal/grid.h"

namespace thermotwin::thermal {

/// Whether what nodes have, and their links, is the same in all layers of a grid but the first and the last, the links
/// from the first one on included: as in a block of equal cells.
template <class T>
[[nodiscard]] bool layers_alike(Grid const& grid, std::array<T const*, 3> const& g, std::span<T const* const> fields) {
  int const layer = grid.stride(2), layers = grid.n[2];
  if (layers < 4) return false;
  auto const repeats = [&](T const* values, int from) {  // layers from .. layers − 2
    T const* const begin = values + grid.first + from * layer;
    T const* const end = values + grid.end() - layer;
    return std::equal(begin + layer, end, begin);
  };
  return repeats(g[0], 1) && repeats(g[1], 1) && repeats(g[2], 0) &&
         std::all_of(fields.begin(), fields.end(), [&](T const* values) { return repeats(values, 1); });
}

/// For each node i of [begin, end), all of one grid: visit(i, k, Σ_j g_ij (x_j − x_i)) over its neighbours j. `g[d][i]`
/// belongs to i and its next neighbour along d, and is zero where there is none. Where an index would leave the grid, a
/// node is its own neighbour, so that all nodes are vectors of one loop. k is the node of the second layer that stands
/// for i where layers are `alike`: what the cache holds of that need not come from memory again; else i itself.
template <class G, class X, class Visit>
void for_balances(Grid const& grid, std::array<G const*, 3> const& g, bool alike, X const* x, int begin, int end,
                  Visit const& visit) {
  std::array<int, 8> bounds{begin, end};
  for (int d = 0; d < 3; ++d) {
    bounds[std::size_t(2 + d)] = std::clamp(grid.first + grid.stride(d), begin, end);
    bounds[std::size_t(5 + d)] = std::clamp(grid.end() - grid.stride(d), begin, end);
  }
  std::sort(bounds.begin(), bounds.end());
  G const *gx = g[0], *gy = g[1], *gz = g[2];
  int const layer = grid.stride(2), last = grid.n[2] - 1;
  for (std::size_t piece = 0; piece + 1 < bounds.size(); ++piece) {
    int const piece_end = bounds[piece + 1];
    std::array<int, 3> back{}, ahead{};
    for (int d = 0; d < 3; ++d) {
      int const stride = grid.n[std::size_t(d)] > 1 ? grid.stride(d) : 0;
      if (bounds[piece] - stride >= grid.first) back[std::size_t(d)] = stride;
      if (bounds[piece] + stride < grid.end()) ahead[std::size_t(d)] = stride;
    }
    int const bx = back[0], by = back[1], bz = back[2], ax = ahead[0], ay = ahead[1], az = ahead[2];
    for (int from = bounds[piece], to = piece_end; from < piece_end; from = to, to = piece_end) {
      int up = 0;  // from the node whose constants are read
      if (alike) {
        int const number = (from - grid.first) / layer;
        to = std::min(to, grid.first + (number + 1) * layer);
        if (number > 0 && number < last) up = (number - 1) * layer;
      }
#pragma omp simd
      for (int i = from; i < to; ++i) {
        X const here = x[i];
        int const k = i - up;
        X const along = gx[k] * (x[i + ax] - here) + gx[k - bx] * (x[i - bx] - here);
        X const across = gy[k] * (x[i + ay] - here) + gy[k - by] * (x[i - by] - here);
        visit(i, k, along + across + (gz[k] * (x[i + az] - here) + gz[k - bz] * (x[i - bz] - here)));
      }
    }
  }
}

}  // namespace thermotwin::thermal
