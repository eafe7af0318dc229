#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sstream>
#include <string>

#include "tests/output/temporary_directory.h"
#include "thermal/block.h"
#include "thermal/material.h"
#include "twin/calculix.h"
#include "twin/elastic_mesh.h"
#include "twin/elastic_solution.h"
#include "twin/machine.h"
#include "twin/needed_solution.h"

// Influence weights against closed forms and against a direct thermal-stress run of CalculiX (physics.md §9: V5, V5b,
// V14).

namespace thermotwin::twin {
namespace {

using Eigen::Vector3d;

constexpr double alpha = 11.5e-6, poisson = 0.3;

ElasticBlock block_of(Vector3d const& size, std::array<int, 3> const& cells, char const* fixed, char const* loaded) {
  auto const body = thermal::make_body("block", {thermal::material("C45"), {0.1, -0.2, 0.3}, size, cells, 1.0});
  return elastic_block(body, poisson, fixed, loaded);
}

/// e [m] from the weights: field [K] at the centres of the cells, place from the block's corner.
template <class Field>
double by_weights(ElasticBlock const& block, Load const& load, Field field) {
  double sum = 0.0;
  for (int k = 0; k < 6; ++k) {
    if (load[k] == 0.0) continue;
    auto const weights = solve_unit_load(block, k);
    for (int i = 0; i < block.body.nodes(); ++i)
      sum += alpha * load[k] * weights[std::size_t(i)] *
             field(centre(block.body.cells[std::size_t(i)]) - block.body.origin);
  }
  return sum;
}

/// e [m] from a thermal-stress run: field at the nodes, the work of the unit load's forces on the displacements.
template <class Field>
double directly(ElasticBlock const& block, Load const& load, Field field) {
  ElasticMesh const mesh(block.body);
  std::string deck = calculix_model(mesh, 2.1e11, poisson, alpha);
  deck += "*INITIAL CONDITIONS,TYPE=TEMPERATURE\nALL,0.\n*STEP\n*STATIC\n*TEMPERATURE\n";
  for (auto const& [id, x] : mesh.nodes()) deck += fmt::format("{},{:.12e}\n", id, field(x));
  deck += "*NODE PRINT,NSET=ALL\nU\n*END STEP\n";
  auto const forces = mesh.forces(block, load);
  double work = 0.0;
  std::istringstream lines(run_calculix(deck));
  for (std::string line; std::getline(lines, line);) {
    int node = 0;
    Vector3d u;
    if (std::istringstream words(line); !(words >> node >> u[0] >> u[1] >> u[2])) continue;
    if (auto const it = forces.find(node); it != forces.end()) work += it->second.dot(u);
  }
  return work;
}

TEST(ReferenceInfluence, BarGrowsByItsLength) {
  auto const bar = block_of({0.5, 0.05, 0.05}, {10, 1, 1}, "x_min", "x_max");
  EXPECT_NEAR(by_weights(bar, Load::Unit(0), [](auto const&) { return 5.0; }), 28.75e-6, 1e-11);
}

TEST(ReferenceInfluence, GradientBendsACantileverByHalfItsSquareOverHeightWhateverTheMesh) {
  for (int across : {2, 3, 6}) {
    auto const bar = block_of({0.5, 0.05, 0.05}, {8, across, across}, "x_min", "x_max");
    Load const tip = unit_load(bar, Vector3d::UnitZ(), centre_of(bar.loaded), false);
    Load const tilt = unit_load(bar, Vector3d::UnitY(), centre_of(bar.loaded), true);
    auto const gradient = [](Vector3d const& x) { return -10.0 * x[2] / 0.05; };
    EXPECT_NEAR(by_weights(bar, tip, gradient), 287.5e-6, 1e-10);
    EXPECT_NEAR(by_weights(bar, tilt, gradient), -1150e-6, 1e-9);
  }
}

TEST(ReferenceInfluence, UniformWarmthMovesTheLoadedFaceByTheWayBetweenTheFaces) {
  auto const block = block_of({0.4, 0.5, 0.6}, {4, 5, 6}, "z_min[0 mm .. 250 mm, 100 mm .. 500 mm]",
                              "x_max[0 mm .. 150 mm, 0 mm .. 170 mm]");
  Vector3d const way = centre_of(block.loaded) - centre_of(block.fixed);
  for (int d = 0; d < 3; ++d)
    EXPECT_NEAR(by_weights(block, Load::Unit(d), [](auto const&) { return 1.0; }), alpha * way[d], 1e-6 * alpha) << d;
  for (int d = 3; d < 6; ++d)
    EXPECT_NEAR(by_weights(block, Load::Unit(d), [](auto const&) { return 1.0; }), 0.0, 1e-5 * alpha) << d;
}

TEST(ReferenceInfluence, WeightsEqualADirectRunWhereCellsCarryTheFieldExactly) {
  auto const block = block_of({0.4, 0.5, 1.0}, {4, 5, 8}, "z_min", "z_max[0 mm .. 230 mm, 100 mm .. 500 mm]");
  Vector3d const tool = block.body.origin + Vector3d(1.0, -0.3, 1.7);
  auto const warm = [](Vector3d const& x) { return (1.0 + 8.0 * x[0]) * (2.0 - 5.0 * x[1]) * (1.0 + 3.0 * x[2]); };
  for (int d = 0; d < 3; ++d) {
    Load const load = unit_load(block, Vector3d::Unit(d), tool, false);
    double const direct = directly(block, load, warm);
    EXPECT_NEAR(by_weights(block, load, warm), direct, 1e-5 * std::abs(direct)) << d;
  }
}

TEST(ReferenceInfluence, BeamMeetsTheSolidWhereItIsSlenderAndNearlyWhereItIsStout) {
  auto const worst = [](ElasticBlock const& block, auto const& field) {
    double error = 0.0;
    for (int d = 0; d < 3; ++d) {
      Load const load = unit_load(block, Vector3d::Unit(d), centre_of(block.loaded) + Vector3d(0.1, 0.2, 0.1), false);
      auto const beam = beam_solution(block, load);
      double sum = 0.0;
      for (int i = 0; i < block.body.nodes(); ++i)
        sum += alpha * beam[std::size_t(i)] * field(centre(block.body.cells[std::size_t(i)]) - block.body.origin);
      error = std::max(error, std::abs(sum / by_weights(block, load, field) - 1.0));
    }
    return error;
  };
  auto const warm = [](Vector3d const& x) { return 5.0 + 20.0 * std::exp(-x.squaredNorm() / 0.09); };
  EXPECT_LT(worst(block_of({0.2, 0.25, 1.5}, {4, 4, 16}, "z_min", "z_max"), warm), 0.02);
  EXPECT_LT(worst(block_of({0.4, 0.5, 1.0}, {6, 6, 12}, "z_min", "z_max"), warm), 0.1);
}

TEST(ReferenceInfluence, ErrorOfAStronglyCurvedFieldFallsWithTheCells) {
  auto const warm = [](Vector3d const& x) {
    return 20.0 * std::exp(-((x - Vector3d(0.4, 0.1, 0.6)).squaredNorm()) / 0.06) + 5.0 * std::sin(6.0 * x[2]);
  };
  auto const block = [](int n) { return block_of({0.4, 0.5, 1.0}, {2 * n, 2 * n, 4 * n}, "z_min", "z_max"); };
  Load const load = unit_load(block(4), Vector3d::UnitX(), centre_of(block(4).loaded), false);
  double const direct = directly(block(4), load, warm);
  double const coarse = std::abs(by_weights(block(1), load, warm) / direct - 1.0);
  double const fine = std::abs(by_weights(block(4), load, warm) / direct - 1.0);
  EXPECT_LT(fine, 0.008);
  EXPECT_LT(fine, 0.1 * coarse);
}

constexpr char const* column_and_head = R"(
name = "frame"
[[block]]
name = "column"
material = "GJL-300"
corner = ["-300 mm", "500 mm", "-200 mm"]
size = ["600 mm", "400 mm", "1200 mm"]
cells = [4, 3, 8]
[[block]]
name = "head"
material = "GJL-300"
corner = ["-200 mm", "-200 mm", "500 mm"]
size = ["400 mm", "700 mm", "400 mm"]
cells = [3, 5, 3]
[[film]]
name = "air"
on = ["column.y_max", "head.z_max"]
correlation = "room"
)";

std::string channels() {
  std::string text;
  for (auto const* direction : {"x", "y", "z"})
    text += fmt::format(R"(
[[displacement]]
name = "E_{0}"
direction = "{0}"
influence = [
  {{ body = "column", fixed = "z_min", loaded = "y_min[0.1 m .. 0.5 m, 0.7 m .. 1.1 m]", point = {1} }},
  {{ body = "head", fixed = "y_max", loaded = "z_min[0.12 m .. 0.28 m, 0.12 m .. 0.28 m]", point = {1} }},
]
)",
                        direction, R"(["50 mm", "0 mm", "300 mm"])");
  return text;
}

TEST(ReferenceInfluence, LoopOfBlocksAtOneTemperatureClosesInAMachineWhoseWeightsWereSolved) {
  tests::TemporaryDirectory const directory;
  auto const file = directory / "frame.toml";
  tests::put(file, column_and_head + channels());
  std::ostringstream progress;
  EXPECT_EQ(write_weights(file, progress), 12);
  EXPECT_EQ(write_weights(file, progress), 0);
  auto const machine = Machine::read(file);
  // From the middle of the column's foot (0, 700, −200) to its guide (0, 500, 700), and on from the back of the head
  // (0, 500, 700) to the seat under it (0, 0, 500).
  Vector3d const way = Vector3d(0.0, -200e-3, 900e-3) + Vector3d(0.0, -500e-3, -200e-3);
  for (int d = 0; d < 3; ++d) {
    double sum = 0.0;
    for (auto const& [node, weight] : machine.displacements[std::size_t(d)].weights) sum += weight;
    EXPECT_NEAR(sum, 10.5e-6 * way[d], 10.5e-6 * 1e-6) << d;
  }
}

}  // namespace
}  // namespace thermotwin::twin
