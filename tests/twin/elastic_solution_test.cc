#include "twin/elastic_solution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "thermal/block.h"
#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using Eigen::Vector3d;

ElasticBlock beam(Vector3d const& size, std::array<int, 3> const& cells, char const* fixed, char const* loaded) {
  auto const body = thermal::make_body("beam", {thermal::material("C45"), {0.1, -0.2, 0.3}, size, cells, 1.0});
  return elastic_block(body, 0.3, fixed, loaded);
}

/// e/α for a temperature field that counts from the block's corner.
template <class Field>
double response(ElasticBlock const& block, Load const& load, Field field) {
  auto const sums = beam_solution(block, load);
  double sum = 0.0;
  for (int i = 0; i < block.body.nodes(); ++i)
    sum += sums[std::size_t(i)] * field(centre(block.body.cells[std::size_t(i)]) - block.body.origin);
  return sum;
}

TEST(BeamSolution, WarmBlockMovesItsEndByItsLengthAlongItselfOnly) {
  auto const block = beam({0.3, 1.2, 0.4}, {3, 6, 4}, "y_max", "y_min");
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(response(block, Load::Unit(k), [](auto const&) { return 1.0; }), k == 1 ? -1.2 : 0.0, 1e-13) << k;
}

TEST(BeamSolution, GradientBendsByHalfTheSquareOfTheLengthOverHeightInEitherPlane) {
  double const length = 0.5, height = 0.08, width = 0.05;
  auto const block = beam({length, width, height}, {5, 3, 4}, "x_min", "x_max");
  auto const upwards = [&](Vector3d const& x) { return x[2] / height; };
  auto const sideways = [&](Vector3d const& x) { return x[1] / width; };
  EXPECT_NEAR(response(block, Load::Unit(2), upwards), -length * length / (2.0 * height), 1e-12);
  EXPECT_NEAR(response(block, Load::Unit(4), upwards), length / height, 1e-12);
  EXPECT_NEAR(response(block, Load::Unit(1), sideways), -length * length / (2.0 * width), 1e-12);
  EXPECT_NEAR(response(block, Load::Unit(5), sideways), -length / width, 1e-12);
  EXPECT_NEAR(response(block, Load::Unit(3), sideways), 0.0, 1e-12);
}

TEST(BeamSolution, ToolCarriedByTheEndMovesWithItsLever) {
  auto const block = beam({0.5, 0.05, 0.05}, {5, 3, 3}, "x_min", "x_max");
  Vector3d const tool = centre_of(block.loaded) + Vector3d(0.7, 0.0, -0.2);
  auto const field = [](Vector3d const& x) { return std::exp(3.0 * x[0] * x[2]); };
  auto const at = [&](int k) { return response(block, Load::Unit(k), field); };
  EXPECT_NEAR(response(block, unit_load(block, Vector3d::UnitZ(), tool, false), field), at(2) - 0.7 * at(4), 1e-14);
  EXPECT_NEAR(response(block, unit_load(block, Vector3d::UnitX(), tool, false), field), at(0) - 0.2 * at(4), 1e-14);
}

TEST(BeamSolution, OnlyBetweenWholeOppositeFaces) {
  auto const refused = [](char const* fixed, char const* loaded) {
    auto const block = beam({0.5, 0.5, 0.5}, {2, 2, 2}, fixed, loaded);
    EXPECT_THROW((void)beam_solution(block, Load::Unit(0)), thermal::InputError) << fixed << " " << loaded;
  };
  refused("x_min", "y_max");
  refused("x_min", "x_max[0 mm .. 250 mm, 0 mm .. 500 mm]");
  refused("x_min[100 mm .. 400 mm, 100 mm .. 400 mm]", "x_max");
}

}  // namespace
}  // namespace thermotwin::twin
