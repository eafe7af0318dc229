#include "thermal/joint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/scenarios/refusal.h"
#include "thermal/bar.h"
#include "thermal/block.h"
#include "thermal/error.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/lump.h"
#include "thermal/overlap.h"

namespace thermotwin::thermal {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using thermotwin::tests::refusal;

Material steel() { return {"steel", 50.0, 0.0, 7850.0, 470.0, 0.0, 11.5e-6, 210e9, 0.3, 0.25}; }

double sum(std::vector<Pair> const& pairs, double Pair::*what) {
  double s = 0.0;
  for (auto const& p : pairs) s += p.*what;
  return s;
}

TEST(Joint, DiscInRectangleAgainstCountingAndLimits) {
  double const r = 0.7;
  EXPECT_NEAR(disc_in_rectangle(r, -1, 1, -1, 1), pi * r * r, 1e-14);
  EXPECT_NEAR(disc_in_rectangle(r, 0, 1, 0, 1), pi * r * r / 4, 1e-14);
  EXPECT_NEAR(disc_in_rectangle(r, 0.71, 1, -1, 1), 0.0, 1e-14);
  EXPECT_NEAR(disc_in_rectangle(r, -0.3, 0.3, -0.3, 0.3), 0.36, 1e-14);
  double const x0 = -0.2, x1 = 0.65, y0 = 0.1, y1 = 0.6;
  int const n = 1000;
  double area = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      double const x = x0 + (x1 - x0) * (i + 0.5) / n, y = y0 + (y1 - y0) * (j + 0.5) / n;
      if (x * x + y * y < r * r) area += (x1 - x0) * (y1 - y0) / n / n;
    }
  EXPECT_NEAR(disc_in_rectangle(r, x0, x1, y0, y1), area, 1e-5);
}

TEST(Joint, PlaneFacesMeetInTheOverlapOfTheirRectangles) {
  Body const low = make_body("bed", Block{steel(), {0, 0, 0}, {0.4, 0.4, 0.1}, {4, 4, 2}});
  Body const high = make_body("column", Block{steel(), {0.15, 0.2, 0.1}, {0.6, 0.1, 0.3}, {3, 1, 3}});
  auto const pairs = pair(face(low, "z_max"), face(high, "z_min"));
  EXPECT_NEAR(sum(pairs, &Pair::area), 0.25 * 0.1, 1e-14);
  EXPECT_NEAR(sum(pairs, &Pair::share), 1.0, 1e-14);
  EXPECT_EQ(pairs.size(), 4u);  // x: 0.15-0.2, 0.2-0.3, 0.3-0.35, 0.35-0.4
  EXPECT_EQ(pairs[0].a, low.cell(1, 2, 1));
  EXPECT_NEAR(pairs[0].area, 0.05 * 0.1, 1e-14);
  EXPECT_NEAR(pairs[0].resistance, (0.025 / 50 + 0.05 / 50) / (0.05 * 0.1), 1e-12);
}

TEST(Joint, FacesInDifferentPlanesOrBesideEachOtherDoNotTouch) {
  Body const low = make_body("bed", Block{steel(), {0, 0, 0}, {0.4, 0.4, 0.1}, {2, 2, 2}});
  Body const above = make_body("column", Block{steel(), {0, 0, 0.11}, {0.4, 0.4, 0.1}, {2, 2, 2}});
  Body const beside = make_body("table", Block{steel(), {0.5, 0, 0.1}, {0.4, 0.4, 0.1}, {2, 2, 2}});
  auto const message = [](Site const& a, Site const& b) { return refusal([&] { (void)pair(a, b); }); };
  EXPECT_THAT(message(face(low, "z_max"), face(above, "z_min")),
              testing::AllOf(HasSubstr("'bed'"), HasSubstr("'column'"), HasSubstr("0.01 m apart")));
  EXPECT_THAT(message(face(low, "z_max"), face(beside, "z_min")),
              testing::AllOf(HasSubstr("'bed'"), HasSubstr("'table'"), HasSubstr("do not touch")));
  EXPECT_THAT(message(face(low, "z_max"), face(beside, "x_min")), HasSubstr("do not touch"));
  EXPECT_THAT(message(whole(low), whole(above)), HasSubstr("say which faces"));
}

TEST(Joint, CoaxialMantlesMeetInTheOverlapOfTheirIntervals) {
  Body const shaft = make_body("shaft", Bar{steel(), {0, 0, 0}, {0, 0, 1}, 0.6, 0.1, 0.0, {}, 6});
  // Opposite sense, from z = 0.75 down to z = 0.25.
  Body const sleeve = make_body("sleeve", HollowCylinder{steel(), {0, 0, 0.75}, {0, 0, -1}, 0.5, 0.2, 0.1, 4, 2});
  auto const pairs = pair(face(shaft, "surface"), face(sleeve, "inner"));
  EXPECT_NEAR(sum(pairs, &Pair::share), 1.0, 1e-14);
  EXPECT_NEAR(sum(pairs, &Pair::area), pi * 0.1 * 0.35, 1e-14);
  for (auto const& p : pairs) {
    auto const& a = std::get<RingCell>(shaft.cells[std::size_t(p.a)]);
    auto const& b = std::get<RingCell>(sleeve.cells[std::size_t(p.b)]);
    double const shared = overlap(a.origin[2], a.origin[2] + a.height, b.origin[2] - b.height, b.origin[2]);
    EXPECT_NEAR(p.share, shared / 0.35, 1e-13);
  }
  Body const aside = make_body("quill", Bar{steel(), {0, 0.01, 0}, {0, 0, 1}, 0.6, 0.1, 0.0, {}, 6});
  EXPECT_THROW((void)pair(face(aside, "surface"), face(sleeve, "inner")), InputError);
}

TEST(Joint, MantleInABlockMeetsTheCellsOfItsLayer) {
  Body const screw = make_body("screw", Bar{steel(), {0.05, 0.1, 0.1}, {1, 0, 0}, 0.5, 0.04, 0.0, {}, 5});
  Body const bed = make_body("bed", Block{steel(), {0, 0, 0}, {0.4, 0.2, 0.2}, {2, 2, 2}});
  auto const pairs = pair(whole(bed), face(screw, "surface"));
  EXPECT_NEAR(sum(pairs, &Pair::share), 1.0, 1e-14);
  EXPECT_NEAR(sum(pairs, &Pair::area), pi * 0.04 * 0.35, 1e-14);
  double first_layer = 0.0;
  for (auto const& p : pairs)
    if (p.a % 2 == 0) first_layer += p.share;
  EXPECT_NEAR(first_layer, 0.15 / 0.35, 1e-13);
}

TEST(Joint, EndOfACylinderMeetsAPlaneInRingsAndRectangles) {
  Body const bed = make_body("bed", Block{steel(), {0, 0, 0}, {0.4, 0.4, 0.1}, {5, 5, 2}});
  Body const post = make_body("post", HollowCylinder{steel(), {0.2, 0.19, 0.1}, {0, 0, 1}, 0.3, 0.2, 0.05, 3, 3});
  auto const pairs = pair(face(post, "start"), face(bed, "z_max"));
  EXPECT_NEAR(sum(pairs, &Pair::area), pi / 4 * (0.2 * 0.2 - 0.05 * 0.05), 1e-12);
  EXPECT_NEAR(sum(pairs, &Pair::share), 1.0, 1e-14);
  auto const mirrored = pair(face(bed, "z_max"), face(post, "start"));
  EXPECT_EQ(mirrored.size(), pairs.size());
  EXPECT_EQ(mirrored[0].a, pairs[0].b);
  Body const flange = make_body("flange", HollowCylinder{steel(), {0.2, 0.19, 0.4}, {0, 0, 1}, 0.02, 0.3, 0.15, 1, 2});
  EXPECT_NEAR(sum(pair(face(post, "end"), face(flange, "start")), &Pair::area), pi / 4 * (0.2 * 0.2 - 0.15 * 0.15),
              1e-14);
}

/// Two bars end to end: the chain of conductances is the series of the bars and the joint (V6 as a resistance).
TEST(Joint, ResistancesOfHalfCellsAndContactAddUp) {
  Body const a = make_body("a", Bar{steel(), {0, 0, 0}, {1, 0, 0}, 0.1, 0.02, 0.0, {}, 4});
  Body const b = make_body("b", Bar{steel(), {0.1, 0, 0}, {1, 0, 0}, 0.1, 0.02, 0.0, {}, 7});
  double const area = pi / 4 * 0.02 * 0.02;
  auto const coefficient = [&](auto join) {
    NetworkBuilder builder;
    int const part = builder.part("joint");
    Port const first = add_to(builder, part, a);
    add_to(builder, part, b);
    builder.connect(part, first, builder.add_boundary({"room", 293.15, {}}), 1.0);
    join(builder, part);
    Network const network = builder.build();
    for (auto const& group : network.groups())
      for (int e = 0; e < group.count(); ++e)
        if (group.ports[std::size_t(2 * e)] == 3 && group.ports[std::size_t(2 * e + 1)] == 4)
          return group.coefficients[std::size_t(e)];
    return 0.0;
  };
  double const halves = (0.0125 + 0.1 / 14) / (50.0 * area);
  EXPECT_NEAR(1 / coefficient([&](auto& n, int part) { connect(n, part, face(a, "end"), face(b, "start"), 2.0); }),
              halves + 0.5, 1e-12);
  EXPECT_NEAR(
      1 / coefficient([&](auto& n, int part) { connect_by_area(n, part, face(a, "end"), face(b, "start"), 3000.0); }),
      halves + 1 / (3000.0 * area), 1e-12);
  EXPECT_NEAR(1 / coefficient([&](auto& n, int part) { weld(n, part, face(a, "end"), face(b, "start")); }), halves,
              1e-12);
}

TEST(Joint, WithoutAnAreaACoefficientIsRefused) {
  NetworkBuilder builder;
  Body const head = make_body("head", Lump{steel(), 100.0, {}}), arm = make_body("arm", Lump{steel(), 100.0, {}});
  int const part = builder.part("joint");
  add_to(builder, part, head);
  add_to(builder, part, arm);
  EXPECT_THROW(connect_by_area(builder, part, face(head, "surface"), face(arm, "surface"), 1000.0), InputError);
  EXPECT_THROW(weld(builder, part, face(head, "surface"), face(arm, "surface")), InputError);
  EXPECT_THROW(connect(builder, part, face(head, "surface"), face(arm, "surface"), -1.0), InputError);
  EXPECT_NO_THROW(connect(builder, part, face(head, "surface"), face(arm, "surface"), 1.0));
}

}  // namespace
}  // namespace thermotwin::thermal
