#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/refusal.h"
#include "tests/twin/effect_bench.h"

/// What no part of a machine can have: numbers by which others are divided, shares of more than the whole, and keys
/// that contradict one another.
namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using thermotwin::tests::refusal;

std::string refused(Snippet const& snippet, Changes const& changes) {
  return refusal([&] { static_cast<void>(Machine::build(bench(snippet, changes))); });
}

/// One number of a snippet, and what is said of it.
struct Impossible {
  std::string effect, snippet, key, text, message;
};

void PrintTo(Impossible const& number, std::ostream* out) { *out << number.effect << "." << number.key; }

class ImpossibleNumber : public testing::TestWithParam<Impossible> {};

TEST_P(ImpossibleNumber, IsRefusedByItsKey) {
  auto const& number = GetParam();
  auto const& part = snippet(number.effect, number.snippet);
  EXPECT_THAT(refused(part, {{number.key, number.text}}),
              AllOf(HasSubstr("'" + number.key + "' is "), HasSubstr(number.message)));
}

constexpr char const* positive_is_due = "it must be positive";
constexpr char const* one_is_most = "it must be at most 1 (plausible: ";

INSTANTIATE_TEST_SUITE_P(
    Zero, ImpossibleNumber,
    testing::Values(Impossible{"air_gap", "vertical", "width", "0 mm", positive_is_due},
                    Impossible{"air_gap", "vertical", "height", "0 mm", positive_is_due},
                    Impossible{"annular_gap", "taylor", "gap", "0 mm", positive_is_due},
                    Impossible{"ball_conductance", "schaefer", "pitch_diameter", "0 mm", positive_is_due},
                    Impossible{"ball_nut", "plain", "efficiency", "0", positive_is_due},
                    Impossible{"ball_nut", "plain", "nut_length", "0 mm", positive_is_due},
                    Impossible{"ball_nut", "plain", "reference_speed", "0 rpm", positive_is_due},
                    Impossible{"bearing", "plain", "count", "0", positive_is_due},
                    Impossible{"bearing", "plain", "pitch_diameter", "0 mm", positive_is_due},
                    Impossible{"chiller", "inverter", "gain", "0 W/K", positive_is_due},
                    Impossible{"copper_loss", "plain", "torque_constant", "0 N m/A", positive_is_due},
                    Impossible{"feed_motor", "plain", "reference_speed", "0 rpm", positive_is_due},
                    Impossible{"film", "plate_facing_up", "height", "0 mm", positive_is_due},
                    Impossible{"film", "rotating_cylinder", "diameter", "0 mm", positive_is_due},
                    Impossible{"film", "rotating_disc", "diameter", "0 mm", positive_is_due},
                    Impossible{"film", "vertical_plate", "height", "0 mm", positive_is_due},
                    Impossible{"grease_run_in", "plain", "decay_time", "0 min", positive_is_due},
                    Impossible{"guide", "sliding", "reference_feed", "0 m/s", positive_is_due},
                    Impossible{"held_shaft", "plain", "front_stiffness", "0 N/um", positive_is_due},
                    Impossible{"held_shaft", "plain", "housing_area", "0 mm2", positive_is_due},
                    Impossible{"jacket", "straight", "flow", "0 L/min", positive_is_due},
                    Impossible{"motor_load", "plain", "efficiency", "0", positive_is_due},
                    Impossible{"motor_loss", "weakened", "base_speed_ratio", "0", positive_is_due},
                    Impossible{"rolling_contact", "bearing", "element_diameter", "0 mm", positive_is_due},
                    Impossible{"rotor_windage", "gap", "gap", "0 mm", positive_is_due},
                    Impossible{"skf_bearing", "plain", "bore", "0 mm", positive_is_due},
                    Impossible{"skf_bearing", "plain", "outer_diameter", "30 mm",
                               "it must be more than the bore, 30 mm"},
                    Impossible{"support_bearing", "plain", "reference_speed", "0 rpm", positive_is_due}));

INSTANTIATE_TEST_SUITE_P(MoreThanTheWhole, ImpossibleNumber,
                         testing::Values(Impossible{"ball_nut", "plain", "efficiency", "2", one_is_most},
                                         Impossible{"ball_nut", "plain", "nut_share", "1.1", one_is_most},
                                         Impossible{"ball_nut", "plain", "viscous_share", "1.1", one_is_most},
                                         Impossible{"bearing", "plain", "inner_share", "1.01", one_is_most},
                                         Impossible{"copper_loss", "plain", "slot_share", "1.1", one_is_most},
                                         Impossible{"evaporation", "plain", "humidity", "50", one_is_most},
                                         Impossible{"film", "room", "emissivity", "2", one_is_most},
                                         Impossible{"guide", "rolling", "rail_share", "1.1", one_is_most},
                                         Impossible{"hot_neighbour", "constant", "view", "1.5", one_is_most},
                                         Impossible{"motor_load", "plain", "efficiency", "93", one_is_most},
                                         Impossible{"nut_reversal", "axis", "nut_share", "1.1", one_is_most},
                                         Impossible{"preload", "plain", "inner_share", "1.1", one_is_most},
                                         Impossible{"radiation", "bodies", "emissivity", "1.2", one_is_most},
                                         Impossible{"radiation", "bodies", "view", "2", one_is_most},
                                         Impossible{"rolling_contact", "bearing", "first_share", "1.1", one_is_most},
                                         Impossible{"seal", "torque", "shaft_share", "1.1", one_is_most},
                                         Impossible{"skf_bearing", "plain", "inner_share", "1.1", one_is_most}));

/// A derivative goes a step beyond what is stated.
TEST(LimitOfANumber, LetsADerivativePass) {
  EXPECT_EQ(refused(snippet("radiation", "bodies"), {{"emissivity", "1.001"}}), "accepted");
  EXPECT_EQ(refused(snippet("rotor_windage", "known"), {{"rotor_share", "0.5005"}}), "accepted");
}

TEST(Shares, AreNotMoreThanTheWholeTogether) {
  EXPECT_THAT(refused(snippet("belt"), {{"pulley_share", "0.8"}, {"motor_share", "0.5"}}),
              HasSubstr("'pulley_share' 0.8 and 'motor_share' 0.5 are 1.3 of the heat; allowed is 1 in all"));
  EXPECT_THAT(refused(snippet("rotor_windage", "known"), {{"rotor_share", "1"}}),
              HasSubstr("'rotor_share' 1 and 'stator_share' 0.5 are 1.5 of the heat"));
  EXPECT_EQ(refused(snippet("rotor_windage", "disc"), {{"rotor_share", "1"}}), "accepted") << "without a stator";
  EXPECT_THAT(refused(snippet("cutting_heat", "power"), {{"workpiece_share", "0.9"}}),
              HasSubstr("'tool_share' 0.06 and 'workpiece_share' 0.9 and 'chips_share' 0.1 are 1.06 of the heat"));
  EXPECT_EQ(refused(snippet("cutting_heat", "removal"), {{"workpiece_share", "1"}}), "accepted") << "without its place";
}

/// Two keys of which one would win.
struct Contradiction {
  std::string effect, snippet, key, text, other;
};

void PrintTo(Contradiction const& keys, std::ostream* out) { *out << keys.effect << "." << keys.key; }

class ContradictoryKeys : public testing::TestWithParam<Contradiction> {};

TEST_P(ContradictoryKeys, AreRefused) {
  auto const& keys = GetParam();
  EXPECT_THAT(refused(snippet(keys.effect, keys.snippet), {{keys.key, keys.text}}),
              HasSubstr("give either '" + keys.other + "' or '" + keys.key + "', not both"));
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, ContradictoryKeys,
    testing::Values(Contradiction{"chiller", "relay", "follows", "ambient.temperature", "temperature"},
                    Contradiction{"chiller", "relay", "offset", "1 K", "temperature"},
                    Contradiction{"cutting_heat", "power", "specific_force", "2 GPa", "power"},
                    Contradiction{"cutting_heat", "power", "removal_rate", "1 cm3/s", "power"},
                    Contradiction{"flood_coolant", "tank", "follows", "coolant.temperature", "from"},
                    Contradiction{"foundation", "constant", "follows", "ambient.temperature", "temperature"},
                    Contradiction{"foundation", "constant", "offset", "-4 K", "temperature"},
                    Contradiction{"hot_neighbour", "constant", "offset", "20 K", "temperature"},
                    Contradiction{"jacket", "helix", "follows", "ambient.temperature", "temperature"},
                    Contradiction{"jacket", "straight", "temperature", "18 degC", "from"},
                    Contradiction{"joint", "conductance", "coefficient", "800 W/(m2 K)", "conductance"},
                    Contradiction{"joint", "conductance", "area", "0.02 m2", "conductance"},
                    Contradiction{"purge_air", "constant", "follows", "ambient.temperature", "temperature"},
                    Contradiction{"purge_air", "constant", "offset", "-1 K", "temperature"},
                    Contradiction{"seal", "torque", "diameter", "80 mm", "torque"}));

TEST(Film, RefusesASizeThatItsCorrelationDoesNotTake) {
  EXPECT_THAT(refused(snippet("film", "constant"), {{"diameter", "40 mm"}}),
              HasSubstr("'diameter' does nothing with correlation = \"constant\""));
  EXPECT_THAT(refused(snippet("film", "rotating_cylinder"), {{"height", "40 mm"}}),
              HasSubstr("'height' does nothing with correlation = \"rotating_cylinder\""));
}

/// What is refused is no part of what is plausible.
TEST(PlausibleRange, LeavesOutWhatIsRefused) {
  for (auto const& field : effect("film").parameters)
    if (field.key == "diameter") {
      EXPECT_EQ(field.range, "above 0 mm to 10 m");
    }
}

TEST(BallNut, IsNotLongerThanItsScrew) {
  EXPECT_THAT(refused(snippet("ball_nut"), {{"nut_length", "310 mm"}}),
              HasSubstr("'nut_length' is \"310 mm\"; its screw 'shaft' is 300 mm long"));
  EXPECT_EQ(refused(snippet("ball_nut"), {{"nut_length", "300 mm"}}), "accepted");
}

TEST(BallScrew, HasEachPositionOnce) {
  for (std::string const again : {"250 mm", "250.00001 mm"}) {
    Value document = bench(snippet("heat"));
    auto& positions = std::get<Value::List>(
        std::get<Value::List>(document.find("ball_screw")->content)[0].find("positions")->content);
    positions.push_back({{"bench.toml", 52, 34}, again});
    EXPECT_THAT(refusal([&] { static_cast<void>(Machine::build(document)); }),
                HasSubstr("bench.toml:52:34: 'positions' has two for which the channel is 'E_P_250mm'"));
  }
}

}  // namespace
}  // namespace thermotwin::twin
