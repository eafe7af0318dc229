#include "twin/live_twin.h"

#include <Eigen/LU>
#include <cmath>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<NodeWeights> sensor_weights(Machine const& machine) {
  std::vector<NodeWeights> weights;
  for (auto const& sensor : machine.sensors)
    if (!sensor.weights.empty()) weights.push_back(sensor.weights);
  return weights;
}

std::vector<NodeWeights> displacement_weights(Machine const& machine) {
  std::vector<NodeWeights> weights;
  for (auto const& channel : machine.displacements) weights.push_back(channel.weights);
  return weights;
}

/// P = A P (I + H P)⁻¹ Aᵀ + Q with H = CᵀR⁻¹C: the covariance before a correction, for a diagonal A.
MatrixXd steady_covariance(VectorXd const& decay, MatrixXd const& information, MatrixXd const& noise) {
  auto const n = decay.size();
  MatrixXd A = decay.asDiagonal(), G = information, P = noise;
  for (int k = 0; k < 60; ++k) {
    Eigen::PartialPivLU<MatrixXd> const lu(MatrixXd::Identity(n, n) + P * G);
    MatrixXd const forward = lu.solve(A.transpose()).transpose();  // A (I + P G)⁻¹
    MatrixXd const step = forward * P * A.transpose();
    MatrixXd const next_G = G + A.transpose() * G * lu.solve(A);
    P += 0.5 * (step + step.transpose());
    A = forward * A;
    G = 0.5 * (next_G + next_G.transpose());
    if (step.norm() < 1e-12 * P.norm()) break;
  }
  return P;
}

}  // namespace

LiveTwin::LiveTwin(ReducedTwin const& twin, double start_temperature, ObserverTrust const& trust)
    : twin_(&twin),
      evaluation_(twin.network()),
      sensors_(twin.network(), sensor_weights(twin.machine())),
      displacements_(twin.network(), displacement_weights(twin.machine())),
      interval_(trust.interval) {
  if (!(interval_ > 0.0)) throw thermal::InputError("the interval of a live twin must be positive");
  factors_.set(twin.network().decay(), interval_);
  std::vector<double> start(std::size_t(twin.machine().network().nodes()), start_temperature);
  for (std::size_t i = 0; i < start.size(); ++i)
    if (twin.machine().network().signals()[i]) start[i] = 0.0;
  state_ = twin.network().state_of(start);
  displacements_.evaluate(state_, first_displacements_);
  sensors_.evaluate(state_, seen_);
  find_gain(trust);
}

void LiveTwin::find_gain(ObserverTrust const& trust) {
  auto const& network = twin_->network();
  auto const weights = sensor_weights(twin_->machine());
  sensor_rows_.resize(Eigen::Index(weights.size()), network.size());
  for (std::size_t s = 0; s < weights.size(); ++s)
    sensor_rows_.row(Eigen::Index(s)) = network.functional(weights[s]).row;
  MatrixXd noise = MatrixXd::Identity(network.size(), network.size()) * 1e-12;
  double const strength = trust.unknown_heat * trust.unknown_heat * trust.heat_memory * trust.interval;
  for (auto const& group : network.groups())
    for (int e = 0; e < group.count(); ++e) {
      if (group.law->conservative()) continue;
      for (int p = 0; p < group.law->ports(); ++p) {
        VectorXd const shape = network.shape_of_port(group.ports[std::size_t(e * group.law->ports() + p)]);
        noise += strength * shape * shape.transpose();
      }
    }
  double const variance = trust.reading_noise * trust.reading_noise;
  MatrixXd const information = sensor_rows_.transpose() * sensor_rows_ / variance;
  MatrixXd const P = steady_covariance(factors_.decay.matrix(), information, noise);
  MatrixXd innovation = sensor_rows_ * P * sensor_rows_.transpose();
  innovation.diagonal().array() += variance;
  gain_ = innovation.partialPivLu().solve(sensor_rows_ * P).transpose();
}

void LiveTwin::advance(std::vector<double> const& input) {
  twin_->check_inputs(input);
  evaluation_.rest(state_, input.data(), begin_);
  state_ = factors_.decay * state_.array() + interval_ * factors_.phi1 * begin_.array();
  evaluation_.rest(state_, input.data(), end_);
  state_.array() += interval_ * factors_.phi2 * (end_ - begin_).array();
  sensors_.evaluate(state_, seen_);
}

void LiveTwin::correct(Eigen::VectorXd const& readings) {
  for (Eigen::Index s = 0; s < readings.size(); ++s)
    if (double const gap = readings[s] - seen_[s]; std::isfinite(gap)) state_ += gap * gain_.col(s);
  sensors_.evaluate(state_, seen_);
}

Eigen::VectorXd LiveTwin::displacements() const {
  VectorXd now;
  displacements_.evaluate(state_, now);
  return now - first_displacements_;
}

}  // namespace thermotwin::twin
