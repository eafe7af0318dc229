#include "thermal/channel_flow.h"

#include <gtest/gtest.h>
#include <numbers>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

constexpr double area = 80e-6, hydraulic_diameter = 4.0 * 80e-6 / 36e-3;  // jacket groove 8 × 10 mm
constexpr double flow = 8e-3 / 60.0;                                      // 8 L/min
constexpr double curvature = hydraulic_diameter / 0.160;

TEST(Laminar, HasTheTwoAsymptotes) {
  EXPECT_NEAR(laminar_nusselt(1.0, 7.0, 1e-4), 3.66, 1e-4);
  double const entry = 2000.0 * 100.0 * 0.05;
  EXPECT_NEAR(laminar_nusselt(2000.0, 100.0, 0.05), 1.615 * std::cbrt(entry), 0.05);
  double const x = 1000.0 * 7.0 * 0.01;
  EXPECT_GE(laminar_nusselt(1000.0, 7.0, 0.01), std::max(3.66, 1.615 * std::cbrt(x)));
  EXPECT_EQ(laminar_nusselt(0.0, 7.0, 0.01), 3.66);
  expect_slope_is_difference(
      [](auto const& re) {
        using S = std::decay_t<decltype(re)>;
        return laminar_nusselt<S>(re, S(7.0), S(0.01));
      },
      500.0, 0.1);
}

TEST(Laminar, SiederTateAgreesInTheEntry) {
  double const x = 2000.0 * 100.0 * 0.05;
  EXPECT_NEAR(sieder_tate_nusselt(2000.0, 100.0, 0.05, 1.0), 1.86 * std::cbrt(x), 1e-9);
  EXPECT_NEAR(sieder_tate_nusselt(2000.0, 100.0, 0.05, 2.0) / sieder_tate_nusselt(2000.0, 100.0, 0.05, 1.0),
              std::pow(2.0, 0.14), 1e-12);
}

TEST(Turbulent, CorrelationsAgreeForWater) {
  for (double const re : {1.5e4, 5e4, 1e5}) {
    double const gnielinski = gnielinski_nusselt(re, 7.0, 1e-6);
    EXPECT_NEAR(dittus_boelter_nusselt(re, 7.0, FluidIs::heated), gnielinski, 0.2 * gnielinski) << re;
    EXPECT_NEAR(gnielinski_1976_nusselt(re, 7.0, 1e-6), gnielinski * (1 - 1000 / re), 1e-9) << re;
  }
  EXPECT_LT(dittus_boelter_nusselt(5e4, 7.0, FluidIs::cooled), dittus_boelter_nusselt(5e4, 7.0, FluidIs::heated));
}

TEST(Turbulent, SlopesAreExact) {
  auto const each = [](auto const& re) {
    using S = std::decay_t<decltype(re)>;
    return gnielinski_1976_nusselt<S>(re, S(7.0), S(0.01)) + dittus_boelter_nusselt<S>(re, S(7.0), FluidIs::cooled);
  };
  auto const over_prandtl = [](auto const& pr) {
    using S = std::decay_t<decltype(pr)>;
    return gnielinski_nusselt<S>(S(2e4), pr, S(0.01)) * wall_correction<S>(pr, S(5.0), channel_wall_exponent) +
           sieder_tate_nusselt<S>(S(1e3), pr, S(0.01), S(1.2));
  };
  expect_slope_is_difference(each, 2e4, 1.0);
  expect_slope_is_difference(over_prandtl, 7.0, 1e-3);
}

TEST(Turbulent, FrictionIsThatOfASmoothPipe) { EXPECT_NEAR(smooth_pipe_friction(1e5), 0.0180, 0.0003); }

template <class S>
S pipe_nusselt(S const& reynolds) {
  return channel_nusselt<S>(reynolds, S(7.0), S(0.02));
}

TEST(Channel, FollowsEachLawInItsRange) {
  EXPECT_NEAR(pipe_nusselt(1000.0), laminar_nusselt(1000.0, 7.0, 0.02), 1e-3);
  EXPECT_NEAR(pipe_nusselt(3e4), gnielinski_nusselt(3e4, 7.0, 0.02), 1e-4);
  double const middle = 0.5 * (laminar_nusselt(2300.0, 7.0, 0.02) + gnielinski_nusselt(1e4, 7.0, 0.02));
  EXPECT_NEAR(pipe_nusselt(6150.0), middle, 0.01);
}

TEST(Channel, IsSmoothAndRisesThroughTheTransition) {
  auto const nusselt = [](auto const& re) { return pipe_nusselt(re); };
  expect_smooth_switch(nusselt, laminar_end_reynolds);
  expect_smooth_switch(nusselt, turbulent_start_reynolds);
  for (double re = 100.0; re < 2e4; re += 100.0) EXPECT_GT(slope_of(nusselt, re), 0.0) << re;
  EXPECT_TRUE(std::isfinite(slope_of(nusselt, 0.0)));
  expect_slope_is_difference(nusselt, 2300.0, 0.1);
  expect_slope_is_difference(nusselt, 9000.0, 0.1);
}

TEST(Helix, DelaysTurbulence) { EXPECT_NEAR(helix_laminar_end(curvature), 7687.0, 1.0); }

TEST(Helix, OilVg10IsLaminarWithAbout0Point7KwPerM2K) {  // 8 L/min in 8 × 10 mm on Ø160, 25 °C
  Liquid const oil = mineral_oil(10);
  double const nu = properties(oil, 298.15).kinematic_viscosity;
  EXPECT_NEAR(channel_reynolds(flow, area, hydraulic_diameter, nu), 820.0, 10.0);
  EXPECT_NEAR(helix_film(oil, 298.15, 298.15, flow, area, hydraulic_diameter, 0.160), 700.0, 30.0);
}

TEST(Helix, WaterIsNearlyTurbulentWithAbout9Point6KwPerM2K) {
  FluidProperties<double> const water = properties(Water{}, 293.15);
  double const re = channel_reynolds(flow, area, hydraulic_diameter, water.kinematic_viscosity);
  EXPECT_NEAR(re, 1.5e4, 300.0);
  double const friction = 0.3164 * std::pow(re, -0.25) + 0.03 * std::sqrt(curvature);
  EXPECT_NEAR(petukhov_nusselt(friction, re, water.prandtl) * water.conductivity / hydraulic_diameter, 9600.0, 100.0);
  EXPECT_NEAR(helix_film(Water{}, 293.15, 293.15, flow, area, hydraulic_diameter, 0.160), 9600.0, 0.08 * 9600.0);
}

TEST(Helix, IsSmoothAcrossBothSwitches) {
  auto const nusselt = [](auto const& re) {
    using S = std::decay_t<decltype(re)>;
    return helix_nusselt<S>(re, S(7.0), curvature);
  };
  expect_smooth_switch(nusselt, helix_laminar_end(curvature));
  expect_smooth_switch(nusselt, helix_turbulent_start);
  expect_slope_is_difference(nusselt, 1.2e4, 0.1);
  EXPECT_NEAR(helix_curvature_diameter(0.160, 0.012), 0.160 * (1 + std::pow(0.012 / (std::numbers::pi * 0.160), 2)),
              1e-12);
}

TEST(ChannelFilm, HotterWallHelpsALiquidAndTheSlopesAreExact) {
  Liquid const oil = mineral_oil(32);
  auto const over_wall = [&](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return channel_film<S>(oil, T, S(300.0), S(flow), S(area), S(hydraulic_diameter), S(1.0));
  };
  auto const over_fluid = [&](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return channel_film<S>(oil, S(310.0), T, S(flow), S(area), S(hydraulic_diameter), S(1.0));
  };
  auto const over_flow = [&](auto const& V) {
    using S = std::decay_t<decltype(V)>;
    return channel_film<S>(Water{}, S(310.0), S(300.0), V, S(area), S(hydraulic_diameter), S(1.0));
  };
  EXPECT_GT(over_wall(330.0), over_wall(300.0));
  expect_slope_is_difference(over_wall, 310.0, 0.01);
  expect_slope_is_difference(over_fluid, 300.0, 0.01);
  expect_slope_is_difference(over_flow, flow, 1e-8);
  EXPECT_TRUE(std::isfinite(slope_of(over_flow, 0.0)));
  EXPECT_NEAR(over_flow(0.0),
              3.66 * properties(Water{}, 300.0).conductivity / hydraulic_diameter *
                  std::pow(properties(Water{}, 300.0).prandtl / properties(Water{}, 310.0).prandtl, 0.11),
              1e-3);
}

TEST(HelixFilm, HasExactSlopes) {
  auto const over_fluid = [](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return helix_film<S>(mineral_oil(10), S(310.0), T, S(flow), S(area), hydraulic_diameter, 0.160);
  };
  expect_slope_is_difference(over_fluid, 300.0, 0.01);
}

TEST(Ntu, TendsToFilmAndToCapacityRate) {
  EXPECT_NEAR(ntu_conductance(1000.0, 0.01), 0.01, 1e-7);
  EXPECT_NEAR(ntu_conductance(10.0, 1e4), 10.0, 1e-12);
  EXPECT_NEAR(ntu_conductance(100.0, 100.0), 100.0 * (1.0 - std::exp(-1.0)), 1e-12);
  expect_slope_is_difference(
      [](auto const& c) {
        using S = std::decay_t<decltype(c)>;
        return ntu_conductance<S>(c, S(80.0));
      },
      100.0, 1e-3);
}

TEST(ViscousFlow, HalvesWhenViscosityDoublesInALaminarCircuit) {
  EXPECT_DOUBLE_EQ(viscous_flow_ratio(10e-6, 20e-6, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(viscous_flow_ratio(10e-6, 20e-6, 0.0), 1.0);
  expect_slope_is_difference(
      [](auto const& exponent) {
        using S = std::decay_t<decltype(exponent)>;
        return viscous_flow_ratio<S>(S(10e-6), S(20e-6), exponent);
      },
      0.6, 1e-4);
}

}  // namespace
}  // namespace thermotwin::thermal
