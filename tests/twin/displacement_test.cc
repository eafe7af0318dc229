#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "thermal/error.h"
#include "thermal/shaft_deformation.h"
#include "twin/machine.h"

// What the warming of bodies and the speed do to the displacement channels of a machine file.

namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Bed, column and head of one iron, a steel spindle that points down, and air around all. Coordinates from the table's
/// middle upwards; the tool is at x = 0, y = 0, 300 mm over the table.
constexpr char const* frame = R"(
name = "frame"
[spindle]
maximum_speed = "6000 rpm"
[[block]]
name = "bed"
material = "GJL-300"
corner = ["-400 mm", "-500 mm", "-600 mm"]
size = ["800 mm", "1400 mm", "400 mm"]
cells = [4, 7, 2]
[[block]]
name = "column"
material = "GJL-300"
corner = ["-300 mm", "500 mm", "-200 mm"]
size = ["600 mm", "400 mm", "1200 mm"]
cells = [3, 2, 6]
[[block]]
name = "head"
material = "GJL-300"
corner = ["-200 mm", "-200 mm", "500 mm"]
size = ["400 mm", "700 mm", "400 mm"]
cells = [2, 4, 2]
[[bar]]
name = "shaft"
material = "GJL-300"
origin = ["0 mm", "0 mm", "300 mm"]
direction = "z"
length = "400 mm"
outer_diameter = "70 mm"
cells = 8
[[film]]
name = "bed"
on = "bed.z_max"
correlation = "room"
[[film]]
name = "column"
on = "column.y_max"
correlation = "room"
[[film]]
name = "head"
on = "head.z_max"
correlation = "room"
[[film]]
name = "shaft"
on = "shaft"
correlation = "room"
)";

Machine machine(std::string const& tables) {
  return Machine::build(parse_toml(std::string(frame) + tables, "frame.toml"));
}

std::string message_of(std::string const& tables) {
  try {
    (void)machine(tables);
  } catch (thermal::InputError const& error) {
    return error.what();
  }
  return "nothing was thrown";
}

Displacement const& channel(Machine const& built, std::string const& name) {
  for (auto const& d : built.displacements)
    if (d.name == name) return d;
  throw std::out_of_range(name);
}

/// Response to a field of rises [K] over place.
template <class Field>
double response(Machine const& built, Displacement const& d, Field field) {
  double sum = 0.0;
  for (auto const& body : built.geometry)
    for (std::size_t i = 0; i < body.cells.size(); ++i)
      for (auto const& [node, weight] : d.weights)
        if (node == body.first_node + int(i)) sum += weight * field(body.name, Eigen::Vector3d(centre(body.cells[i])));
  return sum;
}

auto const one_kelvin = [](std::string const&, Eigen::Vector3d const&) { return 1.0; };

TEST(Displacement, LoopOfOneMetalAtOneTemperatureMovesByExpansionTimesItsOffset) {
  auto const built = machine(R"(
[[displacement]]
name = "E_Z"
closure = "-500 mm"
segment = [
  { of = "column", length = "1 m", weight = -1 },
  { of = "head", length = "400 mm" },
  { of = "shaft[0 mm .. 100 mm]" },
]
)");
  EXPECT_NEAR(response(built, channel(built, "E_Z"), one_kelvin), -0.5 * 10.5e-6, 1e-19);
}

/// The loop from the middle of the table (top of the bed) by column and head to the seat of the shaft.
std::string loop(std::string const& solution) {
  std::string tables;
  for (auto const* direction : {"x", "y", "z"})
    tables += fmt::format(R"(
[[displacement]]
name = "E_{0}"
direction = "{0}"
influence = [
  {{ body = "column", fixed = "z_min", loaded = "z_max", point = ["0 mm", "0 mm", "300 mm"], solution = "{1}" }},
  {{ body = "head", fixed = "y_max", loaded = "y_min", point = ["0 mm", "0 mm", "300 mm"], solution = "{1}" }},
]
[[rotation]]
name = "R_{0}"
direction = "{0}"
influence = [
  {{ body = "column", fixed = "z_min", loaded = "z_max", solution = "{1}" }},
  {{ body = "head", fixed = "y_max", loaded = "y_min", solution = "{1}" }},
]
)",
                          direction, solution);
  return tables;
}

TEST(Displacement, BlocksAtOneTemperatureMoveTheToolByTheWayThroughThem) {
  auto const built = machine(loop("beam"));
  double const way[3] = {0.0, -0.7, 1.2};
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(response(built, channel(built, std::string("E_") + "xyz"[d]), one_kelvin), 10.5e-6 * way[d], 1e-17);
    EXPECT_NEAR(response(built, channel(built, std::string("R_") + "xyz"[d]), one_kelvin), 0.0, 1e-17);
  }
}

TEST(Displacement, InfluencesCountInTheClosureOfTheLoop) {
  auto const tables = [](char const* closure) {
    return fmt::format(R"(
[[displacement]]
name = "E_Z"
closure = "{}"
influence = [{{ body = "column", fixed = "z_min", loaded = "z_max", weight = -1, solution = "beam" }}]
segment = [{{ of = "shaft[0 mm .. 100 mm]" }}]
)",
                       closure);
  };
  EXPECT_EQ(machine(tables("-1100 mm")).displacements.size(), 1u);
  EXPECT_THAT(message_of(tables("1300 mm")), AllOf(HasSubstr("does not close"), HasSubstr("-1100 mm")));
}

TEST(Displacement, BentColumnTurnsTheToolAboutItsTop) {
  // 1 K from front to back over the depth h: κ = α/h, φ = κL, and the tool moves with the levers of the top's rotation.
  auto const built = machine(loop("beam"));
  auto const warm_back = [](std::string const& body, Eigen::Vector3d const& x) {
    return body == "column" ? (x.y() - 0.7) / 0.4 : 0.0;
  };
  double const curvature = 10.5e-6 / 0.4, tilt = curvature * 1.2;
  Eigen::Vector3d const from_top = Eigen::Vector3d(0.0, 0.0, 0.3) - Eigen::Vector3d(0.0, 0.7, 1.0);
  EXPECT_NEAR(response(built, channel(built, "R_x"), warm_back), tilt, 1e-12);
  EXPECT_NEAR(response(built, channel(built, "E_y"), warm_back), -0.5 * curvature * 1.44 - tilt * from_top.z(), 1e-12);
  EXPECT_NEAR(response(built, channel(built, "E_z"), warm_back), tilt * from_top.y(), 1e-12);
}

TEST(Displacement, TiltAndBendingOfLumpedPartsFollowTheirFormulas) {
  auto const built = machine(R"(
[[rotation]]
name = "A"
base = "450 mm"
segment = [{ of = "head", length = "1 m" }, { of = "column", length = "1 m", weight = -1 }]
[[displacement]]
name = "E_Y"
segment = [{ rotation = "A", lever = "-500 mm" }]
[[displacement]]
name = "E_Z"
segment = [{ of = "head", against = "column", height = "450 mm", length = "1 m" }]
)");
  auto const warm_head = [](std::string const& body, Eigen::Vector3d const&) { return body == "head" ? 1.0 : 0.0; };
  EXPECT_NEAR(response(built, channel(built, "A"), warm_head), 10.5e-6 / 0.45, 1e-12);
  EXPECT_NEAR(response(built, channel(built, "E_Y"), warm_head), -0.5 * 10.5e-6 / 0.45, 1e-12);
  EXPECT_NEAR(response(built, channel(built, "E_Z"), warm_head), 0.5 * 10.5e-6 / 0.45, 1e-12);
  EXPECT_NEAR(response(built, channel(built, "E_Z"), one_kelvin), 0.0, 1e-18);
}

TEST(Displacement, BendingTurnsTheEndByTheCurvatureOverTheLength) {  // physics.md 3.5: φ = κ L = α Δθ L/H
  for (char const* const base : {"", "base = \"5 mm\"\n", "base = \"500 mm\"\n"}) {
    auto const built = machine(fmt::format(R"(
[[rotation]]
name = "A"
{}segment = [{{ of = "head", against = "column", height = "450 mm", length = "2 m", weight = -1 }}]
)",
                                           base));
    auto const warm_head = [](std::string const& body, Eigen::Vector3d const&) { return body == "head" ? 1.0 : 0.0; };
    EXPECT_NEAR(response(built, channel(built, "A"), warm_head), -10.5e-6 * 2.0 / 0.45, 1e-12) << base;
    EXPECT_NEAR(response(built, channel(built, "A"), one_kelvin), 0.0, 1e-18) << base;
  }
}

TEST(Displacement, GrowthInARotationNeedsItsBase) {
  EXPECT_THAT(message_of(R"(
[[rotation]]
name = "A"
segment = [{ of = "head", length = "1 m" }]
)"),
              HasSubstr("rotation 'A': 'base' is missing"));
}

/// It would divide what grows.
TEST(Displacement, OnlyARotationHasABase) {
  EXPECT_THAT(message_of(R"(
[[displacement]]
name = "E_Z"
base = "500 mm"
segment = [{ of = "head", length = "1 m" }]
)"),
              HasSubstr("displacement 'E_Z' has a 'base'; only a [[rotation]] has one"));
}

constexpr char const* axial = R"(
[[displacement]]
name = "E_Z"
segment = [{ of = "shaft" }]
)";

TEST(Displacement, SpeedShortensTheShaftAndShiftsItsBearings) {
  auto const built = machine(std::string(axial) + R"(
[[centrifugal_growth]]
name = "shaft"
displacement = "E_Z"
growth = "6 um"
power = 1.5
shaft_length = "250 mm"
outer_diameter = "70 mm"
inner_diameter = "22 mm"
)");
  auto const& d = channel(built, "E_Z");
  double const full = 200.0 * std::numbers::pi;
  double sum = 0.0;
  for (auto const& term : d.input_terms) {
    EXPECT_EQ(term.channel, "spindle.speed");
    sum += term.coefficient * std::pow(full, term.power);
  }
  EXPECT_NEAR(sum, 6e-6 - 0.72e-6, 0.02e-6);
}

TEST(Displacement, SpringPreloadedBearingYieldsToWarmRingsAndToSpeed) {
  auto const built = machine(R"(
[[displacement]]
name = "E_Z"
[[bearing_shift]]
name = "front"
displacement = "E_Z"
inner = "shaft[0 mm .. 50 mm]"
outer = "head"
ball_diameter = "12.3 mm"
pitch_diameter = "90 mm"
preload = "300 N"
weight = -1
)");
  auto const& d = channel(built, "E_Z");
  thermal::BallBearing const bearing{20, 12.3e-3, 90e-3, 15.0 * std::numbers::pi / 180.0};
  auto const field = [](std::string const& body, Eigen::Vector3d const&) {
    return body == "shaft" ? 5.0 : body == "head" ? 3.0 : 0.0;
  };
  EXPECT_NEAR(response(built, d, field), -thermal::spring_preload_shift<double>(bearing, 12.1e-6, 5.0, 3.0), 1e-15);
  ASSERT_EQ(d.input_terms.size(), 1u);
  for (double const share : {0.5, 1.0}) {
    double const speed = share * 200.0 * std::numbers::pi;
    EXPECT_NEAR(d.input_terms[0].coefficient * std::pow(speed, d.input_terms[0].power),
                -thermal::centrifugal_ball_shift(bearing, 300.0, speed), 1e-14);
  }
}

TEST(Displacement, BearingThatCannotBeIsRefused) {
  auto const message = [](char const* ball, char const* pitch, char const* preload) {
    return message_of(fmt::format(R"(
[[displacement]]
name = "E_Z"
[[bearing_shift]]
name = "front"
displacement = "E_Z"
inner = "shaft[0 mm .. 50 mm]"
outer = "head"
ball_diameter = "{}"
pitch_diameter = "{}"
preload = "{}"
)",
                                  ball, pitch, preload));
  };
  EXPECT_EQ(message("12 mm", "90 mm", "300 N"), "nothing was thrown");
  EXPECT_THAT(message("12 mm", "90 mm", "0 N"), HasSubstr("bearing_shift 'front': 'preload' must be above 0"));
  EXPECT_THAT(message("12 mm", "0 mm", "300 N"), HasSubstr("'pitch_diameter' is \"0 mm\"; it must be positive"));
  EXPECT_THAT(message("0 mm", "90 mm", "300 N"), HasSubstr("'ball_diameter' is \"0 mm\"; it must be positive"));
  EXPECT_THAT(message("90 mm", "90 mm", "300 N"), HasSubstr("bearing_shift 'front': the balls are above 0"));
}

TEST(Displacement, HeldShaftShowsOnlyItsShareInFront) {
  auto const built = machine(R"(
[[displacement]]
name = "E_Z"
[[held_shaft]]
name = "spindle"
displacement = "E_Z"
shaft = "shaft"
housing = "head"
length = "400 mm"
front_stiffness = "200 N/um"
rear_stiffness = "200 N/um"
shaft_area = "1 m2"
housing_area = "1 m2"
shaft_expansion = "12e-6 1/K"
housing_expansion = "12e-6 1/K"
)");
  auto const& d = channel(built, "E_Z");
  EXPECT_NEAR(response(built, d, one_kelvin), 0.0, 1e-18);
  auto const warm = [](std::string const& body, Eigen::Vector3d const&) { return body == "shaft" ? 5.0 : 0.0; };
  EXPECT_NEAR(response(built, d, warm), 0.5 * 12e-6 * 5.0 * 0.4, 1e-8);
}

TEST(Displacement, CompensationLeftOnTakesOffWhatItsSensorReads) {
  auto const built = machine(fmt::format("{}{}", axial, R"(
[[compensation]]
name = "controller"
displacement = "E_Z"
at = "head"
gain = "0.6 um/K"
)"));
  auto const warm_head = [](std::string const& body, Eigen::Vector3d const&) { return body == "head" ? 2.0 : 0.0; };
  EXPECT_NEAR(response(built, channel(built, "E_Z"), warm_head), -1.2e-6, 1e-15);
}

TEST(Displacement, TermsOfARotationReachWhatItTurns) {
  auto const built = machine(R"(
[[rotation]]
name = "A"
[[displacement]]
name = "E_Y"
segment = [{ rotation = "A", lever = "-500 mm" }]
[[centrifugal_growth]]
name = "tilt"
displacement = "A"
growth = "10 um"
)");
  auto const& turned = channel(built, "E_Y");
  ASSERT_EQ(turned.input_terms.size(), 1u);
  EXPECT_NEAR(turned.input_terms[0].coefficient * std::pow(200.0 * std::numbers::pi, 2), -5e-6, 1e-15);
}

constexpr char const* screw = R"(
[[ball_screw]]
name = "E_P"
body = "shaft"
support = "fixed-fixed"
)";

TEST(Displacement, ScrewKnowsItsSeatsAndWhatItIsMeasuredAgainst) {
  auto const plain = machine(screw).screws.at(0);
  EXPECT_TRUE(plain.seat_growth.empty());
  EXPECT_TRUE(plain.reference_strain.empty());
  auto const held = machine(std::string(screw) + "seats = \"column\"\nreference = \"bed\"\n").screws.at(0);
  auto const sum = [](NodeWeights const& weights) {
    double total = 0.0;
    for (auto const& [node, weight] : weights) total += weight;
    return total;
  };
  EXPECT_NEAR(sum(held.seat_growth), 10.5e-6 * 0.4, 1e-18);
  EXPECT_NEAR(sum(held.reference_strain), 10.5e-6, 1e-18);
}

TEST(Displacement, ScrewAtTheTemperatureOfItsSurroundingsHasNoError) {
  auto const built = machine(fmt::format("{}{}", screw, "seats = \"shaft\"\nreference = \"shaft\"\n")).screws.at(0);
  std::vector<double> const rise(8, 6.0);
  double seat = 0.0, strain = 0.0;
  for (auto const& [node, weight] : built.seat_growth) seat += 6.0 * weight;
  for (auto const& [node, weight] : built.reference_strain) strain += 6.0 * weight;
  for (double const x : {0.0, 0.13, 0.4})
    EXPECT_NEAR(built.screw.position_error(x, rise, seat) - strain * x, 0.0, 1e-18) << x;
}

/// At random temperatures, for every end; beyond the pretension, a screw that is only pulled is none.
TEST(Displacement, ErrorOfAScrewIsALinearChannelWhereItsEndsHold) {
  for (auto const* ends : {"fixed-free", "fixed-supported", "fixed-fixed"}) {
    auto const built = machine(fmt::format(R"(
[[ball_screw]]
name = "E_P"
body = "shaft"
support = "{}"
unilateral = false
seats = "column"
reference = "bed"
positions = ["130 mm", "400 mm"]
)",
                                           ends));
    ASSERT_EQ(built.linear_channels.size(), built.displacements.size() + 2) << ends;
    auto const& screw = built.screws[0];
    Eigen::VectorXd const warmer = 5.0 * Eigen::VectorXd::Random(built.network().nodes());
    auto const along = [&](NodeWeights const& weights) {
      double sum = 0.0;
      for (auto const& [node, weight] : weights) sum += weight * warmer[node];
      return sum;
    };
    std::vector<double> const rise(warmer.data() + screw.first_node,
                                   warmer.data() + screw.first_node + screw.screw.edges.size() - 1);
    for (int p = 0; p < 2; ++p) {
      auto const& channel = built.linear_channels[built.displacements.size() + std::size_t(p)];
      double const x = screw.description.positions[std::size_t(p)];
      EXPECT_EQ(channel.name, p == 0 ? "E_P_130mm" : "E_P_400mm");
      double const error =
          screw.screw.position_error(x, rise, along(screw.seat_growth)) - x * along(screw.reference_strain);
      EXPECT_GT(std::abs(error), 1e-8) << ends;
      EXPECT_NEAR(along(channel.weights), error, 1e-15) << ends;
    }
  }
  auto const pulled = machine(std::string(screw) + "positions = [\"130 mm\"]\n");
  EXPECT_EQ(pulled.linear_channels.size(), pulled.displacements.size());
}

TEST(Displacement, PartThatMovesAnUnknownChannelIsAnErrorWithItsLine) {
  auto const message = message_of(std::string(axial) + R"(
[[compensation]]
name = "controller"
displacement = "E_Y"
at = "head"
gain = "0.6 um/K"
)");
  EXPECT_THAT(message, AllOf(HasSubstr("frame.toml:54:16"), HasSubstr("'E_Y'"), HasSubstr("E_Z")));
}

}  // namespace
}  // namespace thermotwin::twin
