#include "thermal/grid_conduction.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace thermotwin::thermal {
namespace {

constexpr int before = 3, behind = 5;  ///< nodes of others around the grid

class GridOfAnyForm : public testing::TestWithParam<std::array<int, 3>> {};

/// Whole numbers, whose sums are exact in any order; what is not the grid's would make NaN of them.
template <class Conductance>
void expect_that_links_conduct(std::array<int, 3> const& n, Conductance const& conductance) {
  Grid const grid{before, n};
  auto const size = std::size_t(grid.end() + behind);
  std::vector<double> T(size, std::numeric_limits<double>::quiet_NaN()), expected(size), heat(size), conductances;
  std::vector<int> ports;
  for (int i = grid.first; i < grid.end(); ++i) T[std::size_t(i)] = (i * 37) % 101;
  for (int i = grid.first; i < grid.end(); ++i)
    for (int d = 0; d < 3; ++d) {
      int const place = (i - grid.first) / grid.stride(d) % n[std::size_t(d)], next = i + grid.stride(d);
      if (place + 1 == n[std::size_t(d)]) continue;
      conductances.push_back(conductance(i - grid.first, d));
      ports.insert(ports.end(), {next, i});
      double const flow = conductances.back() * (T[std::size_t(next)] - T[std::size_t(i)]);
      expected[std::size_t(i)] += flow;
      expected[std::size_t(next)] -= flow;
    }
  GridConduction({grid}, ports, conductances).add_heat_flows(T.data(), heat.data());
  EXPECT_EQ(heat, expected);
}

TEST_P(GridOfAnyForm, ConductsAlongEachLinkAndNoOther) {
  expect_that_links_conduct(GetParam(), [](int i, int d) { return 1 + (i * 13 + d * 7) % 29; });
}

/// As a block of equal cells, whose layers are read from one, and with a single link that is another one.
TEST_P(GridOfAnyForm, ConductsInLayersThatAreAlikeAndInAllButOne) {
  auto const& n = GetParam();
  int const layer = n[0] * n[1];
  auto const alike = [&](int i, int d) { return 1 + (i % layer * 13 + d * 7) % 29; };
  expect_that_links_conduct(n, alike);
  for (int odd = 0; odd < layer * n[2]; odd += std::max(1, layer / 3))
    for (int along = 0; along < 3; ++along)
      expect_that_links_conduct(n, [&](int i, int d) { return alike(i, d) + (i == odd && d == along ? 31 : 0); });
}

INSTANTIATE_TEST_SUITE_P(Forms, GridOfAnyForm,
                         testing::Values(std::array{7, 5, 3}, std::array{4, 1, 3}, std::array{1, 5, 4},
                                         std::array{6, 3, 1}, std::array{1, 5, 1}, std::array{1, 1, 6},
                                         std::array{9, 1, 1}, std::array{2, 2, 2}, std::array{20, 21, 22}));

}  // namespace
}  // namespace thermotwin::thermal
