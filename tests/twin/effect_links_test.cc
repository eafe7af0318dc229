#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>
#include <string>

#include "tests/scenarios/refusal.h"
#include "tests/twin/effect_bench.h"
#include "thermal/annular_gap.h"
#include "thermal/ball_conductance.h"
#include "thermal/channel_flow.h"
#include "thermal/contact.h"
#include "thermal/integrate.h"
#include "thermal/lubricant.h"
#include "thermal/natural_convection.h"
#include "thermal/radiation.h"

/// What the films, links and boundaries of the catalogue show in data (physics.md 2 and 7).
namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using thermotwin::tests::refusal;

/// Heat into lump `a` with `a` at one temperature and all others at another [W].
double into_a(Snippet const& effect, double a, double others, Inputs const& inputs = {}, Changes const& changes = {}) {
  Machine const machine = Machine::build(bench(effect, changes));
  auto temperatures = uniform_temperatures(machine, others);
  auto const node = std::size_t(machine.network().range("a").first);
  temperatures[node] = a;
  return heat_of(effect, machine, temperatures, inputs)[node];
}

/// Conductance between `a` and everything else, where all that the effect touches has one temperature [W/K].
double conductance_of_a(Snippet const& effect, double a, double others, Inputs const& inputs = {},
                        Changes const& changes = {}) {
  return into_a(effect, a, others, inputs, changes) / (others - a);
}

double total_at(Snippet const& effect, double temperature, Inputs const& inputs = {}, Changes const& changes = {}) {
  Machine const machine = Machine::build(bench(effect, changes));
  auto const heat = heat_of(effect, machine, uniform_temperatures(machine, temperature), inputs);
  return std::accumulate(heat.begin(), heat.end(), 0.0);
}

/// The room of the bench without its gradient, at 20 °C.
Inputs const still_air = {{"ambient.gradient", 0.0}, {"ambient.floor_temperature", 293.15}};

Inputs with(Inputs inputs, std::string const& channel, double value) {
  inputs.emplace_back(channel, value);
  return inputs;
}

TEST(FanCooling, DoesNothingAtAColdStartAndAtStop) {
  auto const& fan = snippet("fan_cooling");
  EXPECT_EQ(total_at(fan, 293.15, still_air), 0.0);
  EXPECT_EQ(total_at(fan, 313.15, with(still_air, "spindle.speed", 0.0)), 0.0);
  double const rated = 4500.0 * M_PI / 30.0;
  EXPECT_NEAR(total_at(fan, 303.15, with(still_air, "spindle.speed", rated)), -2.0 * 10.0, 1e-9);
  EXPECT_NEAR(total_at(fan, 303.15, with(still_air, "spindle.speed", 0.5 * rated)), -2.0 * 10.0 * std::pow(0.5, 0.8),
              1e-9);
}

TEST(FanCooling, NeedsARatedSpeed) {
  auto const& fan = snippet("fan_cooling");
  EXPECT_THAT(refusal([&] {
                (void)Machine::build(bench(fan, {{"rated_speed", "0 rpm"}}));
              }),
              HasSubstr("'rated_speed' must be above 0"));
  auto const without_spindle = [](std::string const& more) {
    return refusal([&] {
      (void)Machine::build(
          parse_toml("name = \"axis\"\n[[lump]]\nname = \"a\"\nheat_capacity = \"1 kJ/K\"\n"
                     "[[fan_cooling]]\nname = \"pulley\"\nat = \"a\"\nconductance = \"2 W/K\"\n"
                     "speed = \"z.speed\"\n" +
                         more,
                     "axis.toml"));
    });
  };
  EXPECT_THAT(without_spindle(""), HasSubstr("what follows 'z.speed' needs a rated_speed: the machine has no spindle"));
  EXPECT_EQ(without_spindle("rated_speed = \"2400 rpm\"\n"), "accepted");
}

TEST(Draught, BlowsOnlyWhileTheDoorIsOpen) {
  auto const& draught = snippet("draught", "lump");
  EXPECT_NEAR(total_at(draught, 303.15, still_air), -8.0 * 0.3 * 10.0, 1e-9);
  EXPECT_EQ(total_at(draught, 303.15, with(still_air, "ambient.door", 0.0)), 0.0);
  EXPECT_NEAR(total_at(draught, 303.15, with(still_air, "spindle.speed", 0.0)), -24.0, 1e-9);
}

TEST(PurgeAir, TakesOnTheTemperatureOfWhatItPasses) {
  auto const& air = snippet("purge_air", "constant");
  double const capacity_rate = 30e-3 / 60.0 * 1e5 / (287.06 * 293.15) * 1007.0;
  EXPECT_NEAR(total_at(air, 301.15), -10.0 * capacity_rate, 1e-9);
  EXPECT_NEAR(total_at(air, 301.15, {{"spindle.speed", 0.0}}), -10.0 * capacity_rate, 1e-9);
  EXPECT_EQ(total_at(air, 301.15, {{"machine.on", 0.0}}), 0.0);
}

TEST(FloodCoolant, FollowsItsFlagAndItsSupply) {
  auto const& flood = snippet("flood_coolant", "channel");
  EXPECT_NEAR(total_at(flood, 299.5), -500.0 * 0.05 * 10.0, 1e-9);  // supply 289 K and 0.5 K
  EXPECT_EQ(total_at(flood, 299.5, {{"coolant.on", 0.0}}), 0.0);
  auto const& circulating = snippet("flood_coolant", "tank");
  EXPECT_NEAR(total_heat(circulating), 0.0, 1e-9);
}

/// Whatever takes heat at a surface takes it from there, and not from the middle of the outermost cell: half of its 75
/// mm of steel are on the way.
TEST(HalfCells, AreOnTheWayToASurface) {
  double const area = M_PI / 4.0 * 0.04 * 0.04, way = 0.0375 / (42.0 * area), hot = 303.15;
  auto const through = [&](double conductance) { return conductance / (1.0 + conductance * way); };
  Changes const at_end = {{"at", "shaft.end"}};
  EXPECT_NEAR(total_at(snippet("foundation", "constant"), hot, {}, at_end), -through(20.0) * 16.0, 1e-9);
  double const air = 30e-3 / 60.0 * 1e5 / (287.06 * 293.15) * 1007.0;
  EXPECT_NEAR(total_at(snippet("purge_air", "constant"), hot, {}, {{"through", "shaft.end"}}), -through(air) * 12.0,
              1e-9);
  double const film = thermal::radiation_film<double>(0.9, hot, 333.15);
  EXPECT_NEAR(total_at(snippet("hot_neighbour", "constant"), hot, {}, {{"on", "shaft.end"}}),
              (through(0.2 * 0.6 * film) + through(1.0)) * 30.0, 1e-9);
  Snippet const& mass = snippet("extra_mass");
  Machine const machine = Machine::build(bench(mass, at_end));
  auto temperatures = uniform_temperatures(machine, 293.15);
  auto const& shaft = machine.network().range("shaft");
  auto const last = std::size_t(shaft.first + shaft.count - 1);
  temperatures[last] = hot;
  EXPECT_NEAR(heat_of(mass, machine, temperatures)[last], -through(4.0) * 10.0, 1e-9);
}

TEST(Foundation, LeadsIntoTheSoil) {
  EXPECT_NEAR(total_at(snippet("foundation", "constant"), 297.15), -20.0 * 10.0, 1e-9);
  EXPECT_NEAR(total_at(snippet("foundation", "following"), 300.0), -20.0 * 10.0, 1e-9);
  EXPECT_NEAR(total_at(snippet("foundation", "constant"), 297.15, {{"spindle.speed", 0.0}}), -200.0, 1e-9);
  EXPECT_THROW((void)Machine::build(bench(snippet("foundation", "following"), {{"follows", ""}})), FileError);
}

TEST(HotNeighbour, HasHoursOfItsOwn) {
  auto const& cabinet = snippet("hot_neighbour", "constant");
  double const expected = 0.9 * 0.6 * 0.2 * 5.670374419e-8 * (std::pow(333.15, 4) - std::pow(293.15, 4)) + 1.0 * 40.0;
  EXPECT_NEAR(total_at(cabinet, 293.15), expected, 1e-9);
  EXPECT_EQ(total_at(cabinet, 293.15, {{"machine.on", 0.0}}), 0.0);
  EXPECT_NEAR(total_at(cabinet, 293.15, {{"spindle.speed", 0.0}}), expected, 1e-9);
}

TEST(Radiation, GoesWithTheFourthPower) {
  auto const& bodies = snippet("radiation", "bodies");
  double const both = thermal::exchange_emissivity<double>(0.9, 0.6, 0.8, 0.5);
  double const expected = both * 0.4 * 0.8 * 5.670374419e-8 * (std::pow(320.0, 4) - std::pow(300.0, 4));
  EXPECT_NEAR(into_a(bodies, 300.0, 320.0), expected, 1e-9);
  EXPECT_NEAR(total_heat(bodies), 0.0, 1e-9);
  auto const& room = snippet("radiation", "room");
  EXPECT_EQ(total_at(room, 293.15, still_air), 0.0);
  EXPECT_LT(total_at(room, 303.15, still_air), 0.0);
}

TEST(AnnularGap, ConductsAtRestAndStirsWithSpeed) {
  auto const& gap = snippet("annular_gap", "becker_kaye");
  auto const at = [&](double speed) { return conductance_of_a(gap, 300.0, 310.0, {{"spindle.speed", speed}}); };
  auto const air = thermal::properties(thermal::Air{}, 305.0);
  EXPECT_NEAR(at(0.0), 0.04 * air.conductivity / 0.5e-3, 1e-4);
  EXPECT_GT(at(2000.0), 2.0 * at(0.0));
  EXPECT_NEAR(std::log2(at(4000.0) / at(2000.0)), 0.48, 0.02);
}

TEST(AnnularGap, PairsTheCellsThatFaceEachOther) {
  auto const& gap = snippet("annular_gap", "taylor");
  Machine const machine = Machine::build(bench(gap));
  auto temperatures = uniform_temperatures(machine, 300.0);
  auto const& sleeve = machine.network().range("sleeve");
  auto const& shaft = machine.network().range("shaft");
  temperatures[std::size_t(sleeve.first)] = 310.0;  // 0 to 100 mm of 300 mm
  auto const heat = heat_of(gap, machine, temperatures);
  EXPECT_NEAR(heat[std::size_t(shaft.first)], 3.0 * heat[std::size_t(shaft.first) + 1], 1e-2);  // 75 mm and 25 mm
  EXPECT_NEAR(heat[std::size_t(shaft.first) + 2], 0.0, 1e-12);
  EXPECT_NEAR(std::accumulate(heat.begin(), heat.end(), 0.0), 0.0, 1e-9);
}

TEST(AirGap, KnowsWhichSideIsUp) {
  auto const& layered = snippet("air_gap", "horizontal");  // bottom b, top a
  EXPECT_GT(conductance_of_a(layered, 295.0, 305.0), 1.5 * conductance_of_a(layered, 305.0, 295.0));
  auto const& upright = snippet("air_gap", "vertical");
  EXPECT_NEAR(conductance_of_a(upright, 295.0, 305.0), conductance_of_a(upright, 305.0, 295.0), 1e-9);
  EXPECT_NEAR(conductance_of_a(upright, 295.0, 305.0),
              0.2 * thermal::vertical_gap_film<double>(295.0, 305.0, 0.02, 0.3), 1e-9);
}

TEST(Fit, ConductsLessAsItsClearanceOpens) {
  auto const& fit = snippet("fit", "interference");
  double last = conductance_of_a(fit, 293.15, 294.15, {}, {{"clearance", "-12 um"}});
  for (auto const& clearance : {"-5 um", "0 um", "4 um", "10 um", "20 um"}) {
    double const now = conductance_of_a(fit, 293.15, 294.15, {}, {{"clearance", clearance}});
    EXPECT_LT(now, last) << clearance;
    last = now;
  }
}

TEST(Fit, ClosesWhenTheRingIsHotter) {
  auto const& fit = snippet("fit", "interference");
  Changes const open = {{"clearance", "10 um"}};
  EXPECT_GT(conductance_of_a(fit, 301.15, 293.15, {}, open), 1.5 * conductance_of_a(fit, 293.15, 301.15, {}, open));
}

TEST(Fit, IsTheFilmOfPhysics2_3) {
  thermal::Fit fit;
  fit.diameter = 0.110;
  fit.inner_bore = 0.101;
  fit.outer_diameter = 0.160;
  fit.contact = {33.0, 47.5, 0.8e-6, 0.1, 2.5e9};
  double const area = M_PI * 0.110 * 0.02;
  for (double const clearance : {-6.0, 0.0, 4.0, 20.0}) {
    double const gap = thermal::fit_gap<double>(clearance * 1e-6, 0.110, 12.1e-6, 5.0, 10.5e-6, 2.0);
    double const now = conductance_of_a(snippet("fit", "interference"), 298.15, 295.15, {},
                                        {{"clearance", std::to_string(clearance) + " um"}});
    EXPECT_NEAR(now, area * thermal::fit_film<double>(fit, gap, 0.026), 1e-6 * now);
  }
}

TEST(Fit, HasMetalOnBothSidesOfItsSeat) {
  auto const& fit = snippet("fit", "interference");
  for (Changes const& changes : {Changes{{"inner_bore", "110 mm"}}, Changes{{"inner_bore", "120 mm"}},
                                 Changes{{"outer_diameter", "110 mm"}}, Changes{{"outer_diameter", "90 mm"}}})
    EXPECT_THAT(refusal([&] { (void)Machine::build(bench(fit, changes)); }),
                HasSubstr("fit 'interference': the seat lies between inner_bore and outer_diameter"));
}

TEST(ContactJoint, GrowsWithPressure) {
  auto const& joint = snippet("contact_joint", "cooper_mikic_yovanovich");
  double const gap_filling = thermal::gap_film<double>({47.5, 47.5}, 2e6, 0.026, thermal::air_gas_parameter);
  double const contact = thermal::contact_film<double>({47.5, 47.5}, 2e6);
  EXPECT_NEAR(conductance_of_a(joint, 300.0, 310.0), 20e-4 * (contact + gap_filling), 1e-9);
  Changes const pressed = {{"pressure", "8 MPa"}};
  EXPECT_GT(conductance_of_a(joint, 300.0, 310.0, {}, pressed), 2.0 * conductance_of_a(joint, 300.0, 310.0));
  Changes const oiled = {{"gap_conductivity", "0.13 W/(m K)"}, {"gas_parameter", "0 um"}};
  EXPECT_GT(conductance_of_a(joint, 300.0, 310.0, {}, oiled), conductance_of_a(joint, 300.0, 310.0));
}

TEST(BallConductance, IsEachOfTheThreeModels) {
  thermal::BallBearing const bearing{20, 12.3e-3, 90e-3, 15.0 * M_PI / 180.0};
  auto const now = [](char const* model) { return conductance_of_a(snippet("ball_conductance", model), 300.0, 310.0); };
  EXPECT_NEAR(now("schaefer"), 2.0 * thermal::rotating_ball_conductance<double>(bearing, 400.0), 1e-9);
  EXPECT_NEAR(now("static"), thermal::static_ball_conductance<double>(bearing, 300.0, 33.0, 33.0), 1e-9);
  auto const oil = thermal::mineral_oil_viscosity(22);
  double const dynamic = 870.0 * thermal::vogel_cameron_viscosity<double>(oil.scale, oil.temperature, 305.0);
  double const force = 300.0 / (20.0 * std::sin(15.0 * M_PI / 180.0));
  EXPECT_NEAR(
      now("contact"),
      thermal::contact_model_conductance<double>(thermal::rolling_elements(bearing), force, 0.13, dynamic, 400.0),
      1e-9);
}

TEST(BallConductance, GrowsWithSpeed) {
  auto const& effect = snippet("ball_conductance", "schaefer");
  double const slow = conductance_of_a(effect, 300.0, 310.0, {{"spindle.speed", 6.0}});
  double const fast = conductance_of_a(effect, 300.0, 310.0, {{"spindle.speed", 600.0}});
  EXPECT_NEAR(slow, 2.0 * 3.2, 0.3);  // 60 and 6000 rpm, physics.md 2.4
  EXPECT_NEAR(fast, 2.0 * 5.0, 0.3);
}

/// 9 W/K at rest, 12 at full speed, and with the root of the speed between them; its friction knows no temperature.
TEST(Bearing, ConductsMoreWhereItsBallsRoll) {
  auto const& effect = snippet("bearing", "rolling");
  double const full_speed = Machine::build(bench(effect)).limits.max_spindle_speed;
  for (double const share : {0.0, 0.25, 1.0}) {
    Inputs const turning = {{"spindle.speed", share * full_speed}};
    double const conducted = into_a(effect, 300.0, 310.0, turning) - into_a(effect, 310.0, 310.0, turning);
    EXPECT_NEAR(conducted / 10.0, 9.0 + 3.0 * std::sqrt(share), 1e-9);
  }
}

TEST(Bearing, DoesNotConductBackwards) {
  EXPECT_THAT(
      [] {
        static_cast<void>(Machine::build(bench(snippet("bearing", "rolling"), {{"conductance_speed", "-9.1 W/K"}})));
      },
      testing::ThrowsMessage<thermal::InputError>(testing::HasSubstr("at full speed its conductance is below 0")));
}

TEST(Jacket, TakesAllThatAThinStreamCanCarry) {
  auto const& jacket = snippet("jacket", "straight");
  Changes const thin = {{"flow", "0.001 L/min"}};
  Machine const machine = Machine::build(bench(jacket, thin));
  auto temperatures = uniform_temperatures(machine, 303.15);
  auto const tank = std::size_t(machine.network().range("tank").first);
  temperatures[tank] = 293.15;
  auto const heat = heat_of(jacket, machine, temperatures);
  EXPECT_NEAR(heat[tank], 0.001e-3 / 60.0 * 998.2 * 4185.0 * 10.0, 2e-3);
  EXPECT_NEAR(std::accumulate(heat.begin(), heat.end(), 0.0), 0.0, 1e-9);
}

TEST(Jacket, HasTheFilmsOfPhysics2_7) {  // 8 L/min in 8 x 10 mm on diameter 160 mm
  auto const& helix = snippet("jacket", "helix");
  auto const film = [&](Changes const& changes) {
    return -total_at(helix, 294.15, {}, changes);  // wall 1 K above the inlet
  };
  Changes const oil = {{"flow_exponent", "0"}, {"area", "0.001 m2"}, {"temperature", "20 degC"}};
  Changes const water = {{"flow_exponent", "0"}, {"area", "0.001 m2"}, {"temperature", "20 degC"}, {"fluid", "water"}};
  EXPECT_NEAR(film(oil), 0.001 * 700.0, 0.001 * 50.0);
  EXPECT_NEAR(film(water), 0.001 * 9600.0, 0.001 * 800.0);
}

TEST(Jacket, FlowsLessColdOilUnderPressure) {
  auto const& helix = snippet("jacket", "helix");
  Changes const displaced = {{"flow_exponent", "0"}, {"temperature", "10 degC"}};
  Changes const driven = {{"flow_exponent", "1"}, {"temperature", "10 degC"}};
  EXPECT_LT(std::abs(total_at(helix, 303.15, {}, driven)), std::abs(total_at(helix, 303.15, {}, displaced)));
  EXPECT_EQ(total_at(helix, 303.15, {{"machine.on", 0.0}}), 0.0);
}

/// The second law, cell by cell: where the wall is as cold as the inlet nothing is taken from it, however warm the
/// rest.
TEST(CoolantInAWallOfSeveralCells, CoolsNoneBelowItsInlet) {
  auto const check = [](Snippet const& effect, Changes const& changes) {
    Machine const machine = Machine::build(bench(effect, changes));
    auto temperatures = uniform_temperatures(machine, 293.15);
    auto const sleeve = std::size_t(machine.network().range("sleeve").first);
    temperatures[sleeve + 2] = 313.15;
    auto const heat = heat_of(effect, machine, temperatures);
    EXPECT_NEAR(heat[sleeve], 0.0, 1e-9);
    EXPECT_NEAR(heat[sleeve + 1], 0.0, 1e-9);
    double const total = total_at(effect, 313.15, {}, changes);
    EXPECT_NEAR(heat[sleeve + 2], total / 3.0, 1e-6 * std::abs(total));
    EXPECT_LT(total, -10.0);
  };
  check(snippet("jacket", "helix"), {{"temperature", "20 degC"}});
  check(snippet("coolant_flow"), {{"through", "sleeve"}, {"inlet_offset", "-0.85 K"}});
}

/// Each cell by its own temperature: vapour pressure is not linear in it.
TEST(Evaporation, OfAWallOfSeveralCellsFollowsEachCell) {
  auto const& evaporation = snippet("evaporation");
  Changes const wet = {{"from", "sleeve"}};
  Machine const machine = Machine::build(bench(evaporation, wet));
  auto temperatures = uniform_temperatures(machine, 293.15);
  auto const sleeve = std::size_t(machine.network().range("sleeve").first);
  temperatures[sleeve + 2] = 313.15;
  auto const heat = heat_of(evaporation, machine, temperatures, still_air);
  double const cold = total_at(evaporation, 293.15, still_air, wet),
               warm = total_at(evaporation, 313.15, still_air, wet);
  EXPECT_NEAR(heat[sleeve], cold / 3.0, 1e-9 * std::abs(cold));
  EXPECT_NEAR(heat[sleeve + 2], warm / 3.0, 1e-9 * std::abs(warm));
  EXPECT_LT(warm, 2.0 * cold);
}

TEST(ChannelFilm, HeatsTheStreamCellByCell) {
  auto const& film = snippet("channel_film");
  Machine const machine = Machine::build(bench(film));
  auto temperatures = uniform_temperatures(machine, 300.0);
  auto const& sleeve = machine.network().range("sleeve");
  auto const& pipe = machine.network().range("pipe");
  temperatures[std::size_t(sleeve.first) + 1] = 310.0;
  auto const heat = heat_of(film, machine, temperatures);
  double const h = thermal::channel_film<double>(thermal::Water{}, 310.0, 300.0,
                                                 0.05 / thermal::properties(thermal::Water{}, 300.0).density,
                                                 M_PI * 0.006 * 0.006, 0.012, 0.3);
  EXPECT_NEAR(heat[std::size_t(pipe.first) + 1], M_PI * 0.012 * 0.1 * h * 10.0, 0.02 * M_PI * 0.012 * 0.1 * h * 10.0);
  EXPECT_EQ(heat[std::size_t(pipe.first)], 0.0);
}

TEST(Circuit, CarriesHeatInTheSenseOfTheFlow) {
  auto const& circuit = snippet("circuit");  // tank, a, b
  Machine const machine = Machine::build(bench(circuit));
  auto temperatures = uniform_temperatures(machine, 295.0);
  auto const node = [&](char const* name) { return std::size_t(machine.network().range(name).first); };
  temperatures[node("tank")] = 305.0;
  auto const heat = heat_of(circuit, machine, temperatures);
  double const rate = 2e-3 / 60.0 * 998.2 * 4185.0;
  EXPECT_NEAR(heat[node("tank")], -10.0 * rate, 0.01 * rate);
  EXPECT_NEAR(heat[node("a")], 10.0 * rate, 0.01 * rate);
  EXPECT_NEAR(heat[node("b")], 0.0, 1e-9);
  EXPECT_THROW((void)Machine::build(bench(circuit, {{"fluid", "wine"}})), FileError);
}

TEST(Circuit, DelaysByTheVolumeOfTheHose) {
  constexpr char const* text = R"toml(
name = "loop"

[[lump]]
name = "tank"
heat_capacity = "1 MJ/K"

[[lump]]
name = "jacket"
heat_capacity = "10 J/K"

[[channel]]
name = "hose"
length = "6 m"
diameter = "20 mm"
cells = 200

[[film]]
name = "room"
on = ["tank", "jacket"]
area = "1 cm2"

[[joint]]
name = "hose"
from = "hose"
to = "tank"
conductance = "1e-6 W/K"

[[circuit]]
name = "loop"
through = ["tank", "hose", "jacket"]
flow = "6 L/min"
)toml";
  Machine const machine = Machine::build(parse_toml(text, "loop"));
  auto start = uniform_temperatures(machine, 293.15);
  start[std::size_t(machine.network().range("tank").first)] = 303.15;
  auto const jacket = std::size_t(machine.network().range("jacket").first);
  std::vector<double> const times = {0.0, 14.0, 18.85, 24.0};
  std::vector<double> rise;
  thermal::integrate(machine.network(), bench_course(machine), start, times, {},
                     [&](thermal::Sample const& sample) { rise.push_back(sample.temperatures[jacket] - 293.15); });
  EXPECT_LT(rise[1], 0.1);
  EXPECT_NEAR(rise[2], 5.0, 0.3);  // V/V̇ = 18.85 s
  EXPECT_GT(rise[3], 9.9);
}

/// A front of plug flow over a wall at equilibrium with it travels slower by 1 + C_w/C_fluid: it comes through later by
/// C_w/(ṁ c), 600 s here beside 216 s of the water alone, and ends where it would without a wall.
TEST(ChannelWall, DelaysTheFrontByItsHeatCapacityOverThatOfTheFlow) {
  std::string const text = R"toml(
    name = "pipe"
    [[channel]]
    name = "pipe"
    direction = "x"
    length = "30 m"
    diameter = "30.3 mm"
    cells = 40
    flow = "pipe.flow"
    inlet = "pipe.inlet"
    )toml";
  std::string const wall = R"toml(
    [[channel_wall]]
    name = "steel"
    channel = "pipe"
    heat_capacity = "251 kJ/K"
    time_constant = "10 s"
    )toml";
  auto const integral_of_what_is_missing = [&](std::string const& description) {
    Machine const machine = Machine::build(parse_toml(description, "pipe"));
    auto const& pipe = machine.network().range("pipe");
    auto const course = bench_course(machine, {{"pipe.flow", 0.1}, {"pipe.inlet", 303.15}});
    std::vector<double> times;
    for (double t = 0.0; t <= 4000.0; t += 5.0) times.push_back(t);
    double missing = 0.0, rise = 0.0;
    thermal::integrate(machine.network(), course, uniform_temperatures(machine, 293.15), times, {},
                       [&](thermal::Sample const& sample) {
                         rise = sample.temperatures[std::size_t(pipe.first + pipe.count - 1)] - 293.15;
                         missing += 5.0 * (1.0 - 0.1 * rise);
                       });
    EXPECT_NEAR(rise, 10.0, 0.01);
    return missing;
  };
  EXPECT_NEAR(integral_of_what_is_missing(text + wall) - integral_of_what_is_missing(text), 251e3 / (0.1 * 4181.0),
              6.0);
}

TEST(ExtraMass, IsForgottenInTheSteadyStateAndDelaysOnTheWay) {
  auto const& mass = snippet("extra_mass");
  Machine const with_mass = Machine::build(bench(mass));
  Machine const with_little = Machine::build(bench(mass, {{"heat_capacity", "1 J/K"}}));
  auto const course = bench_course(with_mass);
  std::vector<double> input(std::size_t(with_mass.network().channels()));
  course.evaluate(0.0, {input.data(), std::size_t(with_mass.network().external_channels())});
  auto const start = uniform_temperatures(with_mass, 295.0);
  auto const steady = thermal::steady_state(with_mass.network(), input, start);
  auto const steady_little = thermal::steady_state(with_little.network(), input, start);
  auto const sleeve = std::size_t(with_mass.network().range("sleeve").first);
  EXPECT_NEAR(steady[sleeve], steady_little[sleeve], 1e-6);

  auto const after = [&](Machine const& machine) {
    double result = 0.0;
    std::vector<double> const times = {0.0, 900.0};
    thermal::integrate(machine.network(), course, start, times, {},
                       [&](thermal::Sample const& sample) { result = sample.temperatures[sleeve]; });
    return result;
  };
  double const gap = steady[sleeve] - 295.0;
  EXPECT_GT((after(with_little) - after(with_mass)) / gap, 0.02);
}

TEST(Film, RefusesACoefficientThatItsCorrelationDoesNotTake) {
  auto const refused = [](std::string const& correlation) {
    return refusal([&] { return Machine::build(bench(snippet("film", "constant"), {{"correlation", correlation}})); });
  };
  EXPECT_THAT(refused("room"), HasSubstr("needs correlation = \"constant\""));
  EXPECT_EQ(refused("constant"), "accepted");
}

TEST(Film, OfARotatingCylinderAgreesAmongItsSources) {
  for (auto const& variant : {"rotating_cylinder_jungnickel", "rotating_cylinder_anderson"}) {
    double const becker = total_at(snippet("film", "rotating_cylinder"), 313.15, still_air);
    EXPECT_NEAR(total_at(snippet("film", variant), 313.15, still_air), becker, 0.3 * std::abs(becker)) << variant;
  }
  for (auto const& s : snippets())
    if (s.effect == "film") {
      EXPECT_LT(total_at(s, 313.15, {{"ambient.gradient", 0.0}}), s.name == "constant" ? 1e-9 : 0.0) << s.name;
    }
}

}  // namespace
}  // namespace thermotwin::twin
