#include "thermal/grid.h"

#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "thermal/block.h"
#include "thermal/evaluation.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/laws.h"

namespace thermotwin::thermal {
namespace {

Material metal() {
  Material m = material("C45");
  m.conductivity_slope = 0.0;
  return m;
}

Network network_of(std::vector<Body> const& bodies) {
  NetworkBuilder builder;
  int const part = builder.part("bodies");
  Port const room = builder.add_boundary({"room", 293.15, {}});
  for (auto const& body : bodies) builder.connect(part, add_to(builder, part, body), room, 2.0);
  return builder.build();
}

TEST(Grid, IsReadOffTheLinksOfABody) {
  auto const network =
      network_of({make_body("block", Block{metal(), {0, 0, 0}, {0.5, 0.4, 0.3}, {5, 4, 3}}),
                  make_body("ring", HollowCylinder{metal(), {0, 0, 0}, {0, 0, 1}, 0.4, 0.16, 0.06, 6, 3}),
                  make_body("plate", Block{metal(), {0, 0, 0}, {0.5, 0.4, 0.3}, {5, 4, 1}})});
  ASSERT_EQ(network.grids().size(), 3U);
  EXPECT_EQ(network.grids()[0].n, (std::array{5, 4, 3}));
  EXPECT_EQ(network.grids()[1].n, (std::array{3, 6, 1}));  // the radius runs fastest
  EXPECT_EQ(network.grids()[2].n, (std::array{5, 4, 1}));
  EXPECT_EQ(network.grids()[1].first, 60);
}

TEST(Grid, KnowsNeighboursAndNoOthers) {
  Grid const grid{10, {5, 4, 3}};
  EXPECT_EQ(grid.direction(10, 1), 0);
  EXPECT_EQ(grid.direction(14, 1), -1);  // the end of a row
  EXPECT_EQ(grid.direction(10, 5), 1);
  EXPECT_EQ(grid.direction(25, 5), -1);  // the last row of a layer
  EXPECT_EQ(grid.direction(10, 20), 2);
  EXPECT_EQ(grid.direction(50, 20), -1);
  EXPECT_EQ(grid.direction(10, 2), -1);
}

/// Links along the grid, across it, twice the same, and in a body that is no grid at all.
TEST(GridConduction, IsTheLawOfItsLinks) {
  NetworkBuilder builder;
  int const part = builder.part("bodies");
  std::mt19937 random(7);
  std::uniform_real_distribution<double> between(0.5, 20.0);
  Body block = make_body("block", Block{metal(), {0, 0, 0}, {0.5, 0.4, 0.3}, {7, 5, 4}});
  for (auto& link : block.links) link.conductance = between(random);
  Port const first = add_to(builder, part, block);
  auto const node = [&](int i) { return Port{Port::Kind::node, first.index + i}; };
  builder.connect(part, node(1), node(0), 3.0);
  builder.connect(part, node(3), node(77), 4.0);
  Port const loose = builder.add_body("loose", std::vector<double>(6, 100.0));
  for (int i = 0; i < 5; ++i)
    builder.connect(part, {loose.kind, loose.index + i}, {loose.kind, loose.index + (i * 3 + 1) % 6}, between(random));
  builder.connect(part, node(9), loose, 5.0);
  builder.connect(part, {loose.kind, loose.index + 5}, loose, 5.0);
  builder.connect(part, {loose.kind, loose.index + 3}, loose, 5.0);
  builder.connect(part, {loose.kind, loose.index + 2}, loose, 5.0);
  builder.connect(part, node(0), builder.add_boundary({"room", 293.15, {}}), 2.0);
  Network const network = builder.build();

  std::vector<double> temperature, rate(std::size_t(network.nodes())), expected(std::size_t(network.temperatures()));
  for (int i = 0; i < network.nodes(); ++i) temperature.push_back(290.0 + between(random));
  Evaluation evaluation(network);
  evaluation.rate(temperature.data(), nullptr, rate.data());
  temperature.push_back(293.15);
  for (auto const& group : network.groups())
    group.law->add_heat_flows(group.batch(), temperature.data(), nullptr, expected.data());
  for (std::size_t i = 0; i < rate.size(); ++i)
    EXPECT_NEAR(rate[i] * network.capacity()[i], expected[i], 1e-10) << "node " << i;
}

}  // namespace
}  // namespace thermotwin::thermal
