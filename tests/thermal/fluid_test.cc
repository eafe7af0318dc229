#include "thermal/fluid.h"

#include <gtest/gtest.h>
#include <string>

#include "tests/thermal/smoothness.h"
#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

constexpr double celsius(double t) { return t + zero_celsius; }

TEST(Air, FollowsTheChordsOfTheVdiTable) {
  FluidProperties<double> const cold = properties(Air{}, celsius(0));
  FluidProperties<double> const warm = properties(Air{}, celsius(75));
  EXPECT_DOUBLE_EQ(cold.conductivity, 0.02425);
  EXPECT_NEAR(warm.conductivity, 0.02987, 1e-12);
  EXPECT_DOUBLE_EQ(cold.kinematic_viscosity, 1.35e-5);
  EXPECT_NEAR(warm.kinematic_viscosity, 2.078e-5, 1e-17);
  EXPECT_EQ(warm.prandtl, 0.71);
}

TEST(Air, IsThatOfThePropertyTableAt25Celsius) {
  FluidProperties<double> const air = properties(Air{}, celsius(25));
  EXPECT_NEAR(air.conductivity, 0.02625, 0.01 * 0.02625);
  EXPECT_NEAR(air.density, 1.169, 0.001);
  EXPECT_EQ(air.specific_heat, 1007.0);
  EXPECT_NEAR(air.kinematic_viscosity, 1.579e-5, 0.01 * 1.579e-5);
  EXPECT_DOUBLE_EQ(air.expansion, 1.0 / 298.15);
}

struct WaterRow {
  double t, k, density, c, nu;
};

class WaterTable : public testing::TestWithParam<WaterRow> {};

TEST_P(WaterTable, AgreesWithVdi) {
  WaterRow const& row = GetParam();
  FluidProperties<double> const water = properties(Water{}, celsius(row.t));
  EXPECT_NEAR(water.conductivity, row.k, 0.01 * row.k);
  EXPECT_NEAR(water.density, row.density, 1e-4 * row.density);
  EXPECT_NEAR(water.specific_heat, row.c, 0.002 * row.c);
  EXPECT_NEAR(water.kinematic_viscosity, row.nu, (row.t < 70 ? 0.002 : 0.01) * row.nu);
  EXPECT_NEAR(water.prandtl, row.nu * row.density * row.c / row.k, 0.013 * water.prandtl);
}

INSTANTIATE_TEST_SUITE_P(Points, WaterTable,
                         testing::Values(WaterRow{0, 0.562, 999.8, 4219, 1.792e-6},
                                         WaterRow{20, 0.600, 998.2, 4185, 1.003e-6},
                                         WaterRow{40, 0.629, 992.2, 4179, 0.658e-6},
                                         WaterRow{50, 0.641, 988.1, 4180, 0.553e-6},
                                         WaterRow{75, 0.6635, 974.9, 4192, 0.387e-6}));

TEST(Water, ExpandsAsItsDensityFallsAndIsDensestAt4Celsius) {
  auto const density = [](auto const& T) { return properties(Water{}, T).density; };
  for (double const t : {1.0, 20.0, 60.0, 90.0})
    EXPECT_NEAR(properties(Water{}, celsius(t)).expansion, -slope_of(density, celsius(t)) / density(celsius(t)), 1e-15);
  EXPECT_NEAR(properties(Water{}, celsius(20)).expansion, 2.07e-4, 0.02e-4);
  EXPECT_NEAR(properties(Water{}, celsius(3.98)).expansion, 0.0, 1e-6);
}

TEST(Emulsion, IsThatOfThePropertyTableAt20Celsius) {
  FluidProperties<double> const emulsion = properties(Emulsion{}, celsius(20));
  EXPECT_NEAR(emulsion.conductivity, 0.58, 0.003);
  EXPECT_NEAR(emulsion.density, 1000.0, 0.1);
  EXPECT_NEAR(emulsion.specific_heat, 4050.0, 5.0);
  EXPECT_NEAR(emulsion.kinematic_viscosity, 1.2e-6, 0.002e-6);
}

TEST(WaterGlycol, IsThatOfThePropertyTable) {
  FluidProperties<double> const at_20 = properties(water_glycol(), celsius(20));
  EXPECT_DOUBLE_EQ(at_20.conductivity, 0.48);
  EXPECT_DOUBLE_EQ(at_20.density, 1045.0);
  EXPECT_DOUBLE_EQ(at_20.specific_heat, 3650.0);
  EXPECT_NEAR(at_20.kinematic_viscosity, 2.2e-6, 1e-15);
  EXPECT_NEAR(properties(water_glycol(), celsius(40)).kinematic_viscosity, 1.3e-6, 1e-15);
}

TEST(EthyleneGlycol, IsThatOfThePropertyTableAt27Celsius) {
  FluidProperties<double> const glycol = properties(ethylene_glycol(), celsius(27));
  EXPECT_NEAR(glycol.conductivity, 0.252, 1e-12);
  EXPECT_NEAR(glycol.density, 1114.0, 2.0);
  EXPECT_NEAR(glycol.specific_heat, 2415.0, 2.0);
  EXPECT_NEAR(glycol.kinematic_viscosity, 14.1e-6, 1e-11);
  EXPECT_NEAR(properties(ethylene_glycol(), celsius(47)).kinematic_viscosity, 6.91e-6, 0.01 * 6.91e-6);
}

TEST(MineralOil, HasItsGradesViscosityAndAPrandtlNumberInTheHundreds) {
  FluidProperties<double> const oil = properties(mineral_oil(10), celsius(20));
  EXPECT_DOUBLE_EQ(oil.specific_heat, 1900.0);
  EXPECT_DOUBLE_EQ(properties(mineral_oil(10), celsius(30)).specific_heat, 1940.0);
  EXPECT_NEAR(oil.kinematic_viscosity, 22.5e-6, 0.05e-6);
  EXPECT_NEAR(oil.prandtl, 22.53e-6 * 870.0 * 1900.0 / 0.13, 0.2);
}

TEST(Fluid, EveryPropertyHasTheExactSlopeInTemperature) {
  for (std::string const& name : fluid_names()) {
    SCOPED_TRACE(name);
    Fluid const f = fluid(name);
    expect_slope_is_difference([&](auto const& T) { return properties(f, T).conductivity; }, 310.0, 0.01);
    expect_slope_is_difference([&](auto const& T) { return properties(f, T).density; }, 310.0, 0.01);
    expect_slope_is_difference([&](auto const& T) { return properties(f, T).specific_heat; }, 310.0, 0.01);
    expect_slope_is_difference([&](auto const& T) { return properties(f, T).kinematic_viscosity; }, 310.0, 0.01);
    expect_slope_is_difference([&](auto const& T) { return properties(f, T).prandtl; }, 310.0, 0.01);
    expect_slope_is_difference([&](auto const& T) { return properties(f, T).expansion; }, 310.0, 0.01);
  }
}

TEST(Fluid, IsFoundByNameWithAnyIsoGrade) {
  EXPECT_TRUE(std::holds_alternative<Air>(fluid("Air")));
  EXPECT_DOUBLE_EQ(properties(fluid("oil VG46"), 313.15).kinematic_viscosity,
                   viscosity(mineral_oil_viscosity(46), 313.15));
}

TEST(Fluid, UnknownNameGetsTheNearest) {
  try {
    (void)fluid("watter");
    FAIL() << "accepted";
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(), "unknown fluid 'watter'; did you mean 'water'?");
  }
}

}  // namespace
}  // namespace thermotwin::thermal
