#include "twin/diagnosis/residual_model.h"

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

#include "scenarios/course.h"
#include "thermal/integrate.h"

namespace thermotwin::twin {
namespace {

/// A body whose specific heat grows, cooled by the room: d(δy)/dt = −(G/C) dT/dy δy, and a sensor sees dT/dy δy.
TEST(ResidualModel, CountsInEnthalpyTemperature) {
  double const capacity = 1000.0, slope = 4e-4, conductance = 5.0, temperature = 333.15;
  thermal::NetworkBuilder builder;
  auto const body = builder.add_body("bed", {capacity}, slope);
  builder.connect(builder.part("film"), body, builder.add_boundary({"room", 293.15, {}}), conductance);
  auto const network = builder.build();
  std::vector<double> const state = {network.state_of_temperature(0, temperature)};
  auto const regime = linearise(network, state, {}, {{{0, 1.0}}, {{0, 0.25}, {0, 0.25}}, {}});
  double const step = 1e-3;
  double const seen = (network.temperature_of_state(0, state[0] + step) - temperature) / step;
  EXPECT_NEAR(seen, 1.0 / (1.0 + slope * 40.0), 1e-6);
  EXPECT_NEAR(regime.observation(0, 0), seen, 1e-6);
  EXPECT_NEAR(regime.observation(1, 0), 0.5 * seen, 1e-6);
  EXPECT_EQ(regime.observation(2, 0), 0.0);
  EXPECT_NEAR(regime.dynamics(0, 0), -conductance / capacity * seen, 1e-8);
}

/// In the steady state 0 = A δy + q e_i/C_i: a watt at the pulley, linear and in full, at every node of the spindle.
TEST(ResidualModel, AnswersToHeatAsTheMachineDoes) {
  auto document = read_toml(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "twin/machines/v450.toml");
  auto const steady = [](Machine const& machine, std::vector<double>& input) {
    scenarios::Experiment experiment;
    experiment.duration = 3600.0;
    experiment.ambient.mean = 295.15;
    experiment.spindle.emplace();
    experiment.spindle->blocks.push_back({3600.0, 400.0, {}});
    scenarios::ExperimentCourse const course(experiment, machine.limits);
    std::vector<double> values(course.channels().size());
    course.evaluate(0.0, values);
    for (auto const& name : machine.network().channel_names())
      for (std::size_t i = 0; i < values.size(); ++i)
        if (course.channels()[i].name == name) input.push_back(values[i]);
    std::vector<double> const guess(std::size_t(machine.network().nodes()), 300.0);
    return thermal::steady_state(machine.network(), input, guess);
  };
  std::vector<double> input, heated_input;
  auto const machine = Machine::build(document);
  auto const temperatures = steady(machine, input);
  auto const addition = parse_toml("[[heat]]\nname = \"hidden\"\nat = \"shaft[390 mm]\"\npower = \"1 W\"\n", "hidden");
  std::get<Value::Table>(document.content).push_back(std::get<Value::Table>(addition.content).front());
  auto const heated = steady(Machine::build(document), heated_input);

  auto const& network = machine.network();
  auto const regime = linearise(network, temperatures, input, {});  // constant specific heats: y = T
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(network.nodes());
  int const node = network.range("shaft").first + 19;
  rate[node] = 1.0 / network.capacity()[std::size_t(node)];
  Eigen::VectorXd const answer = -regime.dynamics.partialPivLu().solve(rate);
  for (int i = 0; i < network.nodes(); ++i) {
    double const rise = heated[std::size_t(i)] - temperatures[std::size_t(i)];
    EXPECT_NEAR(answer[i], rise, 0.01 * std::abs(rise)) << network.node_name(i);
  }
}

}  // namespace
}  // namespace thermotwin::twin
