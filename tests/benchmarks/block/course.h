#pragma once

#include <array>
#include <vector>

/// The block that the solvers of this folder run through (docs/performance.md): 1.0 × 0.5 × 0.3 m, k = 50 W/(m K), ρ c
/// = 3.6 MJ/(m³ K), films of 8 W/(m² K) to 20 °C on all faces, heat in a row of cells under the upper face.
namespace thermotwin::block {

inline constexpr std::array<double, 3> size{1.0, 0.5, 0.3};  // [m]
inline constexpr double conductivity = 50.0, density = 7200.0, specific_heat = 500.0, film = 8.0;
inline constexpr double room = 293.15;                                          // [K]
inline constexpr std::array<double, 4> until{3600.0, 5400.0, 9000.0, 14400.0};  // [s]
inline constexpr std::array<double, 4> watts{300.0, 0.0, 500.0, 100.0};
inline constexpr double output_interval = 60.0;  // [s]

/// The heated cells: n_x/4 … n_x/4 + n_x/8 at mid y, top z.
inline std::vector<int> heated_cells(std::array<int, 3> const& n) {
  std::vector<int> cells;
  for (int i = n[0] / 4; i < n[0] / 4 + n[0] / 8; ++i) cells.push_back(i + n[0] * (n[1] / 2 + n[1] * (n[2] - 1)));
  return cells;
}

}  // namespace thermotwin::block
