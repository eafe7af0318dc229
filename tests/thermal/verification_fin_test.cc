#include <gtest/gtest.h>
#include <numbers>

#include "tests/thermal/verification.h"
#include "thermal/bar.h"
#include "thermal/joint.h"

namespace thermotwin::thermal {
namespace {

// --- V2, V2b: fin of 10 mm × 10 mm × 200 mm, base held
// ----------------------------------------------------------------

constexpr double h = 25.0, length = 0.2, base = 20.0, area = 1e-4, perimeter = 0.04, k = 50.0;
double const m = std::sqrt(h * perimeter / (k * area));

struct Fin {
  double tip, heat;
};

Fin fin(int cells, bool convecting_tip) {
  NetworkBuilder builder;
  int const part = builder.part("fin");
  Body const body = make_body(
      "fin", Bar{verification_steel(), {0, 0, 0}, {1, 0, 0}, length, perimeter / std::numbers::pi, 0.0, area, cells});
  add_to(builder, part, body);
  Port const air = builder.add_boundary({"air", T0, {}});
  hold(builder, part, face(body, "start"), builder.add_boundary({"base", T0 + base, {}}));
  add_film(builder, part, face(body, "surface"), air, h);
  if (convecting_tip) add_film(builder, part, face(body, "end"), air, h);
  auto const state = steady_state(builder.build(), {}, std::vector<double>(std::size_t(cells), T0));
  double const half = face(body, "start").contacts[0].half_resistance;
  double const last = state.back() - T0;
  return {convecting_tip ? last / (1.0 + h * half) : last, area / half * (base - (state[0] - T0))};
}

TEST(VerificationV2, FinWithAdiabaticTip) {
  double const tip = base / std::cosh(m * length), heat = k * area * m * base * std::tanh(m * length);
  EXPECT_NEAR(m, 14.1421, 1e-4);
  EXPECT_NEAR(tip, 2.35600, 5e-6);
  EXPECT_NEAR(fin(100, false).tip, tip, 1e-3);
  EXPECT_NEAR(fin(100, false).heat, heat, 2e-4 * heat);
  for (int cells : {20, 40, 80}) {
    EXPECT_NEAR(order(fin(cells, false).tip - tip, fin(2 * cells, false).tip - tip), 2.0, 0.05);
    EXPECT_NEAR(order(fin(cells, false).heat - heat, fin(2 * cells, false).heat - heat), 2.0, 0.05);
  }
}

TEST(VerificationV2b, FinWithConvectingTip) {
  double const bi = h / (m * k), ml = m * length;
  double const tip = base / (std::cosh(ml) + bi * std::sinh(ml));
  EXPECT_NEAR(fin(100, true).tip, tip, 1e-3);
  for (int cells : {20, 40}) EXPECT_NEAR(order(fin(cells, true).tip - tip, fin(2 * cells, true).tip - tip), 2.0, 0.05);
}

// --- V6: two bars with a contact between them
// -------------------------------------------------------------------------

TEST(VerificationV6, TwoBarsAndAContactAreExactOnAnyMesh) {
  double const contact = 3000.0, bar_length = 0.1, end = 20.0;
  double const flux = end / (2 * bar_length / k + 1 / contact);
  EXPECT_NEAR(flux, 4615.38, 5e-3);
  for (int cells : {1, 3, 10}) {
    NetworkBuilder builder;
    int const part = builder.part("bars");
    Body const a = make_body("a", Bar{verification_steel(), {0, 0, 0}, {1, 0, 0}, bar_length, 0.01, 0.0, area, cells});
    Body const b =
        make_body("b", Bar{verification_steel(), {0.1, 0, 0}, {1, 0, 0}, bar_length, 0.01, 0.0, area, cells + 2});
    add_to(builder, part, a);
    add_to(builder, part, b);
    hold(builder, part, face(a, "start"), builder.add_boundary({"hot", T0 + end, {}}));
    hold(builder, part, face(b, "end"), builder.add_boundary({"cold", T0, {}}));
    connect_by_area(builder, part, face(a, "end"), face(b, "start"), contact);
    auto const state = steady_state(builder.build(), {}, std::vector<double>(std::size_t(2 * cells + 2), T0));
    double const before = state[std::size_t(cells) - 1] - flux * face(a, "end").contacts[0].half_resistance;
    double const after = state[std::size_t(cells)] + flux * face(b, "start").contacts[0].half_resistance;
    EXPECT_NEAR(before - T0, 10.76923, 1e-5);
    EXPECT_NEAR(after - T0, 9.23077, 1e-5);
    EXPECT_NEAR((before - after) * contact, flux, 1e-6);
  }
}

}  // namespace
}  // namespace thermotwin::thermal
