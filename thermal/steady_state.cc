#include <cmath>

#include "thermal/error.h"
#include "thermal/integrate.h"
#include "thermal/newton_system.h"

namespace thermotwin::thermal {
namespace {

/// Change of the state in one implicit Euler step of length `step`, or in a Newton step to the steady state if that is
/// infinite; linearised once.
Eigen::VectorXd implicit_step(Evaluation& evaluation, NewtonSystem& system, Eigen::VectorXd const& y,
                              double const* input, double step) {
  Eigen::VectorXd rate(y.size()), change(y.size());
  evaluation.rate(y.data(), input, rate.data());
  system.linearise(evaluation, y.data(), input);
  bool const forever = std::isinf(step);
  if (!forever) rate *= step;
  bool const solved = (forever ? system.factorise_steady() : system.factorise(step)) &&
                      system.solve_nodes(rate, 1e-12 * rate.norm(), change);
  return solved ? change : Eigen::VectorXd::Constant(y.size(), std::nan(""));
}

bool newton(Evaluation& evaluation, NewtonSystem& system, Eigen::VectorXd& y, double const* input) {
  for (int iteration = 0; iteration < 30; ++iteration) {
    Eigen::VectorXd const change = implicit_step(evaluation, system, y, input, INFINITY);
    if (!change.allFinite()) return false;
    double const largest = change.cwiseAbs().maxCoeff();
    y += change * std::min(1.0, 20.0 / std::max(largest, 1e-300));
    if (largest < 1e-10) return true;
  }
  return false;
}

}  // namespace

std::vector<double> steady_state(Network const& network, std::span<double const> input, std::span<double const> guess) {
  Evaluation evaluation(network);
  NewtonSystem system(network, choose_solver(network));
  Eigen::VectorXd y(network.nodes());
  for (int i = 0; i < network.nodes(); ++i) y[i] = network.state_of_temperature(i, guess[std::size_t(i)]);
  Eigen::VectorXd const start = y;
  if (!newton(evaluation, system, y, input.data())) {
    y = start;
    double step = 1.0;
    for (int k = 0; k < 400 && step < 1e9; ++k) {
      Eigen::VectorXd const change = implicit_step(evaluation, system, y, input.data(), step);
      bool const accepted = change.allFinite() && change.cwiseAbs().maxCoeff() < 5.0;
      if (accepted) y += change;
      step *= accepted ? 2.0 : 0.25;
    }
    if (!newton(evaluation, system, y, input.data()))
      throw IntegrationError("no steady state was found: neither Newton's method nor time stepping settled");
  }
  std::vector<double> temperatures(guess.size());
  for (int i = 0; i < network.nodes(); ++i) temperatures[std::size_t(i)] = network.temperature_of_state(i, y[i]);
  return temperatures;
}

}  // namespace thermotwin::thermal
