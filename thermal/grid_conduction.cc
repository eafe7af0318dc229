#include "thermal/grid_conduction.h"

#include <algorithm>

#include "thermal/fixed_blocks.h"
#include "thermal/grid_balance.h"

namespace thermotwin::thermal {

GridConduction::GridConduction(std::vector<Grid> const& grids, std::span<int const> ports,
                               std::span<double const> conductances) {
  for (auto const& grid : grids)
    if (grid.count() > 1) grids_.push_back(grid);
  for (auto& links : g_) links.resize(std::size_t(grids.back().end()));
  for (std::size_t k = 0; k < conductances.size(); ++k) {
    int const a = std::min(ports[2 * k], ports[2 * k + 1]), b = std::max(ports[2 * k], ports[2 * k + 1]);
    auto const after =
        std::upper_bound(grids_.begin(), grids_.end(), a, [](int node, Grid const& grid) { return node < grid.first; });
    int const d = after == grids_.begin() ? -1 : (after - 1)->direction(a, b - a);
    if (d >= 0)
      g_[std::size_t(d)][std::size_t(a)] += conductances[k];
    else
      others_.push_back({a, b, conductances[k]});
  }
  for (auto const& grid : grids_) alike_.push_back(layers_alike<double>(grid, links(), {}));
}

void GridConduction::add_heat_flows(double const* temperature, double* heat) const {
  for (std::size_t n = 0; n < grids_.size(); ++n)
    for_blocks(grids_[n].count(), [&, first = grids_[n].first](std::ptrdiff_t begin, std::ptrdiff_t end) {
      for_balances(grids_[n], links(), alike_[n], temperature, first + int(begin), first + int(end),
                   [heat](int i, int, double sum) { heat[i] += sum; });
    });
  for (auto const& [a, b, conductance] : others_) {
    double const into_a = conductance * (temperature[b] - temperature[a]);
    heat[a] += into_a;
    heat[b] -= into_a;
  }
}

}  // namespace thermotwin::thermal
