#include "thermal/forward_sensitivities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "thermal/physical_constant.h"

namespace thermotwin::thermal {
namespace {

constexpr std::size_t longest_past = 6;    // from which a step of order 5 is predicted
constexpr double solver_tolerance = 1e-9;  // of solvers that iterate
constexpr int most_parts = 4096;

std::vector<NetworkDerivative const*> addresses(std::vector<NetworkDerivative> const& parameters,
                                                std::vector<std::size_t> const& chosen) {
  std::vector<NetworkDerivative const*> all;
  for (std::size_t const k : chosen) all.push_back(&parameters[k]);
  return all;
}

struct Share {
  double share;
  NodeByParameter const& S;
};

template <std::size_t... k>
void add_up(std::vector<Share> const& shares, double* sum, std::index_sequence<k...>) {
  auto const size = shares.front().S.size();
  std::array const share{shares[k].share...};
  std::array const S{shares[k].S.data()...};
#pragma omp simd
  for (Eigen::Index i = 0; i < size; ++i) sum[i] = (... + (share[k] * S[k][i]));
}

/// Σ share · S of up to so many matrices, in one pass over all of them: the sum stays in registers.
template <std::size_t most = longest_past + 2>
void add_up(std::vector<Share> const& shares, NodeByParameter& sum) {
  if constexpr (most > 1) {
    if (shares.size() < most) return add_up<most - 1>(shares, sum);
  }
  sum.resize(shares.front().S.rows(), shares.front().S.cols());
  add_up(shares, sum.data(), std::make_index_sequence<most>());
}

}  // namespace

ForwardSensitivities::Parts ForwardSensitivities::parts_of(std::vector<NetworkDerivative> const& parameters) {
  Parts parts;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    (ParameterColumns::has(parameters[k]) ? parts.together : parts.apart).push_back(k);
  return parts;
}

ForwardSensitivities::ForwardSensitivities(Network const& network, std::vector<NetworkDerivative> const& parameters,
                                           LinearSolver solver, double tolerance)
    : ForwardSensitivities(network, parameters, solver, tolerance, parts_of(parameters)) {}

ForwardSensitivities::ForwardSensitivities(Network const& network, std::vector<NetworkDerivative> const& parameters,
                                           LinearSolver solver, double tolerance, Parts parts)
    : network_(&network),
      parameters_(&parameters),
      parts_(std::move(parts)),
      columns_(network, addresses(parameters, parts_.together)),
      evaluation_(network),
      newton_(network, solver) {
  per_tolerance_.resize(Eigen::Index(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    per_tolerance_[Eigen::Index(k)] = (parameters[k].scale != 0.0 ? std::abs(parameters[k].scale) : 1.0) / tolerance;
}

void ForwardSensitivities::start(double time, double const* state) {
  auto const& parameters = *parameters_;
  NodeByParameter S = NodeByParameter::Zero(network_->nodes(), Eigen::Index(parameters.size()));
  for (int i = 0; i < network_->nodes(); ++i) {
    auto const node = std::size_t(i);
    double const rise = network_->temperature_of_state(i, state[i]) - reference_temperature;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      auto const& parameter = parameters[k];
      double const dT = parameter.initial_temperature.empty() ? 0.0 : parameter.initial_temperature[node];
      S(i, Eigen::Index(k)) =
          dT * (1.0 + network_->capacity_slope()[node] * rise) + 0.5 * rise * rise * parameter.capacity_slope[node];
    }
  }
  past_.clear();
  past_.push_back({time, std::move(S)});
  order_ = 0;
}

void ForwardSensitivities::restart(double time) {
  NodeByParameter S;
  interpolate(time, S);
  past_.clear();
  past_.push_back({time, std::move(S)});
  order_ = 0;
}

/// F, into which the columns of the two kinds are put together.
NodeByParameter const& ForwardSensitivities::forcing(Instant const& at) {
  auto const& [state, input] = at;
  if (parts_.apart.empty()) {
    columns_.evaluate(evaluation_, newton_.linearisation(), state, input, forcing_);
    return forcing_;
  }
  columns_.evaluate(evaluation_, newton_.linearisation(), state, input, together_);
  forcing_.resize(network_->nodes(), Eigen::Index(parameters_->size()));
  for (std::size_t k = 0; k < parts_.together.size(); ++k)
    forcing_.col(Eigen::Index(parts_.together[k])) = together_.col(Eigen::Index(k));
  Eigen::VectorXd const still = Eigen::VectorXd::Zero(network_->nodes());
  Eigen::VectorXd column(network_->nodes());
  for (std::size_t const k : parts_.apart) {
    evaluation_.rate_derivative(state, still.data(), (*parameters_)[k], input, column.data());
    forcing_.col(Eigen::Index(k)) = column;
  }
  return forcing_;
}

bool ForwardSensitivities::step(double end, int order, std::function<Instant(double)> const& run) {
  for (; past_.size() > longest_past; past_.pop_back()) spare_ = std::move(past_.back().S);
  int parts = 1;  // of what is left
  while (past_.front().time < end) {
    double const begin = past_.front().time;
    double const time = parts == 1 ? end : begin + (end - begin) / parts;
    order_ = std::min(order, int(past_.size()));
    if (!advance(time, run(time))) return false;
    if (double const excess = error(); excess > 1.0 && parts < most_parts) {
      spare_ = std::move(past_.front().S);
      past_.pop_front();
      parts = int(std::ceil(parts * std::clamp(1.2 * std::pow(excess, 1.0 / (order_ + 1)), 1.5, 10.0)));
      continue;
    }
    parts = std::max(1, parts - 1);
  }
  return true;
}

/// One step of the formula, to where the run is at this instant.
bool ForwardSensitivities::advance(double time, Instant const& at) {
  auto const points = std::size_t(order_);
  double at_end = 0.0;
  for (std::size_t i = 0; i < points; ++i) at_end += 1.0 / (time - past_[i].time);
  gamma_ = 1.0 / at_end;
  newton_.linearise(evaluation_, at.state, at.input);
  if (!newton_.factorise(gamma_)) return false;
  std::vector<Share> shares = {{gamma_, forcing(at)}};
  for (std::size_t i = 0; i < points; ++i)  // dᵢ = −Lᵢ(t)/(t − tᵢ)
    shares.push_back({gamma_ * weight(i, 0, points, time) / (time - past_[i].time), past_[i].S});
  NodeByParameter S = std::move(spare_);
  add_up(shares, S);
  bool const solved = newton_.solve_nodes(solver_tolerance, S);
  past_.push_front({time, std::move(S)});
  return solved;
}

/// Of the newest point, in units of the tolerance; 0 while the past is too short to predict it.
double ForwardSensitivities::error() {
  auto const points = std::size_t(order_) + 1;
  if (past_.size() <= points) return 0.0;
  double const time = past_[0].time;
  std::vector<Share> shares = {{1.0, past_[0].S}};
  for (std::size_t i = 1; i <= points; ++i) shares.push_back({-weight(i, 1, points + 1, time), past_[i].S});
  add_up(shares, at_time_);
  double const factor = gamma_ / (time - past_[points].time);
  Eigen::VectorXd const size = at_time_.colwise().norm().transpose() / std::sqrt(double(network_->nodes()));
  return factor * size.cwiseProduct(per_tolerance_).maxCoeff();
}

/// Lᵢ(t) of Lagrange's polynomials through the points from `first` to before `end`.
double ForwardSensitivities::weight(std::size_t i, std::size_t first, std::size_t end, double time) const {
  double product = 1.0;
  for (std::size_t j = first; j < end; ++j)
    if (j != i) product *= (time - past_[j].time) / (past_[i].time - past_[j].time);
  return product;
}

/// By the polynomial of the part of the last step in which the time lies.
void ForwardSensitivities::interpolate(double time, NodeByParameter& S) const {
  std::size_t first = 0;
  while (first + 2 < past_.size() && past_[first + 1].time > time) ++first;
  std::size_t const end = std::min(first + std::size_t(order_) + 1, past_.size());
  std::vector<Share> shares;
  for (std::size_t i = first; i < end; ++i) shares.push_back({weight(i, first, end, time), past_[i].S});
  add_up(shares, S);
}

NodeByParameter const& ForwardSensitivities::temperatures(double time, double const* state) {
  interpolate(time, at_time_);
  for (int i = 0; i < network_->nodes(); ++i) {
    double const slope = network_->capacity_slope()[std::size_t(i)];
    double const rise = network_->temperature_of_state(i, state[i]) - reference_temperature;
    for (std::size_t const k : parts_.apart)
      at_time_(i, Eigen::Index(k)) -= 0.5 * rise * rise * (*parameters_)[k].capacity_slope[std::size_t(i)];
    if (slope != 0.0) at_time_.row(i) /= 1.0 + slope * rise;
  }
  return at_time_;
}

}  // namespace thermotwin::thermal
