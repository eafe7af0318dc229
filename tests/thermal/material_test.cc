#include "thermal/material.h"

#include <gtest/gtest.h>
#include <set>
#include <string>

#include "tests/thermal/smoothness.h"
#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

TEST(Material, HasTheValuesOfTheTable) {
  Material const& steel = material("42CrMo4");
  EXPECT_EQ(steel.expansion, 11.8e-6);
  EXPECT_EQ(steel.youngs_modulus, 210e9);
  Material const& iron = material("GJL-300");
  EXPECT_EQ(iron.conductivity, 47.5);
  EXPECT_EQ(iron.specific_heat, 500.0);
  EXPECT_EQ(iron.expansion, 10.5e-6);
  EXPECT_EQ(iron.name, "GJL-300");
}

TEST(Material, RollingBearingSteelChangesWithTemperature) {
  Material const& steel = material("100Cr6");
  EXPECT_DOUBLE_EQ(conductivity(steel, 293.15), 33.0);
  EXPECT_NEAR(conductivity(steel, 313.15), 33.0 * 0.99, 1e-12);
  EXPECT_NEAR(specific_heat(steel, 313.15), 461.0 * 1.02, 1e-12);
  expect_slope_is_difference([&](auto const& T) { return conductivity(steel, T); }, 300.0, 1.0);
  expect_slope_is_difference([&](auto const& T) { return specific_heat(steel, T); }, 300.0, 1.0);
}

TEST(Material, DiffusivitiesAreThoseOfTheQuickCheck) {
  EXPECT_NEAR(diffusivity(material("42CrMo4")), 1.2e-5, 0.1e-5);
  EXPECT_NEAR(diffusivity(material("100Cr6")), 0.9e-5, 0.05e-5);
  EXPECT_NEAR(diffusivity(material("GJL-250")), 1.3e-5, 0.05e-5);
  EXPECT_NEAR(diffusivity(material("AlMgSi")), 6.5e-5, 0.1e-5);
  EXPECT_NEAR(diffusivity(material("mineral casting")), 0.7e-6, 0.1e-6);
}

TEST(Material, EveryOneIsPhysical) {
  std::set<std::string> names;
  for (std::string const& name : material_names()) {
    Material const& m = material(name);
    EXPECT_TRUE(names.insert(m.name).second) << name;
    EXPECT_GT(diffusivity(m), 1e-8) << name;
    EXPECT_LT(diffusivity(m), 2e-4) << name;
    EXPECT_GE(m.expansion, 0.0) << name;
    EXPECT_LT(m.poisson_ratio, 0.5) << name;
    EXPECT_GT(m.emissivity, 0.0) << name;
    EXPECT_LE(m.emissivity, 1.0) << name;
  }
  EXPECT_GE(names.size(), 20U);
}

TEST(Material, IsFoundWhateverTheCase) { EXPECT_EQ(material("invar 36").name, "Invar 36"); }

TEST(Material, ListOfNamesSaysWhatTheyMean) {
  try {
    (void)material("Grauguss");
    FAIL() << "accepted";
  } catch (InputError const& error) {
    std::string const text = error.what();
    EXPECT_NE(text.find("known: 'granite', 'AlMgSi' (aluminium alloy), 'GJL-250' (grey cast iron), "), text.npos)
        << text;
  }
  EXPECT_EQ(material("GJL-300").meaning, "grey cast iron");
}

TEST(Material, UnknownNameGetsTheNearest) {
  try {
    (void)material("42CrMo5");
    FAIL() << "accepted";
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(), "unknown material '42CrMo5'; did you mean '42CrMo4'?");
  }
}

}  // namespace
}  // namespace thermotwin::thermal
