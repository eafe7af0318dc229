#include "thermal/body.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/scenarios/refusal.h"
#include "thermal/bar.h"
#include "thermal/block.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/lump.h"

namespace thermotwin::thermal {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using thermotwin::tests::refusal;

Material steel() { return {"steel", 50.0, 0.0, 7850.0, 470.0, 0.0, 11.5e-6, 210e9, 0.3, 0.25}; }

double total_capacity(Body const& body) {
  double sum = 0.0;
  for (double c : body.capacities) sum += c;
  return sum;
}

double total_area(Body const& body, std::string const& face) {
  double sum = 0.0;
  for (auto const& facet : body.face(face)) sum += facet.area;
  return sum;
}

HollowCylinder sleeve(int axial, int radial) {
  HollowCylinder c{steel(), {0.1, 0.2, 0.3}, {0.0, 0.0, -2.0}, 0.25, 0.16, 0.11, axial, radial};
  return c;
}

TEST(Body, CapacitiesAndFacesAreThoseOfTheSolidWhateverTheMesh) {
  for (int n : {1, 2, 7}) {
    Body const cylinder = make_body("sleeve", sleeve(n, n + 1));
    EXPECT_NEAR(total_capacity(cylinder), 7850.0 * 470.0 * pi / 4.0 * (0.16 * 0.16 - 0.11 * 0.11) * 0.25, 1e-9);
    EXPECT_NEAR(total_area(cylinder, "outer"), pi * 0.16 * 0.25, 1e-14);
    EXPECT_NEAR(total_area(cylinder, "inner"), pi * 0.11 * 0.25, 1e-14);
    EXPECT_NEAR(total_area(cylinder, "end"), pi / 4.0 * (0.16 * 0.16 - 0.11 * 0.11), 1e-14);
    Body const block = make_body("bed", Block{steel(), {1.0, 2.0, 3.0}, {0.2, 0.3, 0.5}, {n, n + 1, n + 2}, 0.4});
    EXPECT_NEAR(total_capacity(block), 0.4 * 7850.0 * 470.0 * 0.2 * 0.3 * 0.5, 1e-8);
    EXPECT_NEAR(total_area(block, "x_min"), 0.15, 1e-14);
    EXPECT_NEAR(total_area(block, "y_max"), 0.10, 1e-14);
    double volumes = 0.0;
    for (auto const& cell : block.cells) volumes += volume(cell);
    EXPECT_NEAR(volumes, 0.2 * 0.3 * 0.5, 1e-14);
  }
}

TEST(Body, BarUsesItsEffectiveSectionForHeatAndItsPerimeterForAir) {
  Bar screw{steel(), {0, 0, 0}, {1, 0, 0}, 0.8, 0.04, 0.0, 1.0e-3, 40};
  Body const body = make_body("screw", screw);
  EXPECT_NEAR(total_capacity(body), 7850.0 * 470.0 * 1.0e-3 * 0.8, 1e-9);
  EXPECT_NEAR(body.links[0].conductance, 50.0 * 1.0e-3 / 0.02, 1e-12);
  EXPECT_NEAR(total_area(body, "surface"), pi * 0.04 * 0.8, 1e-14);
  EXPECT_NEAR(body.face("end")[0].area, 1.0e-3, 1e-18);
  EXPECT_EQ(body.face("end")[0].cell, 39);
}

TEST(Body, SteadyRadialFlowIsExactForAnyNumberOfRings) {
  for (int n : {1, 2, 5}) {
    Body const body = make_body("sleeve", sleeve(1, n));
    auto const& inner = body.face("inner")[0];
    auto const& outer = body.face("outer")[0];
    double resistance = inner.half_resistance / inner.area + outer.half_resistance / outer.area;
    for (auto const& link : body.links) resistance += 1.0 / link.conductance;
    EXPECT_NEAR(resistance, std::log(0.16 / 0.11) / (2.0 * pi * 50.0 * 0.25), 1e-15);
  }
}

TEST(Body, NodeOfARingCarriesTheMeanOfALogarithmicProfile) {
  double const a = 0.02, b = 0.05;
  int const n = 20000;
  double mean = 0.0;
  for (int i = 0; i < n; ++i) {
    double const r = a + (b - a) * (i + 0.5) / n;
    mean += std::log(r) * 2.0 * r * (b - a) / n / (b * b - a * a);
  }
  EXPECT_NEAR(std::log(mean_radius(a, b)), mean, 1e-9);
  EXPECT_NEAR(mean_radius(0.0, b), b * std::exp(-0.5), 1e-15);
  EXPECT_NEAR(mean_radius(0.0499999, 0.05), 0.04999995, 1e-9);
}

TEST(Body, SlopesOfTheMaterialReachTheNetwork) {
  Material bearing = steel();
  bearing.conductivity_slope = -5e-4;
  bearing.specific_heat_slope = 1e-3;
  NetworkBuilder builder;
  int const part = builder.part("bar");
  Body const body = make_body("bar", Bar{bearing, {0, 0, 0}, {1, 0, 0}, 0.1, 0.02, 0.0, {}, 3});
  Port const first = add_to(builder, part, body);
  Port const room = builder.add_boundary({"room", 293.15, {}});
  builder.connect(part, first, room, 1.0);
  Network const network = builder.build();
  EXPECT_EQ(network.capacity_slope()[2], 1e-3);
  EXPECT_EQ(network.groups()[0].law->name(), "temperature-dependent conductance");
  EXPECT_EQ(network.groups()[0].coefficients[1], -5e-4);
}

TEST(Body, LumpTakesCapacityOrMassOrDrawnVolume) {
  Lump lump{steel(), {}, {}, 0.0, {0, 0, 0}, {0.1, 0.1, 0.1}};
  EXPECT_NEAR(make_body("head", lump).capacities[0], 7.85 * 470.0, 1e-9);
  lump.mass = 10.0;
  EXPECT_NEAR(make_body("head", lump).capacities[0], 4700.0, 1e-9);
  lump.capacity = 123.0;
  EXPECT_NEAR(make_body("head", lump).capacities[0], 123.0, 1e-9);
}

TEST(Body, RejectionsNameTheBodyAndTheValue) {
  EXPECT_THAT(refusal([] {
                (void)make_body("shaft", Bar{steel(), {0, 0, 0}, {0, 0, 1}, -0.1, 0.1, 0.0, {}, 3});
              }),
              testing::AllOf(HasSubstr("'shaft'"), HasSubstr("length"), HasSubstr("-0.1")));
  EXPECT_THAT(refusal([] {
                auto c = sleeve(1, 1);
                c.inner_diameter = 0.2;
                (void)make_body("sleeve", c);
              }),
              testing::AllOf(HasSubstr("'sleeve'"), HasSubstr("0.2"), HasSubstr("0.16")));
  EXPECT_THAT(refusal([] {
                (void)make_body("bed", Block{steel(), {0, 0, 0}, {1, 1, 1}, {1, 1, 1}, 1.5});
              }),
              testing::AllOf(HasSubstr("'bed'"), HasSubstr("1.5")));
  EXPECT_THAT(refusal([] {
                (void)make_body("bed", Block{steel(), {0, 0, 0}, {1, 1, 1}, {1, 0, 1}});
              }),
              testing::AllOf(HasSubstr("cells along y"), HasSubstr("0")));
  EXPECT_THAT(refusal([] { (void)make_body("sleeve", sleeve(1, 1)).face("outter"); }),
              testing::AllOf(HasSubstr("'sleeve'"), HasSubstr("'outter'"), HasSubstr("'outer'")));
}

}  // namespace
}  // namespace thermotwin::thermal
