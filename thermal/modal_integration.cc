#include "thermal/modal_integration.h"

#include <Eigen/Core>
#include <chrono>
#include <fmt/format.h>
#include <span>

#include "thermal/course_inputs.h"
#include "thermal/error.h"
#include "thermal/linear_part.h"
#include "thermal/reduced_integration.h"
#include "thermal/reduced_network.h"

namespace thermotwin::thermal {
namespace {

constexpr int most_modes = 400;
constexpr double above_start = 5.0;  // [K]: where films are linearised; the rest of them is small near it
constexpr double share_of_tolerance = 0.1;

ReferencePoint reference_point(Network const& network, std::vector<double> state, Course const& course, double time) {
  CourseInputs inputs(network, course);
  inputs.enter_piece(time);
  for (double& y : state) y += above_start;
  Evaluation evaluation(network);
  auto const temperatures = evaluation.temperatures(state.data(), inputs.at(time).data());
  return {{temperatures.begin(), temperatures.end()}, evaluation.inputs()};
}

}  // namespace

void check_modes(Network const& network) {
  check_reducible(network);
  if (network.nodes() > most_modes)
    throw InputError(fmt::format("{} nodes are too many to be run in modes; at most {}", network.nodes(), most_modes));
}

IntegrationSummary integrate_in_modes(Network const& network, Course const& course,
                                      std::span<double const> initial_temperatures,
                                      std::span<double const> output_times, IntegrationOptions const& options,
                                      Observer const& observe) {
  auto const begin = std::chrono::steady_clock::now();
  check_modes(network);
  if (output_times.empty()) throw InputError("there is no output time");
  auto const start = start_of_run(network, initial_temperatures, output_times.front());
  LinearPart const linear(network, reference_point(network, start.start, course, start.time));
  ReducedNetwork const modes(network, linear, Eigen::MatrixXd::Identity(network.nodes(), network.nodes()),
                             nonlinear_elements(network, linear));
  Evaluation evaluation(network);
  std::vector<double> state(start.start.size());
  double const tolerance = share_of_tolerance * options.tolerance();
  auto const done = integrate(
      modes, course, modes.state_of(initial_temperatures), output_times, tolerance,
      [&](ReducedSample const& seen) {
        modes.temperatures_of(seen.state, state);
        for (int i = 0; i < network.nodes(); ++i)
          state[std::size_t(i)] = network.state_of_temperature(i, state[std::size_t(i)]);
        Sample sample;
        sample.time = seen.time;
        sample.state = state;
        sample.temperatures = evaluation.temperatures(state.data(), seen.input.data());
        sample.input = seen.input;
        observe(sample);
      },
      options.most_steps);
  IntegrationSummary summary;
  summary.steps = done.steps;
  summary.rate_evaluations = done.rate_evaluations;
  summary.error_test_failures = done.rejected;
  summary.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return summary;
}

}  // namespace thermotwin::thermal
