#include "thermal/units.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

struct Reading {
  char const* text;
  double si;
  Dimension dimension;
};

class ReadsQuantity : public testing::TestWithParam<Reading> {};

TEST_P(ReadsQuantity, InSI) {
  Quantity const quantity = parse_quantity(GetParam().text);
  EXPECT_DOUBLE_EQ(quantity.value, GetParam().si);
  EXPECT_EQ(quantity.dimension, GetParam().dimension);
  EXPECT_FALSE(quantity.absolute_temperature);
}

constexpr double pi = std::numbers::pi;

INSTANTIATE_TEST_SUITE_P(
    Units, ReadsQuantity,
    testing::Values(
        Reading{"600 mm", 0.6, dimension::length}, Reading{"-3 um", -3e-6, dimension::length},
        Reading{"3 µm", 3e-6, dimension::length}, Reading{"+5 cm", 0.05, dimension::length},
        Reading{"600mm", 0.6, dimension::length}, Reading{"8000 mm/min", 8.0 / 60.0, dimension::speed},
        Reading{"0.2 K", 0.2, dimension::temperature_difference}, Reading{"9 W/K", 9.0, dimension::conductance},
        Reading{"8 W/(m2 K)", 8.0, dimension::film_coefficient},
        Reading{"8 W/(m²·K)", 8.0, dimension::film_coefficient}, Reading{"8 W/m^2/K", 8.0, dimension::film_coefficient},
        Reading{"8 W*m^-2*K^-1", 8.0, dimension::film_coefficient},
        Reading{"6000 rpm", 200.0 * pi, dimension::angular_speed}, Reading{"9 rad/s", 9.0, dimension::angular_speed},
        Reading{"90 deg", pi / 2.0, dimension::angle}, Reading{"1e-4 1/K", 1e-4, dimension::expansion},
        Reading{"11.8 um/(m K)", 11.8e-6, dimension::expansion}, Reading{"12 ppm/K", 12e-6, dimension::expansion},
        Reading{"25 %", 0.25, dimension::dimensionless}, Reading{"0.8", 0.8, dimension::dimensionless},
        Reading{"1.2 kN/um", 1.2e9, dimension::stiffness}, Reading{"0.45 N m", 0.45, dimension::torque},
        Reading{"8 L/min", 8e-3 / 60.0, dimension::volume_flow}, Reading{"10 mm2/s", 1e-5, dimension::viscosity},
        Reading{"32 cSt", 32e-6, dimension::viscosity}, Reading{"3 K/day", 3.0 / 86400.0, dimension::temperature_rate},
        Reading{"15 min", 900.0, dimension::time}, Reading{"1.5 K/m", 1.5, dimension::temperature_gradient},
        Reading{"460 J/(kg K)", 460.0, dimension::specific_heat}, Reading{"7850 kg/m3", 7850.0, dimension::density},
        Reading{"1 (m/s)^2", 1.0, dimension::latent_heat}, Reading{"0.8 ohm", 0.8, dimension::resistance},
        Reading{"0.8 Ω", 0.8, dimension::resistance}, Reading{"1.6 N m/A", 1.6, dimension::torque_constant},
        Reading{"2 bar", 2e5, dimension::pressure}, Reading{"210 GPa", 2.1e11, dimension::stress}));

TEST(ParseQuantity, IsTheDoubleNearestToTheDecimal) {
  EXPECT_EQ(parse_quantity("250 um").value, 250e-6);
  EXPECT_EQ(parse_quantity("0.7 mm").value, 0.7e-3);
  EXPECT_EQ(parse_quantity("36.5 mm").value, 36.5e-3);
}

TEST(ParseQuantity, CountsRevolutionsWhereNoAngleIsSaid) {
  double const speed = parse_value("3000 rpm", dimension::angular_speed);
  for (std::string const text : {"3000 1/min", "3000 min-1", "3000 min^-1", "3000 min⁻¹", "3000 U/min", "3000 rev/min"})
    EXPECT_EQ(parse_value(text, dimension::angular_speed), speed) << text;
  for (std::string const text : {"50 Hz", "50 1/s", "50 s-1", "50 rev/s", "0.05 kHz"})
    EXPECT_DOUBLE_EQ(parse_value(text, dimension::angular_speed), speed) << text;
  EXPECT_DOUBLE_EQ(parse_value("18000 deg/s", dimension::angular_speed), speed);
  EXPECT_DOUBLE_EQ(parse_value("314 rad/s", dimension::angular_speed), 314.0);
  EXPECT_DOUBLE_EQ(parse_value("0.314 krad/s", dimension::angular_speed), 314.0);
  EXPECT_DOUBLE_EQ(from_unit(3000.0, "1/min"), speed);
  EXPECT_EQ(format_quantity(parse_quantity("3000 1/min").value, dimension::angular_speed), "3000 rpm");
}

TEST(ParseQuantity, MarksDegreesCelsiusAsAPointOnTheScale) {
  for (char const* text : {"22 degC", "22 °C", " 22degC ", "22\u00a0degC", "22\u202f°C\u00a0"}) {
    Quantity const quantity = parse_quantity(text);
    EXPECT_DOUBLE_EQ(quantity.value, 295.15);
    EXPECT_TRUE(quantity.absolute_temperature);
    EXPECT_EQ(quantity.dimension, dimension::temperature_difference);
  }
}

TEST(ParseQuantity, ReadsDegreesFahrenheit) {
  for (char const* text : {"72 degF", "72 °F"}) {
    EXPECT_DOUBLE_EQ(parse_quantity(text).value, (72.0 + 459.67) * 5.0 / 9.0);
    EXPECT_TRUE(parse_quantity(text).absolute_temperature);
  }
  EXPECT_DOUBLE_EQ(parse_temperature("32 degF"), 273.15);
  EXPECT_NEAR(to_unit(373.15, "degF"), 212.0, 1e-9);
}

struct Refusal {
  char const* text;
  char const* message;
};

class RefusesQuantity : public testing::TestWithParam<Refusal> {};

TEST_P(RefusesQuantity, WithReason) {
  try {
    parse_quantity(GetParam().text);
    FAIL() << "accepted " << GetParam().text;
  } catch (InputError const& error) {
    EXPECT_STREQ(error.what(), GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Units, RefusesQuantity,
    testing::Values(
        Refusal{"8000 mm/mim", "'8000 mm/mim': unknown unit 'mim'; did you mean 'min'?"},
        Refusal{"22 degK", "'22 degK': unknown unit 'degK'; did you mean 'degC'?"},
        Refusal{"470 J/kgK", "'470 J/kgK': unknown unit 'kgK'; per both is '/(kg K)'"},
        Refusal{"1 degc", "'1 degc': unknown unit 'degc'; did you mean 'degC'?"},
        Refusal{"8 W/m2 K", "'8 W/m2 K': put what is below the line in parentheses, as in \"8 W/(m2 K)\""},
        Refusal{"5 W/degC", "'5 W/degC': degC is a point on the scale; in a compound unit write K"},
        Refusal{"8 W/(m2 K", "'8 W/(m2 K': a ')' is missing"}, Refusal{"8 W)", "'8 W)': unexpected ')'"},
        Refusal{"8 m/", "'8 m/': the unit ends too early"}, Refusal{"8 m^x", "'8 m^x': an integer is due after '^'"},
        Refusal{"8 m^9", "'8 m^9': an exponent is 1 to 6 or -6 to -1"},
        Refusal{"2h30",
                "'2h30': an exponent is 1 to 6 or -6 to -1; a quantity is one number with one unit, for "
                "example \"2.5 h\" or \"150 min\""},
        Refusal{"2 h 30 min",
                "'2 h 30 min': unexpected '30 min'; a quantity is one number with one unit, for example "
                "\"2.5 h\" or \"150 min\""},
        Refusal{"2 h 15 min",
                "'2 h 15 min': unexpected '15 min'; a quantity is one number with one unit, for example "
                "\"2.5 h\" or \"150 min\""},
        Refusal{"15:30", "'15:30': a time is one number with one unit: for 15:30 write \"15.5 h\""},
        Refusal{"2 104 rpm", "'2 104 rpm': unexpected '104 rpm'; a number is written without spaces"},
        Refusal{"2 304 rpm", "'2 304 rpm': unexpected '304 rpm'; a number is written without spaces"},
        Refusal{"8 m^-2147483648", "'8 m^-2147483648': an exponent is 1 to 6 or -6 to -1"},
        Refusal{"8 m?", "'8 m?': unexpected '?'"}, Refusal{"nan mm", "'nan mm': a finite number is due"},
        Refusal{"inf", "'inf': a finite number is due"}, Refusal{"1e999 m", "'1e999 m': beyond what a double holds"},
        Refusal{"70,5 kg", "'70,5 kg': decimals follow a point: \"70.5 kg\""},
        Refusal{"0,500 kg", "'0,500 kg': decimals follow a point: \"0.500 kg\""},
        Refusal{"18,000 rpm",
                "'18,000 rpm': nothing sets thousands apart, and decimals follow a point: \"18000 rpm\" or "
                "\"18.000 rpm\""},
        Refusal{"1,234,567 mm",
                "'1,234,567 mm': nothing sets thousands apart, and decimals follow a point: \"1234567 mm\""},
        Refusal{"18,000.5 rpm",
                "'18,000.5 rpm': nothing sets thousands apart, and decimals follow a point: "
                "\"18000.5 rpm\""},
        Refusal{"22 C", "'22 C': unknown unit 'C'; did you mean 'degC'?"},
        Refusal{"45\u2009kg", "'45\u2009kg' holds a thin space, U+2009; plain spaces alone are due"},
        Refusal{"45\u200b kg", "'45\u200b kg' holds a zero-width space, U+200B; plain spaces alone are due"},
        Refusal{"\ufeff45 kg", "'\ufeff45 kg' holds a byte order mark, U+FEFF; plain spaces alone are due"},
        Refusal{"45\tkg", "'45\tkg' holds a tab; plain spaces alone are due"},
        Refusal{"", "'': a number with a unit is due, for example \"600 mm\""},
        Refusal{"mm", "'mm': a number with a unit is due, for example \"600 mm\""}));

std::string refusal(std::string const& text, Dimension expected) {
  try {
    parse_value(text, expected);
  } catch (InputError const& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ParseValue, OffersWhatIsUsualForTheDimension) {
  EXPECT_EQ(refusal("10 mn", dimension::time), "'10 mn': unknown unit 'mn'; did you mean 'min'?");
  EXPECT_EQ(refusal("10 mn", dimension::length), "'10 mn': unknown unit 'mn'; did you mean 'mm'?");
  EXPECT_EQ(refusal("abc", dimension::dimensionless), "'abc': a number is due, for example \"0.8\"");
  EXPECT_EQ(refusal("abc", dimension::angle), "'abc': an angle is due, for example \"15 deg\"");
  EXPECT_EQ(refusal("abc", dimension::mass), "'abc': a number with a unit is due, for example \"14 kg\"");
}

TEST(ParseValue, ReturnsSI) { EXPECT_DOUBLE_EQ(parse_value("9 W/K", dimension::conductance), 9.0); }

TEST(ParseValue, AsksForTheUnitOfABareNumber) {
  EXPECT_EQ(refusal("600", dimension::length), "600 has no unit; write for example \"600 mm\"");
}

TEST(ParseValue, NamesBothDimensions) {
  EXPECT_EQ(refusal("5 W", dimension::conductance), "'5 W' is a power; a conductance is due, for example \"9 W/K\"");
  EXPECT_EQ(refusal("5 um", dimension::tilt), "'5 um' is a length; an angle is due, for example \"15 urad\"");
  EXPECT_EQ(refusal("5 um", dimension::dimensionless), "'5 um' is a length; a number is due, for example \"0.8\"");
  EXPECT_EQ(refusal("5 kg m3", dimension::length),
            "'5 kg m3' is a quantity in m^3 kg; a length is due, for example \"600 mm\"");
}

TEST(ParseValue, SaysThatAMillikelvinIsNoMetreAndKelvin) {
  EXPECT_DOUBLE_EQ(parse_value("9 W/mK", dimension::conductance), 9000.0);
  for (std::string const text : {"42 W/mK", "42 W/(mK)"})
    EXPECT_EQ(refusal(text, dimension::conductivity),
              "'" + text + "' is a conductance; a " + name_of(dimension::conductivity) + " is due, for example \"" +
                  example_of(dimension::conductivity) +
                  "\"; mK is a millikelvin: per metre and kelvin is \"42 W/(m K)\"");
}

TEST(ParseValue, RefusesAPointOnTheScaleForADifference) {
  EXPECT_EQ(refusal("5 degC", dimension::temperature_difference),
            "'5 degC' is a point on the temperature scale; a difference is due, for example \"0.2 K\"");
}

TEST(ParseTemperature, TakesCelsiusAndKelvin) {
  EXPECT_DOUBLE_EQ(parse_temperature("22 degC"), 295.15);
  EXPECT_DOUBLE_EQ(parse_temperature("295.15 K"), 295.15);
}

TEST(ParseTemperature, RefusesWhatIsNone) {
  EXPECT_THROW(parse_temperature("22"), InputError);
  EXPECT_THROW(parse_temperature("22 W"), InputError);
  EXPECT_THROW(parse_temperature("-274 degC"), InputError);
  EXPECT_NO_THROW(parse_temperature("-273.15 degC"));
}

TEST(Conversion, GoesBothWays) {
  EXPECT_DOUBLE_EQ(to_unit(6e-4, "um"), 600.0);
  EXPECT_DOUBLE_EQ(to_unit(293.15, "degC"), 20.0);
  EXPECT_DOUBLE_EQ(to_unit(200.0 * pi, "rpm"), 6000.0);
  EXPECT_DOUBLE_EQ(from_unit(20.0, "degC"), 293.15);
  EXPECT_DOUBLE_EQ(from_unit(to_unit(0.37, "mm/min"), "mm/min"), 0.37);
}

TEST(WithoutRounding, TakesOffWhatArithmeticLeaves) {
  EXPECT_EQ(without_rounding(2033 * 0.01), 20.33);
  EXPECT_EQ(without_rounding(3 * 0.1), 0.3);
  EXPECT_EQ(without_rounding(-3 * 0.1), -0.3);
  EXPECT_EQ(without_rounding(293.55 - 273.15, 273.15), 20.4);
  EXPECT_EQ(without_rounding(100.3 - 100.2, 100.3), 0.1);
  EXPECT_EQ(without_rounding(1.2 - 1.1 - 0.1, 1.2), 0.0);
  EXPECT_EQ(without_rounding(1e-12 * 1234.5e3), 1.2345e-6);
}

TEST(WithoutRounding, LeavesEveryOtherNumber) {
  for (double const x : {0.0, 1.0 / 3.0, std::numbers::pi * 1e-9, 0.1 + 1e-15, 22.0 / 7e6, 5e-324, 1e308,
                         std::numeric_limits<double>::infinity()})
    EXPECT_EQ(without_rounding(x), x);
  EXPECT_TRUE(std::isnan(without_rounding(std::nan(""))));
  EXPECT_TRUE(std::isnan(without_rounding(std::nan(""), 1.0)));
}

TEST(UnitOf, IsWhatMessagesName) {
  EXPECT_EQ(unit_of(dimension::conductance), "W/K");
  EXPECT_EQ(unit_of(dimension::angular_speed), "rad/s");
  EXPECT_EQ(unit_of(Dimension{2, 0, 1, 0, 0}), "m^2 s");
}

TEST(UnitOf, ParsesBackToItsDimension) {
  std::vector<Dimension> const known = {
      dimension::length,       dimension::area,          dimension::volume,        dimension::mass,
      dimension::time,         dimension::angular_speed, dimension::speed,         dimension::density,
      dimension::force,        dimension::torque,        dimension::power,         dimension::stiffness,
      dimension::pressure,     dimension::viscosity,     dimension::volume_flow,   dimension::mass_flow,
      dimension::expansion,    dimension::conductance,   dimension::conductivity,  dimension::film_coefficient,
      dimension::heat_flux,    dimension::heat_density,  dimension::heat_capacity, dimension::specific_heat,
      dimension::latent_heat,  dimension::current,       dimension::voltage,       dimension::resistance,
      dimension::acceleration, dimension::curvature,     Dimension{2, 0, 1, 0, 0}, dimension::torque_constant};
  for (Dimension const& d : known) {
    EXPECT_EQ(dimension_of(unit_of(d)), d) << unit_of(d);
    EXPECT_EQ(parse_quantity(example_of(d)).dimension, d) << example_of(d);
    EXPECT_EQ(parse_quantity("1 " + unit_of(d)).value, 1.0) << unit_of(d);
  }
}

TEST(FormatQuantity, ReadsWell) {
  EXPECT_EQ(format_quantity(0.6, dimension::length), "600 mm");
  EXPECT_EQ(format_quantity(3e-6, dimension::length), "3 um");
  EXPECT_EQ(format_quantity(8.0 / 60.0, dimension::speed), "8000 mm/min");
  EXPECT_EQ(format_quantity(parse_quantity("4500 rpm").value, dimension::angular_speed), "4500 rpm");
  EXPECT_EQ(format_quantity(14400.0, dimension::time), "4 h");
  EXPECT_EQ(format_quantity(0.8, dimension::dimensionless), "0.8");
  EXPECT_EQ(format_quantity(1.2e9, dimension::stiffness), "1.2 kN/um");
  EXPECT_EQ(format_quantity(0.0, dimension::length), "0 mm");
  EXPECT_EQ(format_temperature(295.15), "22 degC");
}

TEST(FormatQuantity, ParsesBackToTheSameDouble) {
  std::vector<Dimension> const all = {dimension::length,        dimension::angular_speed,    dimension::speed,
                                      dimension::volume_flow,   dimension::temperature_rate, dimension::expansion,
                                      dimension::pressure,      dimension::dimensionless,    dimension::mass,
                                      dimension::heat_capacity, dimension::conductance,      Dimension{2, 0, 1, 0, 0}};
  for (Dimension const& d : all) {
    double value = 1e-9;
    for (int i = 0; i < 200; ++i, value *= -1.37) {
      EXPECT_EQ(parse_value(format_quantity(value, d), d), value) << format_quantity(value, d);
    }
  }
  for (double kelvin = 250.0; kelvin < 350.0; kelvin += 0.137) {
    EXPECT_EQ(parse_temperature(format_temperature(kelvin)), kelvin) << format_temperature(kelvin);
  }
}

}  // namespace
}  // namespace thermotwin::thermal
