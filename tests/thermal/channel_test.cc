#include "thermal/channel.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/thermal/function_course.h"
#include "thermal/bar.h"
#include "thermal/channel_film.h"
#include "thermal/error.h"
#include "thermal/integrate.h"
#include "thermal/joint.h"

namespace thermotwin::thermal {
namespace {

constexpr double density = 1000.0, specific_heat = 4000.0, section = 1e-4, length = 2.0, flow = 0.05;
constexpr double residence = density * section * length / flow;  // 4 s

Channel hose(int cells) {
  return {{0, 0, 0}, {1, 0, 0}, length, section, 4.0 * section / 0.01, density, specific_heat, cells};
}

struct Line {
  Network network;
  int outlet;
};

/// The inlet's temperature is the channel "inlet"; the wall, if it conducts, is at 20 °C.
Line line(int cells, double wall_conductance = 0.0) {
  NetworkBuilder builder;
  int const part = builder.part("hose");
  Body const body = make_body("hose", hose(cells));
  add_to(builder, part, body);
  Port const inlet = builder.add_boundary({"inlet", 0.0, {{builder.channel("inlet"), 1.0}}});
  Port const outlet = builder.add_boundary({"outlet", 293.15, {}});
  add_flow(builder, part, body, specific_heat, builder.channel("flow"), inlet, outlet);
  if (wall_conductance > 0.0) {
    Port const wall = builder.add_boundary({"wall", 293.15, {}});
    for (auto const& contact : face(body, "wall").contacts)
      builder.connect(part, port_of(builder, face(body, "wall"), contact), wall, wall_conductance * contact.share);
  }
  Network network = builder.build();
  return {std::move(network), cells - 1};
}

std::vector<double> operating_point(Network const& network, double inlet) {
  std::vector<double> input;
  for (auto const& name : network.channel_names()) input.push_back(name == "flow" ? flow : inlet);
  return input;
}

FunctionCourse constant(double inlet) {
  return {{"inlet", "flow"}, [inlet](double, std::span<double> u) {
            u[0] = inlet;
            u[1] = flow;
          }};
}

TEST(Channel, AFrontArrivesAfterVolumeOverFlowAndSpreadsAsACascadeOfTanks) {
  for (int cells : {10, 40, 160}) {
    auto const hose_line = line(cells);
    std::vector<double> times;
    for (int i = 0; i <= 4000; ++i) times.push_back(i * residence * 4.0 / 4000);
    std::vector<double> const start(std::size_t(cells), 293.15);
    double delay = 0.0, second = 0.0, previous = 0.0;
    IntegrationOptions options;
    options.relative_tolerance = options.absolute_tolerance = 1e-9;
    integrate(hose_line.network, constant(303.15), start, times, options, [&](Sample const& s) {
      double const now = (s.temperatures[std::size_t(hose_line.outlet)] - 293.15) / 10.0;
      double const middle = s.time - 0.5 * (times[1] - times[0]);
      delay += middle * (now - previous);
      second += middle * middle * (now - previous);
      previous = now;
    });
    EXPECT_NEAR(delay, residence, 1e-3 * residence) << cells;
    EXPECT_NEAR(second - delay * delay, residence * residence / cells, 0.01 * residence * residence / cells) << cells;
  }
}

TEST(Channel, TheStreamKeepsEveryJoule) {
  auto const hose_line = line(25, 30.0);
  std::vector<double> const start(25, 293.15), times{0.0, 3.0, 20.0};
  auto const summary = integrate(hose_line.network, constant(320.0), start, times, {}, [](Sample const&) {});
  EXPECT_LT(summary.energy_imbalance(), 1e-9);
  EXPECT_GT(summary.stored, 0.0);
}

TEST(Channel, SteadyExchangeFollowsTheNumberOfTransferUnits) {
  double const ntu = 1.5, rise = 30.0;
  double previous_error = 0.0;
  for (int cells : {8, 16, 32, 64}) {
    auto const hose_line = line(cells, ntu * flow * specific_heat);
    auto const input = operating_point(hose_line.network, 293.15 + rise);
    auto const steady = steady_state(hose_line.network, input, std::vector<double>(std::size_t(cells), 300.0));
    double const out = (steady.back() - 293.15) / rise;
    EXPECT_NEAR(out, std::pow(1.0 + ntu / cells, -cells), 1e-12);
    double const error = out - std::exp(-ntu);
    if (previous_error > 0.0) {
      EXPECT_NEAR(std::log2(previous_error / error), 1.0, 0.15) << "upwind is of first order";
    }
    previous_error = error;
  }
}

TEST(Channel, StandingFluidStillConductsToItsWall) {
  double const T[2] = {323.15, 293.15}, still[1] = {0.0}, running[1] = {0.2};
  double const c[6] = {0.01, 0.0, section, 0.01, length, number_of_fluid("water")};
  double q_still[2], q_running[2];
  ChannelFilm::flows(T, c, still, q_still);
  ChannelFilm::flows(T, c, running, q_running);
  auto const water = properties(Water{}, 293.15);
  double const pr_ratio = water.prandtl / properties(Water{}, 323.15).prandtl;
  EXPECT_NEAR(q_still[1], 0.01 * 30.0 * 3.66 * std::pow(pr_ratio, 0.11) * water.conductivity / 0.01, 1e-3 * q_still[1]);
  EXPECT_GT(q_running[1], 20.0 * q_still[1]);
  EXPECT_EQ(q_running[0], -q_running[1]);
}

TEST(Channel, FilmAndHalfCellResistInSeries) {
  double const T[2] = {323.15, 303.15}, u[1] = {0.1};
  double c[6] = {0.02, 0.0, section, 0.01, length, number_of_fluid("oil VG10")};
  double bare[2], with[2];
  ChannelFilm::flows(T, c, u, bare);
  c[1] = 3e-3;
  ChannelFilm::flows(T, c, u, with);
  EXPECT_NEAR(20.0 / with[1], 20.0 / bare[1] + 3e-3 / 0.02, 1e-9);
}

TEST(Channel, NumbersOfFluidsAreTheirPlacesInTheList) {
  EXPECT_EQ(fluid_names()[std::size_t(number_of_fluid("Water-Glycol"))], "water-glycol");
  EXPECT_THROW((void)number_of_fluid("watter"), InputError);
}

}  // namespace
}  // namespace thermotwin::thermal
