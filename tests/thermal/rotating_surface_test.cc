#include "thermal/rotating_surface.h"

#include <gtest/gtest.h>
#include <numbers>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

constexpr double rpm = std::numbers::pi / 30.0;
constexpr double celsius(double t) { return t + zero_celsius; }

struct PrototypeRow {
  double diameter, speed_rpm, surface, air, film;
};

class RotatingCylinder : public testing::TestWithParam<PrototypeRow> {};

TEST_P(RotatingCylinder, AgreesWithThePrototypeToOnePartInAMillion) {  // h_rot_cyl of reference/net.py
  PrototypeRow const& r = GetParam();
  double const film = rotating_cylinder_film(celsius(r.surface), celsius(r.air), r.diameter, r.speed_rpm * rpm);
  EXPECT_NEAR(film, r.film, 1e-6 * r.film);
}

INSTANTIATE_TEST_SUITE_P(Prototype, RotatingCylinder,
                         testing::Values(PrototypeRow{0.04, 1200, 30, 20, 26.507370050462313},
                                         PrototypeRow{0.07, 3000, 30, 22, 58.68363275525793},
                                         PrototypeRow{0.07, 6000, 45, 22, 92.37248095950052},
                                         PrototypeRow{0.07, 0, 40, 22, 4.596936944883349},
                                         PrototypeRow{0.14, 4500, 35, 22, 96.59824889522122},
                                         PrototypeRow{0.04, 6000, 22, 30, 77.2996102442939},
                                         PrototypeRow{0.065, 60, 25, 20, 4.835964977688352}));

template <class S>
S shaft_film(S const& surface, S const& speed) {
  return rotating_cylinder_film<S>(surface, S(celsius(22)), S(0.07), speed);
}

TEST(RotatingCylinderFilm, GivesTheNumbersOfPhysics2_5BesideJungnickels) {
  EXPECT_NEAR(rotating_cylinder_film(celsius(30), celsius(20), 0.04, 1200 * rpm), 26.5, 0.05);
  EXPECT_NEAR(shaft_film(celsius(30), 3000 * rpm), 58.7, 0.05);
  EXPECT_NEAR(jungnickel_cylinder_film(1200 * rpm, 0.020), 23.1, 0.05);
  EXPECT_NEAR(jungnickel_cylinder_film(3000 * rpm, 0.035), 54.9, 0.05);
  EXPECT_NEAR(jungnickel_cylinder_film(6000 * rpm, 0.035), 89.2, 0.05);
}

TEST(RotatingCylinderFilm, IsSmoothThroughRestAndEqualTemperatures) {
  auto const over_speed = [](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return shaft_film<S>(S(celsius(30)), w);
  };
  auto const over_temperature = [](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return shaft_film<S>(T, S(0.0));
  };
  EXPECT_EQ(slope_of(over_speed, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(over_speed(-100.0), over_speed(100.0));
  expect_continuous_with_slope(over_speed, -20.0, 20.0);
  expect_slope_is_difference(over_speed, 300.0, 0.01);
  expect_continuous_with_slope(over_temperature, celsius(21.9), celsius(22.1));
  expect_slope_is_difference(over_temperature, celsius(22.5), 1e-4);
  EXPECT_EQ(over_speed(0.0), horizontal_cylinder_film(celsius(30), celsius(22), 0.07));
}

TEST(RotatingCylinderFilm, WorksInCoolantToo) {
  EXPECT_GT(rotating_cylinder_film(celsius(30), celsius(22), 0.07, 100.0, Water{}),
            50 * shaft_film(celsius(30), 100.0));
}

TEST(CylinderNusselt, AlternativesAreOfOneOrder) {
  double const becker = becker_nusselt(2e4, 0.71);
  EXPECT_NEAR(slow_cylinder_nusselt(2e4, 0.71), becker, 0.4 * becker);
  EXPECT_NEAR(anderson_saunders_nusselt(2e4), becker, 0.2 * becker);
  EXPECT_NEAR(becker, 0.133 * std::pow(2e4, 2.0 / 3.0) * std::cbrt(0.71), 1e-9);
}

TEST(JungnickelFilms, VanishAtRest) {
  auto const cylinder = [](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return jungnickel_cylinder_film<S>(w, S(0.035));
  };
  auto const disc = [](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return jungnickel_disc_film<S>(w, S(0.1));
  };
  EXPECT_EQ(cylinder(0.0), 0.0);
  EXPECT_EQ(disc(0.0), 0.0);
  EXPECT_NEAR(disc(-100.0), 2.73 * std::pow(100.0, 0.8) * std::pow(0.1, 0.6), 1e-6);
  expect_slope_is_difference(cylinder, 100.0, 1e-3);
  expect_slope_is_difference(disc, 100.0, 1e-3);
  expect_continuous_with_slope(cylinder, -0.01, 0.01);
}

TEST(Disc, IsSmoothIntoTurbulence) {
  auto const nusselt = [](auto const& re) { return disc_nusselt(re); };
  expect_smooth_switch(nusselt, disc_film_turbulence_reynolds);
  EXPECT_NEAR(nusselt(1e4), 36.0, 1e-6);
  EXPECT_NEAR(nusselt(1e6), 0.015 * std::pow(1e6, 0.8), 1e-6);
  auto const film = [](auto const& w) {
    using S = std::decay_t<decltype(w)>;
    return rotating_disc_film<S>(S(celsius(30)), S(celsius(20)), S(0.1), w);
  };
  expect_slope_is_difference(film, 300.0, 1e-3);
  EXPECT_NEAR(film(0.0), 0.0, 0.01);
}

TEST(Disc, AgreesWithJungnickelWhenTurbulent) {
  double const w = 2000.0, R = 0.2;
  double const film = rotating_disc_film(celsius(30), celsius(20), R, w);
  EXPECT_NEAR(film, jungnickel_disc_film(w, R), 0.4 * film);
}

TEST(Fan, FollowsItsPowerAndStopsWithTheShaft) {
  EXPECT_NEAR(fan_conductance(1.5, 0.5, 0.8), 1.5 * std::pow(0.5, 0.8), 1e-6);
  EXPECT_EQ(fan_conductance(1.5, 0.0, 0.5), 0.0);
  EXPECT_NEAR(fan_enthalpy_conductance(1200.0, 1e-3, -0.5), 0.6, 1e-9);
  auto const fan = [](auto const& r) {
    using S = std::decay_t<decltype(r)>;
    return fan_conductance<S>(S(1.5), r, 0.8);
  };
  expect_slope_is_difference(fan, 0.5, 1e-5);
  expect_continuous_with_slope(fan, -1e-3, 1e-3);
}

TEST(MixedConvection, FollowsThePublishedExponents) {
  EXPECT_NEAR(assisting_convection(3.0, 4.0), std::cbrt(91.0), 1e-12);
  EXPECT_NEAR(transverse_convection(3.0, 4.0), std::pow(337.0, 0.25), 1e-12);
  EXPECT_NEAR(opposing_convection(2.0, 6.0), std::cbrt(208.0), 1e-3);
  EXPECT_NEAR(opposing_convection(6.0, 2.0), opposing_convection(2.0, 6.0), 1e-12);
}

TEST(MixedConvection, IsTheStrongerOneWhereTheOtherVanishes) {
  EXPECT_DOUBLE_EQ(assisting_convection(5.0, 0.0), 5.0);
  EXPECT_DOUBLE_EQ(transverse_convection(0.0, 5.0), 5.0);
  EXPECT_NEAR(opposing_convection(5.0, 0.0), 5.0, 1e-3);
}

TEST(MixedConvection, OpposingFlowsCancelSmoothly) {
  auto const mixed = [](auto const& a) {
    using S = std::decay_t<decltype(a)>;
    return opposing_convection<S>(a, S(10.0));
  };
  EXPECT_NEAR(mixed(10.0), 2.7, 0.05);
  expect_continuous_with_slope(mixed, 5.0, 20.0);
  expect_slope_is_difference(mixed, 10.2, 1e-5);
}

}  // namespace
}  // namespace thermotwin::thermal
