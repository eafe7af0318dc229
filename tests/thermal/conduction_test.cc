#include "thermal/conduction.h"

#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

TEST(Conduction, Bar) { EXPECT_DOUBLE_EQ(bar_conductance(50.0, 1e-4, 0.1), 0.05); }

TEST(Conduction, ThinRingIsAPlateWrappedRound) {
  double const plate = bar_conductance(50.0, 2 * std::numbers::pi * 0.1 * 0.02, 1e-5);
  EXPECT_NEAR(radial_conductance(50.0, 0.02, 0.1, 0.1 + 1e-5), plate, 1e-4 * plate);
}

TEST(Conduction, RadialResistancesInSeriesAddUp) {
  double const whole = radial_conductance(50.0, 0.02, 0.02, 0.08);
  double const inner = radial_conductance(50.0, 0.02, 0.02, 0.04);
  double const outer = radial_conductance(50.0, 0.02, 0.04, 0.08);
  EXPECT_NEAR(1 / whole, 1 / inner + 1 / outer, 1e-12);
}

TEST(Conduction, AxialHollowCylinder) {
  EXPECT_NEAR(axial_conductance(50.0, 0.2, 0.01, 0.03), bar_conductance(50.0, std::numbers::pi * 8e-4, 0.2), 1e-12);
}

TEST(Conduction, CylinderMeanToSurfaceIsV4b) {  // T̄ − T_s = q'''R²/8k
  double const heat_density = 1e6, radius = 0.02, length = 0.1, k = 40.0;
  double const heat = heat_density * std::numbers::pi * radius * radius * length;
  EXPECT_NEAR(heat / cylinder_mean_to_surface(k, length), heat_density * radius * radius / (8 * k), 1e-12);
}

TEST(Conduction, PlateMeanToSurfaceIsV4) {  // slab with both faces at one temperature: mean rise q'''L²/(12k)
  double const heat_density = 1e5, thickness = 0.2, area = 0.5, k = 50.0;
  double const both_faces = 2 * plate_mean_to_surface(k, area, thickness / 2);
  EXPECT_NEAR(heat_density * area * thickness / both_faces, heat_density * thickness * thickness / (12 * k), 1e-12);
}

TEST(Conduction, Spreading) { EXPECT_DOUBLE_EQ(spreading_conductance(50.0, 0.01), 2.0); }

TEST(Conduction, CellsWithContactAreV6) {  // two bars, ends at 20 K and 0: q = 4615.38 W/m²
  double const flux = 20.0 / (0.1 / 50 + 1 / 3000.0 + 0.1 / 50);
  EXPECT_NEAR(flux, 4615.38, 0.005);
  EXPECT_NEAR(cell_conductance(1.0, 0.2, 50.0, 3000.0, 0.2, 50.0) * 20.0, flux, 1e-9);
  EXPECT_NEAR(surface_cell_conductance(2.0, 0.01, 50.0, 100.0), 2.0 / (1e-4 + 1e-2), 1e-12);
}

TEST(Conduction, SlopesAreExact) {
  expect_slope_is_difference(
      [](auto const& r) {
        using S = std::decay_t<decltype(r)>;
        return radial_conductance<S>(S(50.0), S(0.02), S(0.02), r);
      },
      0.05, 1e-6);
  expect_slope_is_difference(
      [](auto const& h) {
        using S = std::decay_t<decltype(h)>;
        return cell_conductance<S>(S(1.0), S(0.01), S(50.0), h, S(0.02), S(40.0));
      },
      3000.0, 0.1);
}

}  // namespace
}  // namespace thermotwin::thermal
