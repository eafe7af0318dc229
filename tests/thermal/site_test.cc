#include "thermal/site.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/scenarios/refusal.h"
#include "thermal/bar.h"
#include "thermal/block.h"
#include "thermal/error.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/lump.h"

namespace thermotwin::thermal {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using thermotwin::tests::refusal;

Material steel() { return {"steel", 50.0, 0.0, 7850.0, 470.0, 0.0, 11.5e-6, 210e9, 0.3, 0.25}; }

Body bar(int cells = 8) { return make_body("bar", Bar{steel(), {0, 0, 1}, {0, 0, 1}, 0.8, 0.04, 0.0, {}, cells}); }
Body bed() { return make_body("bed", Block{steel(), {1, 2, 3}, {0.4, 0.6, 0.2}, {4, 3, 2}}); }
Body sleeve() { return make_body("sleeve", HollowCylinder{steel(), {0, 0, 0}, {1, 0, 0}, 0.5, 0.2, 0.1, 5, 4}); }

double sum_of_shares(Site const& site) {
  double sum = 0.0;
  for (auto const& c : site.contacts) sum += c.share;
  return sum;
}

/// What a site reads in a field that is linear in the coordinates of the nodes.
template <class Field>
double reading(Site const& site, Body const& body, Field field) {
  double sum = 0.0;
  for (auto const& c : site.contacts) sum += c.share * field(centre(body.cells[std::size_t(c.node)]));
  return sum;
}

TEST(Site, WholeBodyWeighsByVolume) {
  Site const site = whole(sleeve());
  EXPECT_NEAR(sum_of_shares(site), 1.0, 1e-14);
  EXPECT_NEAR(site.contacts[3].share / site.contacts[0].share,
              (0.1 * 0.1 - 0.0875 * 0.0875) / (0.0625 * 0.0625 - 0.05 * 0.05), 1e-12);
  EXPECT_EQ(site.area(), 0.0);
}

TEST(Site, IntervalOfABarCountsCutCellsByTheirLength) {
  Site const site = face(bar(), "surface", 0.15, 0.32);  // cells of 0.1 m
  ASSERT_EQ(site.contacts.size(), 3u);
  EXPECT_EQ(site.contacts[0].node, 1);
  EXPECT_NEAR(site.contacts[0].share, 0.05 / 0.17, 1e-14);
  EXPECT_NEAR(site.contacts[1].share, 0.10 / 0.17, 1e-14);
  EXPECT_NEAR(site.contacts[2].share, 0.02 / 0.17, 1e-14);
  EXPECT_NEAR(site.area(), pi * 0.04 * 0.17, 1e-15);
  EXPECT_NEAR(site.contacts[2].centre[2], 1.31, 1e-14);
}

TEST(Site, RectangleOfABlockFaceCountsCutCellsByTheirArea) {
  Eigen::AlignedBox3d const box(Eigen::Vector3d(1.05, 2.1, -9.0), Eigen::Vector3d(1.25, 2.3, 9.0));
  Site const site = face(bed(), "z_max", box);
  EXPECT_NEAR(site.area(), 0.2 * 0.2, 1e-15);
  EXPECT_NEAR(sum_of_shares(site), 1.0, 1e-14);
  ASSERT_EQ(site.contacts.size(), 6u);
  EXPECT_NEAR(site.contacts[0].area, 0.05 * 0.1, 1e-15);
  EXPECT_NEAR(site.contacts[0].centre[2], 3.2, 1e-15);
  EXPECT_NEAR(site.contacts[0].half_resistance, 0.05 / 50.0, 1e-15);
}

TEST(Site, RegionOfABlockCountsCutCellsByTheirVolume) {
  Eigen::AlignedBox3d const box(Eigen::Vector3d(1.0, 2.0, 3.0), Eigen::Vector3d(1.15, 2.2, 3.15));
  Site const site = region(bed(), box);
  ASSERT_EQ(site.contacts.size(), 4u);
  EXPECT_NEAR(site.contacts[0].share, 0.1 * 0.1 / (0.15 * 0.15), 1e-13);
  EXPECT_NEAR(site.contacts[3].share, 0.05 * 0.05 / (0.15 * 0.15), 1e-13);
  EXPECT_EQ(site.area(), 0.0);
}

TEST(Site, PointReadsALinearFieldExactlyBetweenTheNodes) {
  Body const body = bed();
  auto const field = [](Eigen::Vector3d const& p) { return 3.0 * p[0] - 2.0 * p[1] + 0.5 * p[2] + 1.0; };
  for (Eigen::Vector3d const& p : {Eigen::Vector3d(1.13, 2.31, 3.11), Eigen::Vector3d(1.3, 2.4, 3.06)})
    EXPECT_NEAR(reading(point(body, p), body, field), field(p), 1e-12);
  Body const rod = bar();
  auto const along = [](Eigen::Vector3d const& p) { return 7.0 * p[2]; };
  EXPECT_NEAR(reading(point(rod, {0.0, 0.01, 1.337}), rod, along), 7.0 * 1.337, 1e-12);
}

TEST(Site, PointMovesWithoutAStepAndKeepsWeightsBetween0And1) {
  Body const body = bed();
  auto const field = [](Eigen::Vector3d const& p) { return std::sin(9.0 * p[0]); };
  double before = reading(point(body, {1.0, 2.3, 3.1}), body, field);
  for (double x = 1.0; x <= 1.4; x += 1e-4) {
    Site const site = point(body, {x, 2.3, 3.1});
    double const now = reading(site, body, field);
    EXPECT_LT(std::abs(now - before), 2e-3);
    for (auto const& c : site.contacts) EXPECT_GE(c.share, 0.0);
    EXPECT_NEAR(sum_of_shares(site), 1.0, 1e-14);
    before = now;
  }
}

TEST(Site, PointOutsideIsAnErrorAndALumpHasNoOutside) {
  EXPECT_THROW((void)point(bed(), {0.9, 2.3, 3.1}), InputError);
  EXPECT_THROW((void)point(bar(), {0.0, 0.0, 0.9}), InputError);
  EXPECT_THROW((void)point(bar(), {0.03, 0.0, 1.2}), InputError);
  EXPECT_THROW((void)point(sleeve(), {0.2, 0.02, 0.0}), InputError);
  EXPECT_EQ(point(make_body("head", Lump{steel(), 1.0, {}}), {9, 9, 9}).contacts[0].share, 1.0);
}

TEST(Site, RingInterpolatesAlongTheAxisInItsOwnLayer) {
  Body const body = sleeve();
  Site const site = ring(body, "outer", 0.22);  // between the nodes at 0.15 and 0.25
  ASSERT_EQ(site.contacts.size(), 2u);
  EXPECT_EQ(site.contacts[0].node, body.cell(1, 3));
  EXPECT_NEAR(site.contacts[0].share, 0.3, 1e-13);
  EXPECT_NEAR(site.contacts[1].share, 0.7, 1e-13);
  EXPECT_EQ(ring(body, "inner", 0.0).contacts.size(), 1u);
  EXPECT_THROW((void)ring(body, "outer", 0.6), InputError);
}

TEST(Site, AreaCanBeGiven) {
  EXPECT_NEAR(with_area(face(make_body("head", Lump{steel(), 1.0, {}}), "surface"), 0.5).contacts[0].area, 0.5, 0.0);
  EXPECT_NEAR(with_area(face(bar(), "surface"), 2.0).area(), 2.0, 1e-14);
}

TEST(Site, RejectionsNameBodyAndPlace) {
  EXPECT_THAT(refusal([] { (void)face(bar(), "surface", 0.9, 1.0); }),
              testing::AllOf(HasSubstr("'bar'"), HasSubstr("'surface' from 0.9 to 1 m")));
  EXPECT_THAT(refusal([] { (void)face(bed(), "x_min", 0.0, 0.1); }), HasSubstr("'bed' is no bar or cylinder"));
  EXPECT_THAT(refusal([] { (void)region(bar(), {}); }), HasSubstr("'bar' is no block"));
  EXPECT_THAT(refusal([] { (void)face(sleeve(), "end", 0.0, 0.1); }), HasSubstr("'end'"));
}

TEST(Site, PortOfManyNodesIsTheirAverage) {
  NetworkBuilder builder;
  Body const body = bar();
  add_to(builder, builder.part("bar"), body);
  EXPECT_EQ(port_of(builder, point(body, {0, 0, 1.05})).kind, Port::Kind::node);
  EXPECT_EQ(port_of(builder, whole(body)).kind, Port::Kind::average);
}

}  // namespace
}  // namespace thermotwin::thermal
