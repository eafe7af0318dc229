#pragma once

#include <span>
#include <vector>

#include "thermal/grid.h"

namespace thermotwin::thermal {

/// Constant conduction inside bodies, laid out along their grids: heat into node i += Σ_j g_ij (T_j − T_i). What flows
/// into one node is what flows out of the other, to the last bit.
class GridConduction {
 public:
  GridConduction() = default;
  /// Link k is that between ports 2k and 2k + 1; links between nodes that are no neighbours on a grid are kept apart.
  GridConduction(std::vector<Grid> const& grids, std::span<int const> ports, std::span<double const> conductances);

  void add_heat_flows(double const* temperature, double* heat) const;

 private:
  struct Link {
    int a, b;
    double conductance;
  };

  [[nodiscard]] std::array<double const*, 3> links() const { return {g_[0].data(), g_[1].data(), g_[2].data()}; }

  std::vector<Grid> grids_;               ///< of more than one node
  std::array<std::vector<double>, 3> g_;  ///< of each node, to the next along each direction [W/K]
  std::vector<bool> alike_;               ///< of each grid: its layers
  std::vector<Link> others_;
};

}  // namespace thermotwin::thermal
