#include <Eigen/SparseLU>
#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/integrate.h"

namespace thermotwin::thermal {
namespace {

/// One implicit Euler step of length `step` (infinite: a Newton step to the steady state), solved once linearly.
Eigen::VectorXd implicit_step(Evaluation& evaluation, Eigen::VectorXd const& y, double const* input, double step) {
  auto jacobian = evaluation.network().jacobian_pattern();
  evaluation.jacobian(y.data(), input, jacobian);
  Eigen::VectorXd rate(y.size());
  evaluation.rate(y.data(), input, rate.data());
  Eigen::SparseMatrix<double> matrix = -jacobian;
  if (std::isfinite(step))
    for (int i = 0; i < matrix.rows(); ++i) matrix.coeffRef(i, i) += 1.0 / step;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return Eigen::VectorXd::Constant(y.size(), std::nan(""));
  return solver.solve(rate);
}

bool newton(Evaluation& evaluation, Eigen::VectorXd& y, double const* input) {
  for (int iteration = 0; iteration < 30; ++iteration) {
    Eigen::VectorXd const change = implicit_step(evaluation, y, input, INFINITY);
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
  Eigen::VectorXd y(network.nodes());
  for (int i = 0; i < network.nodes(); ++i) y[i] = network.state_of_temperature(i, guess[std::size_t(i)]);
  Eigen::VectorXd const start = y;
  if (!newton(evaluation, y, input.data())) {
    y = start;
    double step = 1.0;
    for (int k = 0; k < 400 && step < 1e9; ++k) {
      Eigen::VectorXd const change = implicit_step(evaluation, y, input.data(), step);
      bool const accepted = change.allFinite() && change.cwiseAbs().maxCoeff() < 5.0;
      if (accepted) y += change;
      step *= accepted ? 2.0 : 0.25;
    }
    if (!newton(evaluation, y, input.data()))
      throw IntegrationError("no steady state was found: neither Newton's method nor time stepping settled");
  }
  std::vector<double> temperatures(guess.size());
  for (int i = 0; i < network.nodes(); ++i) temperatures[std::size_t(i)] = network.temperature_of_state(i, y[i]);
  return temperatures;
}

}  // namespace thermotwin::thermal
