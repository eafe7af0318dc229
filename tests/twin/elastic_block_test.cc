#include "twin/elastic_block.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/scenarios/refusal.h"
#include "thermal/block.h"
#include "thermal/material.h"
#include "twin/elastic_mesh.h"

namespace thermotwin::twin {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using thermotwin::tests::refusal;

thermal::Body column(Vector3d const& corner = {0.1, 0.2, 0.3}) {
  return thermal::make_body("column", {thermal::material("GJL-300"), corner, {0.4, 0.5, 1.0}, {3, 4, 5}, 0.5});
}

struct Resultant {
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
};

/// Of the forces on nodes for which `counts` holds, about a point of machine coordinates.
template <class Predicate>
Resultant resultant(ElasticBlock const& block, ElasticMesh const& mesh, Load const& load, Vector3d const& about,
                    Predicate counts) {
  Resultant sum;
  for (auto const& [node, force] : mesh.forces(block, load)) {
    Vector3d const x = mesh.nodes().at(node) + block.body.origin;
    if (!counts(x)) continue;
    sum.force += force;
    sum.moment += (x - about).cross(force);
  }
  return sum;
}

TEST(ElasticBlock, ForcesOnNodesAreTheLoadOnOneFaceAndItsReactionOnTheOther) {
  for (auto const* loaded : {"z_max", "z_max[30 mm .. 310 mm, 20 mm .. 410 mm]"}) {
    auto const block = elastic_block(column(), 0.26, "z_min", loaded);
    ElasticMesh const mesh(block.body);
    Load load;
    load << 3.0, -2.0, 5.0, 0.7, 0.2, -0.4;
    auto const top = resultant(block, mesh, load, centre_of(block.loaded), [](auto const& x) { return x[2] > 0.8; });
    EXPECT_LT((top.force - load.head<3>()).norm(), 1e-12) << loaded;
    EXPECT_LT((top.moment - load.tail<3>()).norm(), 1e-12) << loaded;
    auto const all = resultant(block, mesh, load, Vector3d::Zero(), [](auto const&) { return true; });
    EXPECT_LT(all.force.norm(), 1e-12) << loaded;
    EXPECT_LT(all.moment.norm(), 1e-11) << loaded;
  }
}

TEST(ElasticBlock, RectanglesCountFromTheCornerOfTheBlock) {
  auto const block = elastic_block(column(), 0.26, "z_min", "x_max[100 mm .. 200 mm, 600 mm .. 1 m]");
  EXPECT_LT((centre_of(block.loaded) - Vector3d(0.5, 0.35, 1.1)).norm(), 1e-12);
  EXPECT_LT((centre_of(block.fixed) - Vector3d(0.3, 0.45, 0.3)).norm(), 1e-12);
}

TEST(ElasticBlock, PointCarriedByTheFaceLoadsItWithForceAndLever) {
  auto const block = elastic_block(column(), 0.26, "z_min", "z_max");
  Vector3d const at = centre_of(block.loaded);
  Load expected;
  expected << 0.0, 0.0, 1.0, 0.2, -0.3, 0.0;
  EXPECT_LT((unit_load(block, Vector3d::UnitZ(), at + Vector3d(0.3, 0.2, 7.0), false) - expected).norm(), 1e-12);
  expected << 0.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  EXPECT_EQ(unit_load(block, Vector3d::UnitY(), at + Vector3d(0.3, 0.2, 7.0), true), expected);
}

TEST(ElasticBlock, KeyForgetsThePlaceAndTheMetalButNoShape) {
  auto const key = [](thermal::Body const& body, double poisson, char const* fixed, char const* loaded, int load) {
    return solution_key(elastic_block(body, poisson, fixed, loaded), load);
  };
  auto const own = key(column(), 0.26, "z_min", "z_max", 2);
  EXPECT_EQ(own, key(column({-0.7, 0.0, 1.1}), 0.26, "z_min", "z_max", 2));
  EXPECT_NE(own, key(column(), 0.27, "z_min", "z_max", 2));
  EXPECT_NE(own, key(column(), 0.26, "z_max", "z_min", 2));
  EXPECT_NE(own, key(column(), 0.26, "z_min", "z_max[0 mm .. 400 mm, 0 mm .. 499 mm]", 2));
  EXPECT_NE(own, key(column(), 0.26, "z_min", "z_max", 3));
  auto finer = thermal::make_body("column", {thermal::material("C45"), {0, 0, 0}, {0.4, 0.5, 1.0}, {3, 4, 6}, 1.0});
  EXPECT_NE(own, key(finer, 0.26, "z_min", "z_max", 2));
  auto steel = thermal::make_body("column", {thermal::material("C45"), {0, 0, 0}, {0.4, 0.5, 1.0}, {3, 4, 5}, 1.0});
  EXPECT_EQ(own, key(steel, 0.26, "z_min", "z_max", 2));
}

TEST(ElasticBlock, RejectionsSayWhat) {
  EXPECT_THAT(refusal([] { (void)elastic_block(column(), 0.5, "z_min", "z_max"); }), HasSubstr("Poisson"));
  EXPECT_THAT(refusal([] { (void)elastic_block(column(), 0.3, "z_min", "z_min"); }), HasSubstr("same place"));
  EXPECT_THAT(refusal([] { (void)elastic_block(column(), 0.3, "z_min", "z_mex"); }), HasSubstr("z_max"));
  EXPECT_THAT(
      refusal([] {
        auto const cube = thermal::make_body("cube", {thermal::material("C45"), {0, 0, 0}, {1, 1, 1}, {1, 1, 1}});
        (void)elastic_block(cube, 0.3, "z_min", "z_max");
      }),
      HasSubstr("single cell"));
}

}  // namespace
}  // namespace thermotwin::twin
