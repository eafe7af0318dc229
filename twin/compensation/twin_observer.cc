#include "twin/compensation/twin_observer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/physical_constant.h"
#include "thermal/units.h"
#include "twin/diagnosis/standing_input.h"
#include "twin/edge_unit.h"
#include "twin/room_air.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_nodes = 400;
constexpr double most_steps = 1000.0;  ///< between two decisions; beyond, steps are longer, which ROS2 survives
constexpr double gamma_of_ros2 = 1.0 - 0.70710678118654752;
constexpr char const* floor_temperature = "ambient.floor_temperature";
constexpr double um_per_m = 1e6;

Displacement displacement_of(Machine const& machine, std::string const& name) {
  std::vector<std::string> known;
  for (auto const& displacement : machine.linear_channels) {
    if (displacement.name == name && displacement.rotation)
      throw thermal::InputError(
          fmt::format("'{}' of the machine is an angle; the twin observes displacements in um", name));
    if (displacement.name == name) return displacement;
    known.push_back(displacement.name);
  }
  for (auto const& screw : machine.screws)
    if (!screw.is_linear() && name.starts_with(screw.description.name + "_"))
      throw thermal::InputError(
          fmt::format("'{}' is the error along a screw that loses its pretension; the twin observes what is linear in "
                      "temperatures: displacements, and errors along other screws",
                      name));
  throw thermal::InputError(
      fmt::format("the machine has no displacement '{}'; {}", name, thermal::did_you_mean(name, known)));
}

/// Edge unit of every channel that an experiment knows.
std::string unit_of(std::vector<thermal::InputChannel> const& known, std::string const& name) {
  auto const it = std::find_if(known.begin(), known.end(), [&](auto const& c) { return c.name == name; });
  return it == known.end() ? "1" : edge_unit(*it);
}

double to_si(double number, std::string const& unit) { return unit == "1" ? number : thermal::from_unit(number, unit); }

void require_observable(Machine const& machine) {
  if (!machine.network().relays().empty())
    throw thermal::InputError(fmt::format("the relay '{}' switches by itself; the twin observes no machine with relays",
                                          machine.network().relays().front().name));
  if (machine.network().nodes() > most_nodes)
    throw thermal::InputError(fmt::format("{} has {} nodes; the twin observes machines of at most {}, in lumped form",
                                          machine.name, machine.network().nodes(), most_nodes));
}

std::vector<std::string> on_bodies(Machine const& machine) {
  std::vector<std::string> names;
  for (auto const& sensor : machine.sensors)
    if (!sensor.weights.empty()) names.push_back(sensor.description.name);
  return names;
}

}  // namespace

TwinObserver::TwinObserver(Machine machine, std::string const& displacement, ObserverOptions const& options,
                           std::optional<std::vector<std::string>> const& sensors)
    : machine_(std::move(machine)), displacement_(displacement_of(machine_, displacement)), options_(options) {
  require_observable(machine_);
  list_channels();
  list_inputs();
  list_sensors(sensors);
  evaluation_ = std::make_shared<thermal::Evaluation>(machine_.network());
}

void TwinObserver::list_channels() {
  auto const& network = machine_.network();
  for (int i = 0; i < network.external_channels(); ++i) channels_.push_back({network.channel_names()[std::size_t(i)]});
  for (auto const& term : displacement_.input_terms)
    if (std::none_of(channels_.begin(), channels_.end(), [&](auto const& c) { return c.name == term.channel; }))
      channels_.push_back({term.channel});
}

void TwinObserver::list_inputs() {
  scenarios::Experiment any;
  any.duration = 1.0;
  auto const known = scenarios::ExperimentCourse(any, machine_.limits).channels();
  auto const add = [&](std::string const& name) { inputs_.push_back({name, unit_of(known, name), false, true}); };
  add("ambient.temperature");
  for (auto const& channel : channels_) {
    if (channel.name != floor_temperature && channel.name != "ambient.temperature") add(channel.name);
    if (channel.name == "ambient.gradient") add("ambient.reference_height");
  }
}

void TwinObserver::list_sensors(std::optional<std::vector<std::string>> const& names) {
  auto const known = on_bodies(machine_);
  for (auto const& name : names.value_or(known)) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw thermal::InputError(
          fmt::format("the twin has no sensor '{}' on a body; {}", name, thermal::did_you_mean(name, known)));
    inputs_.push_back({name, "degC", true, false});
    sensors_.push_back(std::size_t(std::find_if(machine_.sensors.begin(), machine_.sensors.end(),
                                                [&](auto const& sensor) { return sensor.description.name == name; }) -
                                   machine_.sensors.begin()));
  }
}

double TwinObserver::given(std::string const& name, std::span<double const> values, double otherwise) const {
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    if (!inputs_[i].sensor && inputs_[i].name == name) return to_si(values[i], inputs_[i].unit);
  return otherwise;
}

/// The air is taken to be as warm below as above unless the gradient is among the inputs.
double TwinObserver::floor_air(std::span<double const> values) const {
  return given("ambient.temperature", values, 0.0) -
         given("ambient.gradient", values, 0.0) * given("ambient.reference_height", values, 0.0);
}

void TwinObserver::set_channels(std::span<double const> values) {
  for (auto& channel : channels_) channel.value = given(channel.name, values, floor_air(values));
}

double TwinObserver::seen(NodeWeights const& weights) const {
  double sum = 0.0;
  for (auto const& [node, weight] : weights)
    sum += weight * machine_.network().temperature_of_state(node, state_[node]);
  return sum;
}

VectorXd TwinObserver::gradient(NodeWeights const& weights) const {
  VectorXd h = VectorXd::Zero(state_.size());
  auto const& network = machine_.network();
  for (auto const& [node, weight] : weights) {
    double const warmer = network.temperature_of_state(node, state_[node]) - thermal::reference_temperature;
    h[node] += weight / (1.0 + network.capacity_slope()[std::size_t(node)] * warmer);
  }
  return h;
}

double TwinObserver::displaced() const {
  double sum = seen(displacement_.weights);
  for (auto const& term : displacement_.input_terms)
    for (auto const& channel : channels_)
      if (channel.name == term.channel)
        sum += term.coefficient * (std::pow(channel.value, term.power) - std::pow(channel.first, term.power));
  return um_per_m * sum;
}

void TwinObserver::start_at(std::vector<double> const& temperatures) {
  auto const& network = machine_.network();
  state_.resize(network.nodes());
  for (int i = 0; i < network.nodes(); ++i) {
    auto const node = std::size_t(i);
    state_[i] = network.state_of_temperature(i, network.signals()[node] ? 0.0 : temperatures[node]);
  }
}

/// All that has a place is as warm as the air at its height.
void TwinObserver::start_in_air(std::span<double const> values) {
  double const floor = floor_air(values), gradient = given("ambient.gradient", values, 0.0);
  VectorXd const air = floor + gradient * heights_of_nodes(machine_).array();
  start_at({air.begin(), air.end()});
}

/// What is known of a machine that is as warm as the air around it, and what its sensors show beyond that.
RunBegin TwinObserver::begin(std::span<double const> readings) const {
  auto const& network = machine_.network();
  RunBegin begin;
  for (int i = 0; i < network.nodes(); ++i) begin.rest.push_back(network.temperature_of_state(i, state_[i]));
  begin.given.assign(std::size_t(network.given_channels()), 0.0);
  begin.standing = begin.given;
  for (std::size_t i = 0; i < std::size_t(network.external_channels()); ++i) {
    auto const& channel = channels_[i];
    auto const input =
        std::find_if(inputs_.begin(), inputs_.end(), [&](auto const& one) { return one.name == channel.name; });
    bool const is_temperature = input != inputs_.end() && input->unit == "degC";
    begin.given[i] = channel.value;
    if (is_given_while_standing(channel.name, is_temperature)) begin.standing[i] = channel.value;
  }
  auto& [names, weights, rise] = begin.first;
  weights.setZero(Index(sensors_.size()), network.nodes());
  rise.resize(Index(sensors_.size()));
  for (std::size_t j = 0; j < sensors_.size(); ++j) {
    auto const& sensor = machine_.sensors[sensors_[j]];
    if (std::isnan(readings[j])) continue;
    auto const row = Index(names.size());
    names.push_back(sensor.description.name);
    for (auto const& [node, weight] : sensor.weights) weights(row, node) += weight;
    rise[row] = readings[j] + thermal::zero_celsius - seen(sensor.weights);
  }
  weights.conservativeResize(Index(names.size()), Eigen::NoChange);
  rise.conservativeResize(Index(names.size()));
  return begin;
}

/// From a start in the air.
void TwinObserver::start_warm(std::span<double const> values) {
  auto const begun = begin(values.last(sensors_.size()));
  auto const warmth = warm_start(machine_, begun);
  if (!warmth) return;
  std::call_once(heated_->once, [&] { heated_->states.emplace(machine_); });
  auto const likely = heated_->states->likely(begun, *warmth);
  auto temperatures = begun.rest;
  VectorXd::Map(temperatures.data(), Index(temperatures.size())) += likely.rise;
  start_at(temperatures);
  VectorXd shown = VectorXd::Zero(likely.rise.size());
  for (auto const& [node, weight] : displacement_.weights) shown[node] += weight;
  warm_begin_ = {warmth->farthest, likely.contradicted, um_per_m * std::sqrt(shown.dot(likely.covariance * shown))};
}

void TwinObserver::start(double time, std::span<double const> values) {
  set_channels(values);
  for (auto& channel : channels_) channel.first = channel.value;
  if (known_start_) {
    start_at(*known_start_);
  } else {
    start_in_air(values);
    start_warm(values);
  }
  covariance_ = MatrixXd::Zero(state_.size(), state_.size());
  zero_readings_ = VectorXd::Map(values.data(), Index(values.size())).tail(Index(sensors_.size()));
  for (std::size_t const s : sensors_) zero_seen_.push_back(seen(machine_.sensors[s].weights));
  zero_displaced_ = displaced();
  time_ = time;
  started_ = true;
}

void TwinObserver::step(double h) {
  std::vector<double> input(std::size_t(machine_.network().channels()));
  for (int i = 0; i < machine_.network().external_channels(); ++i)
    input[std::size_t(i)] = channels_[std::size_t(i)].value;
  Index const n = state_.size();
  MatrixXd const jacobian = evaluation_->jacobian(state_.data(), input.data());
  MatrixXd const identity = MatrixXd::Identity(n, n);
  Eigen::PartialPivLU<MatrixXd> const stage(identity - gamma_of_ros2 * h * jacobian);
  VectorXd rate(n);
  evaluation_->rate(state_.data(), input.data(), rate.data());
  VectorXd const k1 = stage.solve(rate);
  VectorXd const ahead = state_ + h * k1;
  evaluation_->rate(ahead.data(), input.data(), rate.data());
  VectorXd const k2 = stage.solve(rate - 2.0 * k1);
  state_ += h * (1.5 * k1 + 0.5 * k2);

  Eigen::PartialPivLU<MatrixXd> const implicit(identity - h * jacobian);
  MatrixXd const moved = implicit.solve(covariance_);
  covariance_ = implicit.solve(moved.transpose());
  for (Index i = 0; i < n; ++i)
    if (!machine_.network().signals()[std::size_t(i)])
      covariance_(i, i) += options_.heat_noise * options_.heat_noise * h;
}

void TwinObserver::advance(double time) {
  double const steps = std::min(std::ceil((time - time_) / options_.longest_step), most_steps);
  for (int i = 0; i < int(steps); ++i) step((time - time_) / steps);
  time_ = time;
}

/// One sensor after another, with the Joseph form of the covariance, which keeps it symmetric and positive.
void TwinObserver::correct(std::span<double const> values, double elapsed) {
  double const variance = options_.sensor_noise * options_.sensor_noise / elapsed;
  auto const readings = values.last(sensors_.size());
  for (std::size_t j = 0; j < sensors_.size(); ++j) {
    if (std::isnan(readings[j])) continue;
    auto const& weights = machine_.sensors[sensors_[j]].weights;
    double const change = seen(weights) - zero_seen_[j];
    if (std::isnan(zero_readings_[Index(j)])) {
      zero_readings_[Index(j)] = readings[j] - change;
      continue;
    }
    double const missed = readings[j] - zero_readings_[Index(j)] - change;
    VectorXd const h = gradient(weights);
    VectorXd const gain = covariance_ * h / (h.dot(covariance_ * h) + variance);
    state_ += gain * missed;
    MatrixXd const kept = MatrixXd::Identity(state_.size(), state_.size()) - gain * h.transpose();
    covariance_ = (kept * covariance_ * kept.transpose() + variance * gain * gain.transpose()).eval();
  }
}

double TwinObserver::error(double time, std::span<double const> values) {
  if (!started_) start(time, values);
  if (double const elapsed = time - time_; elapsed > 0.0) {
    advance(time);
    set_channels(values);
    correct(values, elapsed);
  }
  return displaced() - zero_displaced_;
}

double TwinObserver::change(std::string const& sensor) const {
  for (std::size_t j = 0; j < sensors_.size(); ++j)
    if (auto const& known = machine_.sensors[sensors_[j]]; known.description.name == sensor)
      return seen(known.weights) - zero_seen_[j];
  throw thermal::InputError(fmt::format("the machine has no sensor '{}' on a body", sensor));
}

VectorXd TwinObserver::temperatures() const {
  VectorXd result(state_.size());
  for (Index i = 0; i < result.size(); ++i) result[i] = machine_.network().temperature_of_state(int(i), state_[i]);
  return result;
}

}  // namespace thermotwin::twin
