#include "thermal/growth_field.h"

#include <gtest/gtest.h>

#include "thermal/bar.h"
#include "thermal/block.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/lump.h"

namespace thermotwin::thermal {
namespace {

using Eigen::Vector3d;

constexpr double alpha = 11.5e-6;

Body block(Vector3d const& corner, Vector3d const& size, std::array<int, 3> cells) {
  return make_body("block", Block{material("C45"), corner, size, cells, 1.0});
}

GrowingBody held(Body const& body, int first_node, int carrier, Vector3d const& place) {
  auto growing = growing_body(body, first_node, alpha);
  growing.carrier = carrier;
  growing.held_at = place;
  return growing;
}

/// θ at the centres of the cells of bodies whose nodes follow one another.
template <class Field>
std::vector<double> rise_of(std::vector<Body> const& bodies, Field field) {
  std::vector<double> rise;
  for (auto const& body : bodies)
    for (auto const& cell : body.cells) rise.push_back(field(centre(cell)));
  return rise;
}

double largest_error(std::vector<Body> const& bodies, Eigen::Matrix3Xd const& field, auto expected) {
  double error = 0.0;
  Eigen::Index node = 0;
  for (auto const& body : bodies)
    for (auto const& cell : body.cells) error = std::max(error, (field.col(node++) - expected(centre(cell))).norm());
  return error;
}

/// A bed, a column that stands on it, a head on the column, a spindle in the head, a tool at its end.
struct Chain {
  std::vector<Body> bodies = {
      block({-0.4, -0.4, -0.5}, {0.8, 1.3, 0.3}, {4, 5, 3}), block({-0.2, 0.4, -0.2}, {0.4, 0.4, 1.2}, {4, 4, 6}),
      block({-0.1, -0.1, 0.4}, {0.2, 0.5, 0.3}, {2, 5, 3}),
      make_body("spindle", HollowCylinder{material("C45"), {0, 0, 0.35}, {0, 0, 1}, 0.4, 0.1, 0.02, 8, 3}),
      make_body("tool", Bar{material("C45"), {0, 0, 0.35}, {0, 0, -1}, 0.1, 0.02, 0.0, {}, 5})};
  std::vector<GrowingBody> growing;

  Chain() {
    int node = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      growing.push_back(growing_body(bodies[i], node, alpha));
      growing[i].carrier = int(i) - 1;
      growing[i].held_at = i == 0 ? lower_face(bodies[0], Vector3d::UnitZ()) : contact_centre(bodies[i], bodies[i - 1]);
      node += bodies[i].nodes();
    }
  }
};

TEST(GrowthField, MachineAtOneTemperatureGrowsFromWhereItStands) {
  Chain const chain;
  Vector3d const stand = chain.growing[0].held_at;
  EXPECT_TRUE(stand.isApprox(Vector3d(0.0, 0.25, -0.5)));
  auto const field = growth_field(chain.growing, rise_of(chain.bodies, [](auto const&) { return 7.0; }));
  EXPECT_LT(largest_error(chain.bodies, field, [&](Vector3d const& x) { return Vector3d(alpha * 7.0 * (x - stand)); }),
            1e-17);
}

TEST(GrowthField, GradientBendsACantileverByClosedForm) {
  double const length = 0.5, height = 0.05, gradient = 10.0 / height;
  Body const beam = block({0, 0, 0}, {length, height, height}, {50, 5, 5});
  auto const rise = rise_of({beam}, [&](Vector3d const& x) { return gradient * (x.z() - 0.5 * height); });
  auto const field = growth_field({held(beam, 0, -1, {0.0, 0.5 * height, 0.5 * height})}, rise);
  int const tip = beam.cell(49, 2, 2);
  double const reach = centre(beam.cells[std::size_t(tip)]).x();
  EXPECT_NEAR(field(2, tip), -alpha * 10.0 * reach * reach / (2.0 * height), 1e-12);
  EXPECT_NEAR(field(2, tip) * (length * length) / (reach * reach), -287.5e-6, 1e-9);
  EXPECT_NEAR(field(0, tip), 0.0, 1e-15);
}

/// u = α ((θ_h + g·r) r − ½ g |r|²), r = x − h: no stress, no rotation at h.
TEST(GrowthField, LinearTemperatureInABlockIsExactInAllDirections) {
  Vector3d const g(12.0, -30.0, 25.0), h(0.13, 0.0, 0.31);
  Body const body = block({-0.1, -0.2, 0.1}, {0.4, 0.5, 0.6}, {4, 7, 5});
  auto const rise = rise_of({body}, [&](Vector3d const& x) { return 3.0 + g.dot(x); });
  auto const field = growth_field({held(body, 0, -1, h)}, rise);
  EXPECT_LT(largest_error({body}, field,
                          [&](Vector3d const& x) {
                            Vector3d const r = x - h;
                            return Vector3d(alpha * ((3.0 + g.dot(h) + g.dot(r)) * r - 0.5 * g * r.squaredNorm()));
                          }),
            1e-17);
}

TEST(GrowthField, WhatABlockCarriesTurnsWithThePlaceThatHoldsIt) {
  double const height = 0.2, length = 1.0, bend = alpha * 4.0 / height;
  Body const column = block({0, 0, 0}, {0.2, height, length}, {2, 4, 20});
  Body const arm = make_body("arm", Lump{material("C45"), 1.0, {}, 0.0, {0.05, -0.9, 0.9}, {0.1, 0.9, 0.1}});
  Vector3d const seat(0.1, 0.0, 0.95);
  auto rise = rise_of({column}, [&](Vector3d const& x) { return 4.0 / height * (x.y() - 0.5 * height); });
  rise.push_back(0.0);
  auto const field =
      growth_field({held(column, 0, -1, {0.1, 0.5 * height, 0.0}), held(arm, column.nodes(), 0, seat)}, rise);
  // The column is warm behind, so it leans forward; its front is the shorter side, and the arm's end dips.
  double const angle = bend * seat.z(), reach = 0.45;
  EXPECT_NEAR(field(2, column.nodes()), -angle * (reach + 0.5 * height), 1e-12);
  EXPECT_NEAR(field(1, column.nodes()), -0.5 * bend * seat.z() * seat.z() + 0.5 * bend * 0.01, 1e-9);
}

TEST(GrowthField, CylinderGrowsByTheMeanOfItsSections) {
  Body const shaft = make_body("shaft", HollowCylinder{material("C45"), {0, 0, 0}, {1, 0, 0}, 0.4, 0.1, 0.05, 40, 2});
  double const inside = shaft.capacities[0] / (shaft.capacities[0] + shaft.capacities[1]);
  std::vector<double> rise;
  for (int i = 0; i < shaft.nodes(); ++i) rise.push_back(i % 2 == 0 ? 10.0 : 0.0);
  auto const field = growth_field({held(shaft, 0, -1, {0.1, 0, 0})}, rise);
  EXPECT_NEAR(field(0, shaft.cell(39, 0)), alpha * 10.0 * inside * 0.295, 1e-15);
  EXPECT_NEAR(field(0, shaft.cell(39, 1)), alpha * 10.0 * inside * 0.295, 1e-15);
}

TEST(GrowthField, LowerFaceIsTheOneAgainstUp) {
  Body const lathe = block({-1.0, -0.3, -0.6}, {0.7, 0.6, 1.4}, {1, 1, 1});
  EXPECT_TRUE(lower_face(lathe, Vector3d::UnitX()).isApprox(Vector3d(-1.0, 0.0, 0.1), 1e-12));
}

TEST(GrowthField, ContactIsTheMiddleOfWhatBoxesShareOrTheNearSideOfAGap) {
  Body const bed = block({0, 0, 0}, {1, 1, 0.2}, {1, 1, 1});
  EXPECT_TRUE(contact_centre(block({0.5, 0.8, 0.2}, {1, 0.2, 1}, {1, 1, 1}), bed).isApprox(Vector3d(0.75, 0.9, 0.2)));
  EXPECT_TRUE(contact_centre(block({2.0, 0.8, 0.2}, {1, 0.2, 1}, {1, 1, 1}), bed).isApprox(Vector3d(2.0, 0.9, 0.2)));
  EXPECT_TRUE(contact_centre(block({-2.0, 0, 0}, {1, 1, 0.1}, {1, 1, 1}), bed).isApprox(Vector3d(-1.0, 0.5, 0.05)));
}

}  // namespace
}  // namespace thermotwin::thermal
