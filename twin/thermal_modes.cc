#include "twin/thermal_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <fmt/format.h>
#include <numeric>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "thermal/evaluation.h"
#include "thermal/integrate.h"
#include "thermal/nearest_name.h"
#include "thermal/physical_constant.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<double> mean_of(thermal::Course const& course, std::span<double const> times) {
  std::vector<double> values(course.channels().size()), mean(values.size());
  for (double t : times) {
    course.evaluate(t, values);
    for (std::size_t i = 0; i < values.size(); ++i) mean[i] += values[i] / double(times.size());
  }
  return mean;
}

/// In the order of the network's channels.
std::vector<double> inputs_of(thermal::Network const& network, std::vector<thermal::InputChannel> const& channels,
                              std::vector<double> const& values) {
  std::vector<std::string> given;
  for (auto const& channel : channels) given.push_back(channel.name);
  std::vector<double> input(std::size_t(network.channels()), 0.5);
  for (int i = 0; i < network.external_channels(); ++i) {
    auto const& name = network.channel_names()[std::size_t(i)];
    auto const it = std::find(given.begin(), given.end(), name);
    if (it == given.end())
      throw thermal::InputError(fmt::format("the machine needs the input '{}', which the experiment does not give; {}",
                                            name, thermal::did_you_mean(name, given)));
    input[std::size_t(i)] = values[std::size_t(it - given.begin())];
  }
  return input;
}

/// A = C^−½ K C^−½ of the bodies, and C^−½, with C the capacities at that state. As the network knows J = ∂(dy/dt)/∂y
/// of its enthalpy temperatures, with s = dT/dy: A_ij = −J_ij √(C_i/C_j) s_i/s_j.
struct ScaledNetwork {
  std::vector<Index> bodies;  ///< nodes that are no controller's state
  MatrixXd A;
  VectorXd inverse_root;  ///< C^−½
};

ScaledNetwork scaled(thermal::Network const& network, OperatingState const& at) {
  Index const n = network.nodes();
  auto const temperature = Eigen::Map<VectorXd const>(at.temperatures.data(), n).array();
  auto const relative_slope = Eigen::Map<VectorXd const>(network.capacity_slope().data(), n).array();
  VectorXd const stretch = 1.0 + relative_slope * (temperature - thermal::reference_temperature);  // dy/dT
  VectorXd const capacity = Eigen::Map<VectorXd const>(network.capacity().data(), n).cwiseProduct(stretch);
  VectorXd const root = capacity.cwiseSqrt(), to_row = root.cwiseQuotient(stretch);
  ScaledNetwork result;
  VectorXd state(n);
  for (int i = 0; i < n; ++i) {
    state(i) = network.state_of_temperature(i, temperature(i));
    if (!network.signals()[std::size_t(i)]) result.bodies.push_back(i);
  }
  thermal::Evaluation evaluation(network);
  MatrixXd const jacobian = evaluation.jacobian(state.data(), at.input.data());
  MatrixXd const A = -(to_row.asDiagonal() * jacobian * to_row.cwiseInverse().asDiagonal());
  result.A = A(result.bodies, result.bodies);
  result.inverse_root = root(result.bodies).cwiseInverse();
  return result;
}

/// Decay rates [1/s], slowest first, and their real shapes.
struct Decay {
  VectorXd rate;
  MatrixXd shape;
  int complex_pairs = 0;
};

Decay symmetric_decay(MatrixXd const& A, int count) {
  Eigen::SelfAdjointEigenSolver<MatrixXd> const solver(A);
  return {solver.eigenvalues().head(count), solver.eigenvectors().leftCols(count)};
}

Decay general_decay(MatrixXd const& A, int count) {
  Eigen::EigenSolver<MatrixXd> const solver(A);
  auto const& lambda = solver.eigenvalues();
  Eigen::MatrixXcd const shapes = solver.eigenvectors();
  std::vector<Index> order(std::size_t(A.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return lambda(a).real() < lambda(b).real(); });
  // Of a pair, which stands side by side, the first gives the real part of its shape, the second the imaginary one.
  Decay decay{VectorXd(count), MatrixXd(A.rows(), count)};
  for (Index k = 0; k < count; ++k) {
    auto const value = lambda(order[std::size_t(k)]);
    auto const shape = shapes.col(order[std::size_t(k)]);
    decay.rate(k) = value.real();
    decay.shape.col(k) = value.imag() < 0.0 ? VectorXd(shape.imag()) : VectorXd(shape.real());
    decay.complex_pairs += value.imag() > 0.0 ? 1 : 0;
  }
  return decay;
}

MatrixXd seen(std::vector<NodeWeights const*> const& channels, MatrixXd const& nodes) {
  MatrixXd result = MatrixXd::Zero(Index(channels.size()), nodes.cols());
  for (std::size_t c = 0; c < channels.size(); ++c)
    for (auto const& [node, weight] : *channels[c]) result.row(Index(c)) += weight * nodes.row(node);
  return result;
}

void bring_to_one(Eigen::Ref<VectorXd> shape) {
  Index largest = 0;
  if (shape.cwiseAbs().maxCoeff(&largest) > 0.0) shape /= shape(largest);
}

void check(thermal::Network const& network, int count) {
  if (network.nodes() > largest_modal_network)
    throw thermal::InputError(fmt::format(
        "thermal modes are computed for up to {} nodes; this machine has {} (take its lumped form, or coarser cells)",
        largest_modal_network, network.nodes()));
  auto const bodies = std::count(network.signals().begin(), network.signals().end(), char(0));
  if (count < 1 || count > bodies)
    throw thermal::InputError(fmt::format("{} thermal modes are asked for; this machine has {}", count, bodies));
}

}  // namespace

OperatingState mean_state(Machine const& machine, scenarios::Experiment const& experiment) {
  return mean_state(machine, scenarios::ExperimentCourse(experiment, machine.limits),
                    scenarios::sample_times(experiment), experiment.ambient.mean);
}

OperatingState mean_state(Machine const& machine, thermal::Course const& course, std::span<double const> times,
                          double near) {
  OperatingState at{{}, inputs_of(machine.network(), course.channels(), mean_of(course, times))};
  std::vector<double> const guess(std::size_t(machine.network().nodes()), near);
  at.temperatures = thermal::steady_state(machine.network(), at.input, guess);
  return at;
}

ThermalModes thermal_modes(Machine const& machine, OperatingState const& at, int count) {
  auto const& network = machine.network();
  check(network, count);
  auto const system = scaled(network, at);
  ThermalModes modes;
  modes.asymmetry = (system.A - system.A.transpose()).norm() / system.A.norm();
  bool const symmetric = modes.asymmetry < 1e-12;
  auto const decay = symmetric ? symmetric_decay(system.A, count) : general_decay(system.A, count);
  modes.time_constant = decay.rate.cwiseInverse();
  modes.complex_pairs = decay.complex_pairs;
  modes.nodes = MatrixXd::Zero(network.nodes(), count);
  modes.nodes(system.bodies, Eigen::all) = system.inverse_root.asDiagonal() * decay.shape;
  for (Index k = 0; k < count; ++k) bring_to_one(modes.nodes.col(k));
  std::vector<NodeWeights const*> sensors, displacements;
  for (auto const& sensor : machine.sensors) sensors.push_back(&sensor.weights);
  for (auto const& channel : machine.displacements) displacements.push_back(&channel.weights);
  modes.sensors = seen(sensors, modes.nodes);
  modes.displacements = seen(displacements, modes.nodes);
  if (!symmetric)
    modes.remark = fmt::format(
        "the network is unsymmetric by {:.2g} (flow or friction): modes of the full matrix, {}", modes.asymmetry,
        modes.complex_pairs == 0 ? "all real" : fmt::format("{} complex pairs", modes.complex_pairs));
  return modes;
}

}  // namespace thermotwin::twin
