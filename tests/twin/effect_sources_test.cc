#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <string>

#include "tests/scenarios/refusal.h"
#include "tests/twin/effect_bench.h"
#include "thermal/ball_bearing.h"
#include "thermal/evaluation.h"
#include "thermal/lubricant.h"
#include "thermal/motor_loss.h"
#include "thermal/preload.h"
#include "thermal/rolling_contact.h"
#include "thermal/skf_friction.h"
#include "thermal/windage.h"

/// What the sources of the catalogue show in data: power of speed, sign, what happens at stop (physics.md 7).
namespace thermotwin::twin {
namespace {

constexpr double full_speed = 628.3185307179586;

double heat_at_speed(Snippet const& effect, double speed, Changes const& changes = {}) {
  return total_heat(effect, {{"spindle.speed", speed}}, changes);
}

double power_of_speed(Snippet const& effect, double low, double high) {
  return std::log(heat_at_speed(effect, high) / heat_at_speed(effect, low)) / std::log(high / low);
}

/// All nodes at one temperature but the lump `a`.
double heat_with(Snippet const& effect, double others, double a, Inputs const& inputs = {},
                 Changes const& changes = {}) {
  Machine const machine = Machine::build(bench(effect, changes));
  auto temperatures = uniform_temperatures(machine, others);
  temperatures[std::size_t(machine.network().range("a").first)] = a;
  auto const heat = heat_of(effect, machine, temperatures, inputs);
  return std::accumulate(heat.begin(), heat.end(), 0.0);
}

TEST(Seal, IsExactlyLinearInSpeedAndKnowsNoTemperature) {
  for (auto const& variant : {"lip", "bearing", "torque"}) {
    auto const& seal = snippet("seal", variant);
    EXPECT_NEAR(power_of_speed(seal, 20.0, 600.0), 1.0, 1e-12);
    EXPECT_DOUBLE_EQ(heat_with(seal, 290.0, 290.0), heat_with(seal, 330.0, 310.0));
    EXPECT_EQ(heat_at_speed(seal, 0.0), 0.0);
  }
  EXPECT_NEAR(heat_at_speed(snippet("seal", "torque"), 400.0), 40.0, 1e-12);
  EXPECT_NEAR(heat_at_speed(snippet("seal", "lip"), 1.0), 0.45, 0.01);  // physics.md 1.6
}

TEST(Seal, SharesItsHeat) {
  Machine const machine = Machine::build(bench(snippet("seal", "torque"), {{"shaft_share", "0.7"}}));
  auto const heat = heat_of(snippet("seal", "torque"), machine, bench_temperatures(machine));
  EXPECT_NEAR(heat[std::size_t(machine.network().range("a").first)], 0.3 * 40.0, 1e-9);
}

TEST(Bearing, LosesHeatAsItsOilWarmsUnlessTheFeedbackIsOff) {
  auto const& bearing = snippet("bearing", "other oil");
  double const cold = heat_with(bearing, 293.15, 293.15), warm = heat_with(bearing, 313.15, 313.15);
  EXPECT_LT(warm, 0.8 * cold);
  Changes const without = {{"viscosity_temperature", "0 K"}};
  EXPECT_NEAR(heat_with(bearing, 293.15, 293.15, {}, without), warm, 1e-6 * warm);
  EXPECT_NEAR(heat_with(bearing, 313.15, 313.15, {}, without), warm, 1e-6 * warm);
}

/// Without a load the torque is viscous, M ∝ (νω)^p: its heat has the power p + 1 of the speed and p of the viscosity,
/// and at 40 degC and full speed it is what it was.
TEST(Bearing, DragsWithTheViscousExponentThatItStates) {
  auto const& bearing = snippet("bearing", "other oil");
  constexpr double cold = 293.15, warm = 313.15;
  auto const heat = [&](double speed, double temperature, Changes changes) {
    changes.push_back({"torque_load", "0 N"});
    return heat_with(bearing, temperature, temperature, {{"spindle.speed", speed}}, changes);
  };
  Changes const flat = {{"viscous_exponent", "0.4"}};
  EXPECT_NEAR(std::log2(heat(500.0, cold, flat) / heat(250.0, cold, flat)), 1.4, 1e-9);
  EXPECT_NEAR(heat(full_speed, warm, flat), heat(full_speed, warm, {}), 1e-9 * heat(full_speed, warm, {}));
  EXPECT_NEAR(heat(-300.0, warm, flat), heat(300.0, warm, flat), 1e-9);
  auto const fall = [&](Changes const& changes) {
    return std::log(heat(500.0, cold, changes) / heat(500.0, warm, changes));
  };
  EXPECT_NEAR(fall(flat), 0.4 / (2.0 / 3.0) * fall({}), 1e-9);
}

TEST(RotorWindage, GrowsWithTheThirdPowerOfSpeed) {
  EXPECT_NEAR(power_of_speed(snippet("rotor_windage", "known"), 100.0, 600.0), 3.0, 1e-12);
  EXPECT_NEAR(heat_at_speed(snippet("rotor_windage", "known"), 4500.0 / 6000.0 * full_speed), 15.0, 1e-9);
  EXPECT_NEAR(power_of_speed(snippet("rotor_windage", "gap"), 300.0, 600.0), 2.7, 0.05);
  EXPECT_NEAR(power_of_speed(snippet("rotor_windage", "disc"), 50.0, 100.0), 2.5, 0.01);
  EXPECT_NEAR(power_of_speed(snippet("rotor_windage", "disc"), 450.0, 600.0), 2.8, 0.02);
  for (auto const& variant : {"known", "gap", "disc"})
    EXPECT_EQ(heat_at_speed(snippet("rotor_windage", variant), 0.0), 0.0);
}

TEST(RotorWindage, GivesTheNumbersOfTheGapAndTheChuck) {  // physics.md 1.7, 1.12
  EXPECT_NEAR(heat_at_speed(snippet("rotor_windage", "gap"), full_speed), 18.0, 1.5);
  EXPECT_NEAR(2.0 * heat_at_speed(snippet("rotor_windage", "disc"), 0.75 * full_speed), 20.0, 2.0);
}

TEST(RotorWindage, LeavesTheStatorsShareToTheAirWithoutOne) {
  auto const& disc = snippet("rotor_windage", "disc");
  EXPECT_NEAR(heat_at_speed(disc, 400.0, {{"rotor_share", "0.25"}}), 0.5 * heat_at_speed(disc, 400.0), 1e-9);
}

TEST(Preload, MakesMoreHeatAsTheInnerRingGetsHotter) {
  auto const& effect = snippet("preload", "deflection");
  auto const heat = [&](double difference) { return heat_with(effect, 293.15 + difference, 293.15); };
  EXPECT_NEAR(heat(0.0), 0.0, 0.35);  // centrifugal growth alone
  double last = heat(0.0);
  for (double const difference : {1.0, 2.0, 5.0, 10.0}) {
    EXPECT_GT(heat(difference), last);
    last = heat(difference);
  }
  EXPECT_LT(heat(-3.0), 0.0);
}

/// 7014C, 300 N: 2, 5, 10 K give 1.5, 2.4, 4.1 times the preload, counted with the radial term alone (physics.md 1.4).
TEST(Preload, FollowsTheLoadOfTheContacts) {
  auto const& effect = snippet("preload", "deflection");
  double const difference = 5.0;
  thermal::BallBearing const bearing{20, 12.3e-3, 90e-3, 15.0 * M_PI / 180.0};
  thermal::PairGrowth<double> growth;
  growth.inner = difference;
  growth.ball = 0.5 * difference;
  double const approach =
      thermal::normal_approach<double>(bearing, thermal::PairArrangement::face_to_face, 12.1e-6, growth);
  double const expected = 0.02 * (std::pow(1.0 + approach / 3e-6, 1.5 * 1.38) - 1.0) * 10.0;
  EXPECT_NEAR(heat_with(effect, 293.15 + difference, 293.15, {{"spindle.speed", 10.0}}), expected, 1e-4);
}

TEST(Preload, LosesItsOwnTorqueAtMost) {
  auto const& effect = snippet("preload", "deflection");
  EXPECT_NEAR(heat_with(effect, 293.15, 333.15), -0.02 * bench_input("spindle.speed"), 1e-9);
  EXPECT_EQ(heat_with(effect, 313.15, 293.15, {{"spindle.speed", 0.0}}), 0.0);
}

TEST(Preload, OfABackToBackPairFallsWhenTheShaftBetweenGrows) {
  auto const& effect = snippet("preload", "plain");
  Machine const machine = Machine::build(bench(effect, {{"span", "600 mm"}}));
  Machine const other = Machine::build(bench(effect, {{"span", "600 mm"}, {"arrangement", "face_to_face"}}));
  auto temperatures = uniform_temperatures(machine, 293.15);
  auto const total = [&](Machine const& m) {
    auto const heat = heat_of(effect, m, temperatures);
    return std::accumulate(heat.begin(), heat.end(), 0.0);
  };
  double const cold = total(machine);
  auto const& shaft = machine.network().range("shaft");
  for (int i = shaft.first + 2; i < shaft.first + shaft.count; ++i) temperatures[std::size_t(i)] += 5.0;
  EXPECT_LT(total(machine), cold);
  EXPECT_GT(total(other), cold);
}

TEST(NutPreload, RisesWithAHotScrewAndFallsWithAHotNut) {
  auto const& effect = snippet("nut_preload");
  EXPECT_GT(heat_with(effect, 298.15, 293.15), 0.0);
  EXPECT_LT(heat_with(effect, 293.15, 298.15), 0.0);
  EXPECT_EQ(heat_with(effect, 298.15, 293.15, {{"z.speed", 0.0}}), 0.0);
  EXPECT_NEAR(heat_with(effect, 293.15, 293.15), 0.0, 1e-9);
}

TEST(GreaseRunIn, DecaysWithTheTimeOfRunningAndWithTheTurns) {
  auto const& effect = snippet("grease_run_in");
  Inputs const start = {{"spindle.time_running", 0.0}, {"spindle.revolutions", 0.0}, {"spindle.speed", 300.0}};
  Inputs const later = {{"spindle.time_running", 5400.0}, {"spindle.revolutions", 0.0}, {"spindle.speed", 300.0}};
  Inputs const turned = {{"spindle.time_running", 0.0}, {"spindle.revolutions", 1e5}, {"spindle.speed", 300.0}};
  EXPECT_NEAR(total_heat(effect, later) / total_heat(effect, start), std::exp(-1.0), 1e-12);
  EXPECT_NEAR(total_heat(effect, turned) / total_heat(effect, start), std::exp(-1.0), 1e-12);
  EXPECT_NEAR(power_of_speed(effect, 100.0, 600.0), 5.0 / 3.0, 1e-12);
  EXPECT_EQ(heat_at_speed(effect, 0.0), 0.0);
}

TEST(CopperLoss, IsThereAtStandstillAndGrowsAsTheWindingWarms) {
  auto const& effect = snippet("copper_loss");
  Inputs const idle = {{"spindle.running", 0.0}, {"spindle.speed", 0.0}};
  double const current = 3.0 * 0.5 * 36.0 * 1.15;
  EXPECT_NEAR(heat_with(effect, 293.15, 293.15, idle), current, 1e-9);
  EXPECT_NEAR(heat_with(effect, 393.15, 393.15, idle), 1.39 * current, 1e-9);
  EXPECT_EQ(heat_with(effect, 293.15, 293.15, {{"servo.on", 0.0}}), 0.0);
  double const loaded = heat_with(effect, 293.15, 293.15);
  EXPECT_NEAR(loaded / current, 1.0 + std::pow(10.0 / 1.4 / 6.0, 2), 1e-9);
}

TEST(MotorLoad, LosesWhatTheEfficiencySays) {
  auto const& effect = snippet("motor_load");
  Machine const machine = Machine::build(bench(effect));
  auto const heat = heat_of(effect, machine, bench_temperatures(machine));
  EXPECT_NEAR(std::accumulate(heat.begin(), heat.end(), 0.0), 3000.0 * (1.0 / 0.9 - 1.0), 1e-9);
  EXPECT_NEAR(heat[std::size_t(machine.network().range("b").first)], 0.03 / 0.97 * 3000.0, 1e-9);
  EXPECT_THROW((void)Machine::build(bench(effect, {{"slip", "0.2"}})), FileError);
}

TEST(MotorLoss, FallsAboveTheBaseSpeed) {
  auto const& effect = snippet("motor_loss", "weakened");
  EXPECT_GT(heat_at_speed(effect, 0.28 * full_speed), heat_at_speed(effect, 0.15 * full_speed));
  EXPECT_LT(heat_at_speed(effect, full_speed), heat_at_speed(effect, 0.4 * full_speed));
  EXPECT_NEAR(heat_at_speed(effect, full_speed), thermal::iron_loss_with_field_weakening<double>(25.0, 30.0, 1.0, 0.3),
              1e-3);
}

TEST(MotorLoss, NeedsARatedSpeedWhereNoSpindleTurns) {
  auto const message = [](std::string const& more) {
    return thermotwin::tests::refusal([&] {
      (void)Machine::build(
          parse_toml("name = \"axis\"\n[[lump]]\nname = \"a\"\nheat_capacity = \"1 kJ/K\"\n"
                     "[[film]]\nname = \"a\"\non = \"a\"\narea = \"1 m2\"\n"
                     "[[motor_loss]]\nname = \"drive\"\nat = \"a\"\neddy = \"30 W\"\n" +
                         more,
                     "axis.toml"));
    });
  };
  EXPECT_EQ(message(""), "accepted");
  EXPECT_THAT(message("while_on = \"machine.on\"\n"),
              testing::HasSubstr("what follows 'machine.on' needs a rated_speed: the machine has no spindle"));
  EXPECT_EQ(message("while_on = \"machine.on\"\nrated_speed = \"3000 rpm\"\n"), "accepted");
}

TEST(LossCurve, IsLinearBetweenItsPointsAndConstantBeyond) {
  auto const& effect = snippet("loss_curve");
  double const rpm = M_PI / 30.0;
  EXPECT_NEAR(heat_at_speed(effect, 0.0), 1.1 * 20.0, 1e-9);
  EXPECT_NEAR(heat_at_speed(effect, 750.0 * rpm), 1.1 * 70.0, 1e-9);
  EXPECT_NEAR(heat_at_speed(effect, 1500.0 * rpm), 1.1 * 120.0, 1e-9);
  EXPECT_NEAR(heat_at_speed(effect, 3750.0 * rpm), 1.1 * 95.0, 1e-9);
  EXPECT_NEAR(heat_at_speed(effect, 9000.0 * rpm), 1.1 * 70.0, 1e-9);
}

TEST(SkfBearing, IsTheTorqueOfTheCatalogue) {
  auto const& effect = snippet("skf_bearing");
  thermal::SkfBearing bearing;
  bearing.bore = 0.03;
  bearing.outer_diameter = 0.062;
  auto const oil = thermal::mineral_oil_viscosity(32);
  double const viscosity = thermal::vogel_cameron_viscosity<double>(oil.scale, oil.temperature, 303.15);
  double const torque = thermal::skf_torque<double>(bearing, 200.0, 2000.0, viscosity, 100.0);
  EXPECT_NEAR(heat_with(effect, 303.15, 303.15), 100.0 * torque, 1e-6);
  EXPECT_EQ(heat_with(effect, 303.15, 303.15, {{"z.speed", 0.0}}), 0.0);
}

TEST(RollingContact, GrowsWithSpeedToTheOnePointFiveAndFallsAsTheOilWarms) {
  for (auto const& s : snippets()) {
    if (s.effect != "rolling_contact") continue;
    auto const at = [&](double speed) -> Inputs {
      if (s.name == "bearing") return {{"spindle.speed", speed}};
      if (s.name.starts_with("guide")) return {{"z.feed", speed}};
      return {{"z.speed", speed}, {"z.moving_speed", speed}};
    };
    double const low = heat_with(s, 293.15, 293.15, at(0.1)), high = heat_with(s, 293.15, 293.15, at(0.4));
    EXPECT_NEAR(std::log2(high / low) / 2.0, 1.54, 0.07) << s.name;
    EXPECT_LT(heat_with(s, 313.15, 313.15), 0.7 * heat_with(s, 293.15, 293.15)) << s.name;
    EXPECT_EQ(heat_with(s, 293.15, 293.15, at(0.0)), 0.0) << s.name;
  }
}

/// As the formula says of all its contacts together, at the mean temperature of its two sides, for the share of the
/// time in motion (physics.md 1.5, (1.10)): but for rounding.
TEST(RollingContact, IsTheFrictionOfItsContacts) {
  thermal::ContactOil const oil{thermal::mineral_oil_viscosity(68), 870.0, true};
  thermal::BallBearing const bearing{20, 12.3e-3, 90e-3, std::numbers::pi / 4.0};
  thermal::BallNut const nut{40e-3, 10e-3, 6e-3, 3.5};
  auto const of_nut = [&](thermal::ContactLaw const& law) {
    return thermal::nut_contact_friction<double>(law, nut, oil, 1500.0);
  };
  auto const of_guide = [&](thermal::ContactLaw const& law) {
    return thermal::ball_guide_contact_friction<double>(law, 200, 3e-3, oil, 5000.0);
  };
  struct Row {
    std::string kind;
    thermal::RollingFriction<double> friction;
    std::string speed;
    double share;
  };
  for (auto const& [kind, friction, speed, share] :
       {Row{"bearing", thermal::bearing_contact_friction<double>(bearing, oil, 300.0), "spindle.speed", 1.0},
        Row{"single_nut", of_nut(thermal::single_nut_law), "z.speed", 1.0},
        Row{"double_nut", of_nut(thermal::double_nut_law), "z.speed", 1.0},
        Row{"guide_two_point", of_guide(thermal::guide_two_point_law), "z.feed", bench_input("z.duty")},
        Row{"guide_four_point", of_guide(thermal::guide_four_point_law), "z.feed", bench_input("z.duty")},
        Row{"guide_roller", thermal::roller_guide_contact_friction<double>(200, 3e-3, 10e-3, oil, 5000.0), "z.feed",
            bench_input("z.duty")}}) {
    double const expected = share * thermal::rolling_friction_heat<double>(friction, bench_input(speed), 308.15);
    EXPECT_NEAR(heat_with(snippet("rolling_contact", kind), 303.15, 313.15), expected, 1e-9 * expected) << kind;
  }
}

/// What moves half of the time has its own torque for half of the time; with the mean speed alone the oil would drag
/// less.
TEST(FeedDrive, HasTheTorqueOfTheSpeedAtWhichItMoves) {
  std::vector<std::pair<std::string, std::string>> const parts = {
      {"ball_nut", "plain"},    {"support_bearing", "plain"},      {"feed_motor", "plain"},
      {"skf_bearing", "plain"}, {"rolling_contact", "double_nut"}, {"gear", "of_an_axis"}};
  for (auto const& [name, of] : parts) {
    auto const& effect = snippet(name, of);
    auto const heat = [&](double mean, double moving) {
      return total_heat(effect, {{"z.speed", mean}, {"z.moving_speed", moving}});
    };
    EXPECT_GT(heat(100.0, 100.0), 0.0) << name;
    EXPECT_NEAR(heat(50.0, 100.0), 0.5 * heat(100.0, 100.0), 1e-9 * heat(100.0, 100.0)) << name;
    EXPECT_GT(heat(50.0, 100.0), (name == "feed_motor" ? 0.5 : 1.05) * heat(50.0, 50.0)) << name;
    EXPECT_EQ(heat(50.0, 0.0), heat(50.0, 50.0)) << name;
    EXPECT_EQ(heat(0.0, 100.0), 0.0) << name;
  }
}

/// A screw that moves half of the time is cooled, and its motor loses, as in the mean of motion and rest, not as at
/// half the speed.
TEST(FeedDrive, IsTheMeanOfMotionAndRest) {
  std::vector<std::pair<std::string, std::string>> const parts = {{"film", "of_a_screw"}, {"loss_curve", "of_an_axis"}};
  for (auto const& [name, of] : parts) {
    auto const& effect = snippet(name, of);
    auto const heat = [&](double mean, double moving) {
      return heat_with(effect, 303.15, 303.15, {{"z.speed", mean}, {"z.moving_speed", moving}});
    };
    EXPECT_NEAR(heat(50.0, 100.0), 0.5 * (heat(100.0, 100.0) + heat(0.0, 0.0)), 1e-9 * std::abs(heat(100.0, 100.0)))
        << name;
    EXPECT_GT(std::abs(heat(50.0, 100.0) / heat(50.0, 50.0) - 1.0), 0.01) << name;
    EXPECT_EQ(heat(0.0, 100.0), heat(0.0, 0.0)) << name;
  }
}

TEST(Gear, ChurnsWithAPowerOfSpeedAndLosesUnderLoad) {
  auto const& effect = snippet("gear");
  Inputs const idle = {{"spindle.running", 0.0}};
  Inputs const fast = {{"spindle.running", 0.0}, {"spindle.speed", 2.0 * bench_input("spindle.speed")}};
  EXPECT_NEAR(total_heat(effect, fast) / total_heat(effect, idle), 4.0, 1e-9);
  EXPECT_NEAR(total_heat(effect) - total_heat(effect, idle), 0.015 * 3000.0, 1e-9);
  EXPECT_EQ(total_heat(effect, {{"spindle.running", 0.0}, {"spindle.speed", 0.0}}), 0.0);
}

TEST(Guide, HeatsTheRailWhereTheCarriageTravels) {
  auto const& effect = snippet("guide", "rolling");
  Changes const short_carriage = {{"carriage_length", "40 mm"}};
  Machine const machine = Machine::build(bench(effect, short_carriage));
  Inputs const near_the_start = {{"z.stroke_from", 0.02}, {"z.stroke_to", 0.07}, {"z.speed", 0.0}};
  thermal::Evaluation evaluation(machine.network());
  std::vector<double> input(std::size_t(machine.network().given_channels()));
  bench_course(machine, near_the_start)
      .evaluate(0.0, {input.data(), std::size_t(machine.network().external_channels())});
  std::vector<double> const state = uniform_temperatures(machine, 293.15);
  std::vector<double> source(std::size_t(machine.network().nodes()));
  evaluation.source_of_nodes(state.data(), input.data(), source);
  auto const& rail = machine.network().range("sleeve");
  EXPECT_GT(source[std::size_t(rail.first)], 1.0);
  EXPECT_EQ(source[std::size_t(rail.first) + 1], 0.0);
  EXPECT_EQ(source[std::size_t(rail.first) + 2], 0.0);
  EXPECT_NEAR(source[std::size_t(rail.first)], source[std::size_t(machine.network().range("a").first)], 1e-9);
}

TEST(Guide, IsLinearInTheFeedWithoutViscousForce) {
  auto const& effect = snippet("guide", "rolling");
  Changes const dry = {{"viscous_force", "0 N"}};
  double const force = 0.003 * 5000.0 + 10.0;
  EXPECT_NEAR(total_heat(effect, {}, dry), force * 0.2 * 0.8, 1e-9);
  EXPECT_NEAR(total_heat(effect, {{"z.feed", 0.4}}, dry), force * 0.4 * 0.8, 1e-9);
  EXPECT_GT(heat_with(effect, 293.15, 293.15), heat_with(effect, 313.15, 313.15));
  EXPECT_EQ(total_heat(effect, {{"z.feed", 0.0}}), 0.0);
}

TEST(Guide, OfASlidewayFollowsStribeck) {
  auto const& effect = snippet("guide", "sliding");
  auto const force = [&](double feed) { return total_heat(effect, {{"z.feed", feed}}) / (0.8 * feed); };
  EXPECT_NEAR(force(0.001), 0.1 * 5000.0, 2.0);
  EXPECT_NEAR(force(0.6), (0.04 + 0.01 * 3.0) * 5000.0, 1.0);
}

TEST(NutReversal, CountsStrokesNotMetres) {
  auto const& effect = snippet("nut_reversal", "axis");
  double const heat = total_heat(effect);
  EXPECT_NEAR(heat, 3.0 * 0.2 * 0.8 / 0.14, 1e-9);
  EXPECT_NEAR(total_heat(effect, {{"z.stroke_to", 0.15}}), 2.0 * heat, 1e-9);
  EXPECT_NEAR(total_heat(snippet("nut_reversal", "stroke")), 3.0 * 0.2 * 0.8 / 0.05, 1e-9);
  EXPECT_EQ(total_heat(effect, {{"z.feed", 0.0}}), 0.0);
}

TEST(HydraulicUnit, PutsItsPowerIntoTankAndConsumers) {
  auto const& effect = snippet("hydraulic_unit");
  Machine const machine = Machine::build(bench(effect));
  auto const heat = heat_of(effect, machine, bench_temperatures(machine));
  EXPECT_NEAR(heat[std::size_t(machine.network().range("a").first)], 40.0, 1e-9);
  EXPECT_NEAR(heat[std::size_t(machine.network().range("tank").first)], 80.0, 1e-9);
  EXPECT_NEAR(total_heat(effect, {{"spindle.speed", 0.0}}), 120.0, 1e-9);
  EXPECT_EQ(total_heat(effect, {{"machine.on", 0.0}}), 0.0);
}

TEST(HydraulicUnit, ThrottlesNoMoreThanItsPumpTakes) {
  auto const& effect = snippet("hydraulic_unit");
  auto const message = [&](Changes const& changes) {
    return thermotwin::tests::refusal([&] { (void)Machine::build(bench(effect, changes)); });
  };
  EXPECT_EQ(message({{"volume_flow", "1.79 L/min"}}), "accepted");  // 119 W of the 120 W
  EXPECT_THAT(message({{"volume_flow", "1.81 L/min"}}),
              testing::HasSubstr("hydraulic_unit 'plain': the consumers throttle more than the pump takes"));
}

TEST(CuttingHeat, SharesThePower) {
  EXPECT_NEAR(total_heat(snippet("cutting_heat", "power")), 0.32 * 2000.0, 1e-9);
  EXPECT_NEAR(total_heat(snippet("cutting_heat", "removal")), 0.06 * 2000.0, 1e-9);
  EXPECT_EQ(total_heat(snippet("cutting_heat", "power"), {{"spindle.running", 0.0}}), 0.0);
}

}  // namespace
}  // namespace thermotwin::twin
