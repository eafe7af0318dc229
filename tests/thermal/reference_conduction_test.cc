#include <gtest/gtest.h>
#include <numbers>
#include <span>

#include "tests/thermal/axisymmetric_deck.h"
#include "tests/thermal/verification.h"
#include "thermal/bar.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/joint.h"
#include "thermal/laws.h"

// Code to code with CalculiX 2.20 (physics.md §9): the same bodies as CAX8 elements.

namespace thermotwin::thermal {
namespace {

using std::numbers::pi;
using Face = AxisymmetricDeck::Face;

/// A solid rod, one element across, n along; it stands on z = 0.
AxisymmetricDeck rod_deck(double radius, double length, int n) {
  AxisymmetricDeck deck({0.0, radius}, equal_edges(length, n));
  deck.fill(0, n, verification_steel());
  return deck;
}

TEST(ReferenceConduction, V1StepAtTheEndOfARod) {
  auto deck = rod_deck(0.01, 0.2, 20);
  deck.hold(Face::low, 10.0);
  int const middle = deck.node(0.0, 0.1);
  auto const calculix = deck.transient({middle}, 1.0, {300.0, 600.0});

  NetworkBuilder builder;
  int const part = builder.part("rod");
  Body const rod = make_body("rod", Bar{verification_steel(), {0, 0, 0}, {0, 0, 1}, 0.2, 0.02, 0.0, {}, 80});
  add_to(builder, part, rod);
  hold(builder, part, face(rod, "start"), builder.add_boundary({"hot", T0 + 10.0, {}}));
  auto const ours = run(builder.build(), FunctionCourse(), T0, {0.0, 300.0, 600.0}, tight());
  for (std::size_t k : {0u, 1u})
    EXPECT_NEAR(reading(point(rod, {0, 0, 0.1}), ours[k + 1]) - T0, calculix[k].at(middle),
                2e-3 * calculix[k].at(middle));
}

/// Fin of V2 as a round bar of equal perimeter to section: its tip, and (V5) how much it grows.
TEST(ReferenceConduction, V2AndV5FinAndItsGrowth) {
  double const radius = 5e-3, length = 0.2, h = 25.0;
  auto deck = rod_deck(radius, length, 40);
  deck.hold(Face::low, 20.0);
  deck.add_film(Face::outer, 0.0, length, h);
  deck.support();
  int const tip = deck.node(0.0, length);
  auto const calculix = deck.steady({tip});

  NetworkBuilder builder;
  int const part = builder.part("fin");
  Body const fin = make_body("fin", Bar{verification_steel(), {0, 0, 0}, {0, 0, 1}, length, 2 * radius, 0.0, {}, 100});
  add_to(builder, part, fin);
  hold(builder, part, face(fin, "start"), builder.add_boundary({"base", T0 + 20.0, {}}));
  add_film(builder, part, face(fin, "surface"), builder.add_boundary({"air", T0, {}}), h);
  auto const state = steady_state(builder.build(), {}, std::vector<double>(100, T0));
  EXPECT_NEAR(state.back() - T0, calculix.theta.at(tip), 2e-3 * calculix.theta.at(tip))
      << "the axis is warmer than the mean over the section";
  double growth = 0.0;
  for (double T : state) growth += verification_steel().expansion * (T - T0) * length / 100;
  EXPECT_NEAR(growth, calculix.growth.at(tip), 1e-3 * growth);
}

TEST(ReferenceConduction, V4SlabWithUniformSource) {
  double const length = 0.2, q = 1e5, h = 500.0;
  auto deck = rod_deck(0.01, length, 20);
  deck.add_source(q);
  deck.add_film(Face::low, 0.0, 1.0, h);
  deck.add_film(Face::high, 0.0, 1.0, h);
  int const middle = deck.node(0.0, 0.1), end = deck.node(0.0, 0.0);
  auto const calculix = deck.steady({middle, end});

  NetworkBuilder builder;
  int const part = builder.part("slab");
  Body const slab = make_body("slab", Bar{verification_steel(), {0, 0, 0}, {0, 0, 1}, length, 0.02, 0.0, {}, 101});
  add_to(builder, part, slab);
  Port const air = builder.add_boundary({"air", T0, {}});
  add_film(builder, part, face(slab, "start"), air, h);
  add_film(builder, part, face(slab, "end"), air, h);
  Site const all = whole(slab);
  for (auto const& c : all.contacts)
    builder.add<SwitchedHeat>(part, {port_of(builder, all, c)}, {q * pi * 1e-4 * length * c.share},
                              {builder.channel("on")});
  auto const state = steady_state(builder.build(), std::vector{1.0}, std::vector<double>(101, T0));
  EXPECT_NEAR(state[50] - T0, calculix.theta.at(middle), 1e-4 * 30.0);
  EXPECT_NEAR(calculix.theta.at(end), 20.0, 1e-3);
}

TEST(ReferenceConduction, V6TwoBarsAndAContact) {
  double const contact = 3000.0, layer = 1e-4;
  std::vector<double> heights = equal_edges(0.1, 10);
  for (double z : equal_edges(0.1, 10)) heights.push_back(0.1 + layer + z);
  AxisymmetricDeck deck({0.0, 0.01}, heights);
  Material thin = verification_steel();
  thin.conductivity = contact * layer;
  deck.fill(0, 21, verification_steel());
  deck.fill(10, 11, thin);
  deck.hold(Face::low, 20.0);
  deck.hold(Face::high, 0.0);
  int const before = deck.node(0.0, 0.1), after = deck.node(0.0, 0.1 + layer);
  auto const calculix = deck.steady({before, after});

  NetworkBuilder builder;
  int const part = builder.part("bars");
  Body const a = make_body("a", Bar{verification_steel(), {0, 0, 0}, {0, 0, 1}, 0.1, 0.02, 0.0, {}, 5});
  Body const b = make_body("b", Bar{verification_steel(), {0, 0, 0.1}, {0, 0, 1}, 0.1, 0.02, 0.0, {}, 5});
  add_to(builder, part, a);
  add_to(builder, part, b);
  hold(builder, part, face(a, "start"), builder.add_boundary({"hot", T0 + 20.0, {}}));
  hold(builder, part, face(b, "end"), builder.add_boundary({"cold", T0, {}}));
  connect_by_area(builder, part, face(a, "end"), face(b, "start"), contact);
  auto const state = steady_state(builder.build(), {}, std::vector<double>(10, T0));
  double const half_step = 0.5 * (state[3] - state[4]);
  EXPECT_NEAR(state[4] - half_step - T0, calculix.theta.at(before), 1e-4);
  EXPECT_NEAR(state[5] + half_step - T0, calculix.theta.at(after), 1e-4);
}

// --- a spindle cartridge with ring heat
// -------------------------------------------------------------------------------

class ReferenceCartridge : public testing::Test {
 protected:
  static constexpr double inner = 0.055, outer = 0.08, length = 0.4, watts = 50.0, h_outer = 15.0, h_end = 8.0;
  static constexpr double band_low = 0.04, band_high = 0.08;
  static inline double const band = 2 * pi * inner * (band_high - band_low);

  static AxisymmetricDeck deck() {
    std::vector<double> radii;
    for (double r : equal_edges(outer - inner, 3)) radii.push_back(inner + r);
    AxisymmetricDeck model(radii, equal_edges(length, 20));
    model.fill(0, 20, verification_steel());
    model.add_film(Face::outer, 0.0, length, h_outer);
    model.add_film(Face::low, 0.0, 1.0, h_end);
    model.add_film(Face::high, 0.0, 1.0, h_end);
    model.add_flux(Face::inner, band_low, band_high, watts / band);
    return model;
  }

  static Network network(Body const& body, std::string const& heated, std::string const& cooled) {
    NetworkBuilder builder;
    int const part = builder.part("cartridge");
    add_to(builder, part, body);
    Port const air = builder.add_boundary({"air", T0, {}});
    add_film(builder, part, face(body, cooled), air, h_outer);
    add_film(builder, part, face(body, "start"), air, h_end);
    add_film(builder, part, face(body, "end"), air, h_end);
    Site const ring = face(body, heated, band_low, band_high);
    for (auto const& c : ring.contacts)
      builder.add<SwitchedHeat>(part, {port_of(builder, ring, c)}, {watts * c.share}, {builder.channel("on")});
    return builder.build();
  }

  static Body fine() {
    return make_body("cartridge",
                     HollowCylinder{verification_steel(), {0, 0, 0}, {0, 0, 1}, length, 2 * outer, 2 * inner, 80, 8});
  }
  static Body slender() {
    return make_body("cartridge",
                     Bar{verification_steel(), {0, 0, 0}, {0, 0, 1}, length, 2 * outer, 2 * inner, {}, 40});
  }

  static FunctionCourse course() {
    return {{"on"}, [](double, std::span<double> u) { u[0] = 1.0; }};
  }
};

TEST_F(ReferenceCartridge, HollowCylinderAtRest) {
  auto const model = deck();
  std::vector<int> nodes;
  std::vector<double> const heights{0.0, 0.02, 0.06, 0.1, 0.2, 0.3, 0.4};
  for (double z : heights) nodes.push_back(model.node(outer, z));
  auto const calculix = model.steady(nodes).theta;
  Body const body = fine();
  auto const state =
      steady_state(network(body, "inner", "outer"), std::vector{1.0}, std::vector<double>(body.capacities.size(), T0));
  for (std::size_t k = 0; k < heights.size(); ++k) {
    double const theta = reading(ring(body, "outer", heights[k]), state) - T0;
    EXPECT_NEAR(theta, calculix.at(nodes[k]), 5e-3 * calculix.at(nodes[k])) << heights[k];
  }
}

TEST_F(ReferenceCartridge, HollowCylinderWarmingUp) {
  auto const model = deck();
  std::vector<int> const nodes{model.node(outer, 0.06), model.node(outer, 0.2), model.node(outer, 0.4)};
  std::vector<double> const heights{0.06, 0.2, 0.4}, times{0.0, 300.0, 1800.0, 7200.0};
  auto const calculix = model.transient(nodes, 10.0, {300.0, 1800.0, 7200.0});
  Body const body = fine();
  auto const ours = run(network(body, "inner", "outer"), course(), T0, times, tight(1e-7));
  for (std::size_t t = 1; t < times.size(); ++t)
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      double const theta = reading(ring(body, "outer", heights[k]), ours[t]) - T0;
      EXPECT_NEAR(theta, calculix[t - 1].at(nodes[k]), 5e-3 * theta + 0.01) << "t " << times[t] << " z " << heights[k];
    }
}

TEST_F(ReferenceCartridge, ASlenderBarIsWithinFivePercentInHeatAndGrowth) {
  auto model = deck();
  model.support();
  std::vector<int> nodes;
  std::vector<double> const heights{0.0, 0.06, 0.1, 0.2, 0.3, 0.4};
  for (double z : heights) nodes.push_back(model.node(0.5 * (inner + outer), z));
  auto const calculix = model.steady(nodes);
  Body const body = slender();
  auto const state = steady_state(network(body, "surface", "surface"), std::vector{1.0}, std::vector<double>(40, T0));
  for (std::size_t k = 0; k < heights.size(); ++k) {
    double const theta = reading(ring(body, "surface", heights[k]), state) - T0;
    EXPECT_NEAR(theta, calculix.theta.at(nodes[k]), 0.05 * theta) << heights[k];
  }
  double growth = 0.0;
  for (double T : state) growth += verification_steel().expansion * (T - T0) * length / 40;
  EXPECT_NEAR(growth, calculix.growth.at(nodes.back()), 0.05 * growth);
}

}  // namespace
}  // namespace thermotwin::thermal
