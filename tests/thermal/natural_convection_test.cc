#include "thermal/natural_convection.h"

#include <gtest/gtest.h>

#include "tests/thermal/smoothness.h"

namespace thermotwin::thermal {
namespace {

constexpr double celsius(double t) { return t + zero_celsius; }

TEST(Rayleigh, FollowsItsDefinition) {
  FluidProperties<double> const air = properties(Air{}, celsius(25));
  double const nu = air.kinematic_viscosity;
  EXPECT_NEAR(rayleigh(air, -10.0, 0.5), 9.81 / 298.15 * 10.0 * 0.125 / (nu * nu) * 0.71,
              1e-5 * rayleigh(air, 10.0, 0.5));
}

TEST(VerticalPlate, CorrelationsAgreeWhereBothHold) {
  for (double const ra : {1e6, 1e7, 1e8}) {
    double const jungnickel = jungnickel_vertical_plate_nusselt(ra);
    EXPECT_NEAR(vertical_plate_nusselt(ra, 0.71), jungnickel, 0.15 * jungnickel) << ra;
  }
}

TEST(VerticalPlate, ChurchillChuTendsToItsLimits) {
  EXPECT_NEAR(vertical_plate_nusselt(0.0, 0.71), 0.825 * 0.825, 1e-12);
  // textbook value: Nu = 0.1 Ra^{1/3} within a few per cent for air at large Ra
  EXPECT_NEAR(vertical_plate_nusselt(1e12, 0.71), 0.105 * 1e4, 0.15e3);
  expect_slope_is_difference(
      [](auto const& ra) {
        using S = std::decay_t<decltype(ra)>;
        return vertical_plate_nusselt<S>(ra, S(0.71));
      },
      1e7, 10.0);
}

TEST(VerticalPlate, JungnickelIsSmoothIntoTurbulence) {
  auto const nusselt = [](auto const& ra) { return jungnickel_vertical_plate_nusselt(ra); };
  expect_smooth_switch(nusselt, jungnickel_plate_turbulence_rayleigh);
  EXPECT_NEAR(nusselt(1e8), 55.0, 1e-3);
  EXPECT_NEAR(nusselt(1e9), 140.0, 1e-3);
  expect_slope_is_difference(nusselt, 5e8, 1e3);
}

TEST(HorizontalPlate, IsSmoothIntoTurbulence) {
  auto const nusselt = [](auto const& ra) { return unstable_plate_nusselt(ra); };
  expect_smooth_switch(nusselt, horizontal_plate_turbulence_rayleigh);
  EXPECT_NEAR(nusselt(1e6), 0.54 * std::pow(1e6, 0.25), 1e-6);
  EXPECT_NEAR(nusselt(1e9), 140.0, 1e-6);
  EXPECT_NEAR(stable_plate_nusselt(1e8), 27.0, 1e-9);
}

TEST(HorizontalPlate, HotUpIsColdDown) {
  double const hot_up = horizontal_plate_film(Facing::up, celsius(30), celsius(20), 0.2);
  double const cold_down = horizontal_plate_film(Facing::down, celsius(20), celsius(30), 0.2);
  double const hot_down = horizontal_plate_film(Facing::down, celsius(30), celsius(20), 0.2);
  EXPECT_DOUBLE_EQ(hot_up, cold_down);
  EXPECT_NEAR(hot_up / hot_down, 2.0, 1e-3);
}

TEST(HorizontalPlate, IsSmoothWhereTheLayeringTurnsOver) {
  for (Facing const facing : {Facing::up, Facing::down}) {
    auto const film = [&](auto const& T) {
      using S = std::decay_t<decltype(T)>;
      return horizontal_plate_film<S>(facing, T, S(celsius(20)), S(0.2));
    };
    expect_continuous_with_slope(film, celsius(19.9), celsius(20.1));
    expect_slope_is_difference(film, celsius(20.05), 1e-5);
  }
}

TEST(HorizontalCylinder, AgreesWithThePrototypeAtRest) {  // h_rot_cyl(0.07, 0, 40, 22) of reference/net.py
  EXPECT_NEAR(horizontal_cylinder_film(celsius(40), celsius(22), 0.07), 4.596936944883349, 5e-6);
}

TEST(FreeFilms, HaveExactSlopesInTemperatureInAnyFluid) {
  auto const check = [](auto const& film) {
    expect_slope_is_difference(film, celsius(32), 1e-3);
    expect_slope_is_difference(film, celsius(19), 1e-3);
    EXPECT_TRUE(std::isfinite(slope_of(film, celsius(20)))) << "at equal temperatures";
  };
  for (Fluid const& medium : {Fluid(Air{}), Fluid(Water{}), Fluid(mineral_oil(32))}) {
    check([&](auto const& T) {
      using S = std::decay_t<decltype(T)>;
      return vertical_plate_film<S>(T, S(celsius(20)), S(0.5), medium);
    });
    check([&](auto const& T) {
      using S = std::decay_t<decltype(T)>;
      return horizontal_cylinder_film<S>(T, S(celsius(20)), S(0.1), medium);
    });
    check([&](auto const& T) {
      using S = std::decay_t<decltype(T)>;
      return horizontal_plate_film<S>(Facing::up, T, S(celsius(20)), S(0.1), medium);
    });
  }
}

TEST(RoomFilm, AgreesWithThePrototype) {  // h_room of reference/net.py, whose σ = 5.6703e-8 is 1.3e-5 below CODATA's
  struct Row {
    double surface, room, film;
  };
  for (Row const& r : {Row{25, 20, 7.999238499246441}, Row{30, 20, 9.089457262424082}, Row{22, 20, 6.9407082512715315},
                       Row{18, 20, 6.856504535512829}, Row{60, 20, 12.572918574043287}})
    EXPECT_NEAR(room_film(celsius(r.surface), celsius(r.room)), r.film, 1.5e-5 * r.film) << r.surface;
}

TEST(RoomFilm, IsAbout8At5KelvinAnd9At10Kelvin) {
  EXPECT_NEAR(room_film(celsius(25), celsius(20)), 8.0, 0.1);
  EXPECT_NEAR(room_film(celsius(30), celsius(20)), 9.0, 0.1);
}

TEST(RoomFilm, IsSmoothAtEqualTemperatures) {
  auto const film = [](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return room_film<S>(T, S(celsius(20)));
  };
  expect_continuous_with_slope(film, celsius(19.9), celsius(20.1));
  expect_slope_is_difference(film, celsius(24), 1e-3);
  EXPECT_LT(std::abs(slope_of(film, celsius(20))), 0.1);
  EXPECT_LT(film(celsius(20)), film(celsius(20.5)));
}

TEST(VerticalGap, IsConductionInAThinOneAndSmoothIntoTurbulence) {
  auto const nusselt = [](auto const& ra) {
    using S = std::decay_t<decltype(ra)>;
    return vertical_gap_nusselt<S>(ra, S(0.71), S(20.0));
  };
  EXPECT_NEAR(nusselt(1.0), 1.0, 1e-3);
  EXPECT_NEAR(nusselt(1e6), 0.42 * std::pow(0.71, 0.012) * std::pow(1e6 / 20.0, 0.25), 0.01);
  EXPECT_NEAR(nusselt(1e8), 0.049 * std::cbrt(1e8), 0.01);
  expect_smooth_switch(nusselt, vertical_gap_turbulence_rayleigh);
  expect_continuous_with_slope(nusselt, 300.0, 3000.0);  // from conduction to flow
  EXPECT_NEAR(vertical_gap_film(celsius(21), celsius(20), 1e-3, 0.1),
              properties(Air{}, celsius(20.5)).conductivity / 1e-3, 0.1);
}

TEST(VerticalGap, HasExactSlopes) {
  auto const film = [](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return vertical_gap_film<S>(T, S(celsius(20)), S(0.03), S(0.5));
  };
  expect_slope_is_difference(film, celsius(28), 1e-3);
  expect_continuous_with_slope(film, celsius(19.9), celsius(20.1));
}

TEST(HorizontalGap, IsConductionBelowTheOnsetAndSmoothAcrossBothSwitches) {
  auto const nusselt = [](auto const& ra) { return horizontal_gap_nusselt(ra); };
  EXPECT_NEAR(nusselt(500.0), 1.0, 1e-4);
  EXPECT_NEAR(nusselt(8000.0), 0.208 * std::pow(8000.0, 0.25), 1e-3);
  EXPECT_NEAR(nusselt(1e6), 9.2, 1e-6);
  expect_smooth_switch(nusselt, horizontal_gap_onset_rayleigh);
  expect_smooth_switch(nusselt, horizontal_gap_turbulence_rayleigh);
}

TEST(HorizontalGap, HeatedFromAboveOnlyConducts) {
  double const conduction = properties(Air{}, celsius(25)).conductivity / 0.05;
  EXPECT_NEAR(horizontal_gap_film(celsius(20), celsius(30), 0.05), conduction, 1e-9);
  EXPECT_GT(horizontal_gap_film(celsius(30), celsius(20), 0.05), 2 * conduction);
  auto const film = [](auto const& T) {
    using S = std::decay_t<decltype(T)>;
    return horizontal_gap_film<S>(T, S(celsius(20)), S(0.05));
  };
  expect_continuous_with_slope(film, celsius(19.8), celsius(20.2));
  expect_slope_is_difference(film, celsius(23), 1e-3);
}

}  // namespace
}  // namespace thermotwin::thermal
