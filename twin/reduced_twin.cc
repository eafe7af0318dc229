#include "twin/reduced_twin.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "scenarios/course.h"
#include "thermal/course_inputs.h"
#include "thermal/error.h"
#include "thermal/physical_constant.h"
#include "thermal/reduced_integration.h"
#include "thermal/units.h"
#include "twin/edge_unit.h"
#include "twin/reduction_store.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

using Eigen::VectorXd;

constexpr double fine_step = 5e-5, coarse_step = 5e-4;  // [K]: tolerance of one step in time
constexpr double safety = 2.0;
constexpr double watched_reading = 0.01 /* K */, watched_displacement = 1e-7 /* m, rad */;

int middle_of(thermal::NodeRange const& body) { return body.first + body.count / 2; }

std::vector<NodeWeights> middles_of(thermal::Network const& network) {
  std::vector<NodeWeights> middles;
  for (auto const& body : network.ranges()) middles.push_back({{middle_of(body), 1.0}});
  return middles;
}

double sum_of_sizes(NodeWeights const& weights) {
  double sum = 0.0;
  for (auto const& [node, weight] : weights) sum += std::abs(weight);
  return sum;
}

std::vector<thermal::WatchedSum> tolerated(Machine const& machine) {
  std::vector<thermal::WatchedSum> watched;
  for (auto const& sensor : machine.sensors)
    if (!sensor.weights.empty()) watched.push_back({sensor.weights, watched_reading});
  for (auto const& channel : machine.displacements) watched.push_back({channel.weights, watched_displacement});
  for (auto const& screw : machine.screws)
    for (int i = 0; i + 1 < int(screw.screw.edges.size()); ++i)
      watched.push_back({{{screw.first_node + i, 1.0}}, watched_reading});
  return watched;
}

/// Everywhere the same, and growing with height: what the machine may be when a run begins.
Eigen::MatrixXd initial_rises(Machine const& machine) {
  Eigen::MatrixXd rises = Eigen::MatrixXd::Zero(machine.network().nodes(), 2);
  for (auto const& body : machine.geometry)
    for (std::size_t i = 0; i < body.cells.size(); ++i) {
      auto const node = Eigen::Index(body.first_node) + Eigen::Index(i);
      rises(node, 0) = 1.0;
      rises(node, 1) = centre(body.cells[i]).dot(machine.up);
    }
  return rises;
}

/// Spread of one experiment's inputs, seen every minute and on both sides of every jump.
void widen(thermal::Network const& network, thermal::Course const& course, double duration,
           std::vector<ReducedTwin::Limits>& limits) {
  thermal::CourseInputs inputs(network, course);
  double end = inputs.enter_piece(0.0);
  auto const see = [&](double t) {
    auto const& values = inputs.at(t);
    for (std::size_t i = 0; i < limits.size(); ++i) {
      limits[i].low = std::min(limits[i].low, values[i]);
      limits[i].high = std::max(limits[i].high, values[i]);
    }
  };
  for (double t = 0.0; t <= duration; t += 60.0) {
    while (end <= t) {
      see(end);
      end = inputs.enter_piece(end);
      see(t);
    }
    see(t);
  }
}

/// In which unit people see each input of the network.
std::vector<std::string> edge_units(thermal::Network const& network, thermal::Course const& course) {
  std::vector<std::string> units(std::size_t(network.external_channels()), "1");
  for (auto const& channel : course.channels())
    for (std::size_t i = 0; i < units.size(); ++i)
      if (network.channel_names()[i] == channel.name) units[i] = edge_unit(channel);
  return units;
}

/// Largest difference of every channel.
ReducedError difference(History const& fine, History const& coarse) {
  ReducedError bound;
  for (std::size_t s = 0; s < fine.machine().sensors.size(); ++s)
    bound.readings.push_back((fine.sensor_body(s) - coarse.sensor_body(s)).cwiseAbs().maxCoeff());
  for (std::size_t r = 0; r < fine.rows(); ++r) {
    VectorXd const gap = (fine.displacements_at(r) - coarse.displacements_at(r)).cwiseAbs();
    bound.displacements = r == 0 ? gap : VectorXd(bound.displacements.cwiseMax(gap));
  }
  return bound;
}

void keep_inputs(scenarios::ExperimentCourse const& course, output::Dataset& dataset) {
  std::vector<std::size_t> place;
  std::vector<thermal::Unit> units;
  for (auto const& shown : dataset.inputs) {
    units.push_back(read_edge_unit(shown.unit));
    for (std::size_t i = 0; i < course.channels().size(); ++i)
      if (course.channels()[i].name == shown.name) place.push_back(i);
  }
  std::vector<double> values(course.channels().size());
  for (Eigen::Index r = 0; r < dataset.time_s.size(); ++r) {
    course.evaluate(dataset.time_s[r], values);
    for (std::size_t k = 0; k < place.size(); ++k) dataset.inputs[k].values[r] = edge_value(values[place[k]], units[k]);
  }
}

void keep_truth(History const& history, output::Dataset& dataset) {
  for (Eigen::Index r = 0; r < dataset.time_s.size(); ++r) {
    auto const row = history.sampled()[std::size_t(r)];
    dataset.time_s[r] = history.looks()[row];
    VectorXd const readings = history.bodies_at(row), displacements = history.displacements_at(row);
    for (std::size_t s = 0; s < dataset.truth_readings.size(); ++s)
      dataset.truth_readings[s].values[r] = readings[Eigen::Index(s)] - thermal::zero_celsius;
    for (std::size_t c = 0; c < dataset.truth_displacements.size(); ++c)
      dataset.truth_displacements[c].values[r] = displacements[Eigen::Index(c)];
  }
}

}  // namespace

double ReducedError::largest_reading() const {
  return readings.empty() ? 0.0 : *std::max_element(readings.begin(), readings.end());
}

double ReducedError::largest_displacement() const { return displacements.size() == 0 ? 0.0 : displacements.maxCoeff(); }

ReducedTwin::Model::Model(Machine const& machine, thermal::LinearPart const& linear, thermal::Subspace const& subspace)
    : network(machine.network(), linear, subspace.shapes, subspace.elements),
      sums(network, watched_sums(machine)),
      middles(network, middles_of(machine.network())) {}

ReducedTwin::ReducedTwin(Machine const& machine, ReducedRange const& range,
                         std::optional<std::filesystem::path> const& kept,
                         std::function<void(std::string const&)> const& progress)
    : machine_(&machine) {
  auto const experiments = training_experiments(machine, range);
  std::vector<std::unique_ptr<scenarios::ExperimentCourse>> courses;
  thermal::ReductionTask task;
  double const infinity = std::numeric_limits<double>::infinity();
  limits_.assign(std::size_t(machine.network().external_channels()), {infinity, -infinity});
  initial_ = {range.coldest_air, range.warmest_air};
  for (auto const& experiment : experiments) {
    auto const& course =
        *courses.emplace_back(std::make_unique<scenarios::ExperimentCourse>(experiment, machine.limits));
    widen(machine.network(), course, experiment.duration, limits_);
    task.training.push_back({&course, initial_temperatures(machine, experiment, course), experiment.duration});
  }
  units_ = edge_units(machine.network(), *courses.front());
  task.watched = tolerated(machine);
  task.initial_rises = initial_rises(machine);
  auto const make = [&] {
    if (progress)
      progress(fmt::format("finding the shapes of {}{}", machine.name, kept ? ", once for this machine" : ""));
    return thermal::reduce(machine.network(), task);
  };
  auto const reduction =
      kept ? ReductionStore(*kept).find_or_make(reduction_key(machine.network(), task), make) : make();
  thermal::LinearPart const linear(machine.network(), reduction.reference);
  fine_ = std::make_unique<Model const>(machine, linear, reduction.fine);
  coarse_ = std::make_unique<Model const>(machine, linear, reduction.coarse);
  least_error_.readings.assign(machine.sensors.size(), 0.0);
  least_error_.displacements = VectorXd::Zero(Eigen::Index(displacement_channels(machine).size()));
  std::size_t next = 0;
  for (std::size_t s = 0; s < machine.sensors.size(); ++s)
    if (auto const& weights = machine.sensors[s].weights; !weights.empty())
      least_error_.readings[s] = reduction.training_error[next++] + coarse_step * sum_of_sizes(weights);
  for (std::size_t c = 0; c < machine.displacements.size(); ++c)
    least_error_.displacements[Eigen::Index(c)] =
        1e6 * (reduction.training_error[next++] + coarse_step * sum_of_sizes(machine.displacements[c].weights));
}

void ReducedTwin::check_inputs(std::vector<double> const& input) const {
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    double const slack = 1e-9 * (1.0 + std::abs(limits_[i].low) + std::abs(limits_[i].high));
    if (input[i] >= limits_[i].low - slack && input[i] <= limits_[i].high + slack) continue;
    auto const& unit = units_[i];
    auto const shown = [&](double value) { return unit == "1" ? value : thermal::to_unit(value, unit); };
    throw thermal::InputError(fmt::format(
        "the input '{}' is {:.5g} {}; the reduced model of '{}' was made for {:.5g} to {:.5g} {}: run in full",
        machine_->network().channel_names()[i], shown(input[i]), unit, machine_->name, shown(limits_[i].low),
        shown(limits_[i].high), unit));
  }
}

History ReducedTwin::history_of(Model const& model, scenarios::Experiment const& experiment,
                                scenarios::ExperimentCourse const& course, double tolerance,
                                ReducedResult& result) const {
  auto const start = initial_temperatures(*machine_, experiment, course);
  History history(*machine_, course, scenarios::sample_times(experiment));
  auto const& bodies = machine_->network().ranges();
  std::vector<double> inputs(course.channels().size());
  VectorXd middles, watched;
  auto const see = [&](thermal::ReducedSample const& sample) {
    check_inputs(sample.input);
    model.middles.evaluate(sample.state, middles);
    for (std::size_t b = 0; b < bodies.size(); ++b)
      check_temperature(machine_->network(), middle_of(bodies[b]), middles[Eigen::Index(b)], sample.time);
    course.evaluate(sample.time, inputs);
    model.sums.evaluate(sample.state, watched);
    history.add(inputs, {watched.data(), std::size_t(watched.size())});
  };
  auto const summary =
      thermal::integrate(model.network, course, model.network.state_of(start), history.looks(), tolerance, see);
  result.steps += summary.steps;
  result.rate_evaluations += summary.rate_evaluations;
  return history;
}

ReducedResult ReducedTwin::run(scenarios::Experiment const& experiment) const {
  if (experiment.initial_temperature &&
      (*experiment.initial_temperature < initial_.low || *experiment.initial_temperature > initial_.high))
    throw thermal::InputError(
        fmt::format("initial_temperature: {:.6g} °C; the reduced model of '{}' was made for {:.6g} to {:.6g} °C",
                    *experiment.initial_temperature - thermal::zero_celsius, machine_->name,
                    initial_.low - thermal::zero_celsius, initial_.high - thermal::zero_celsius));
  ReducedResult result;
  scenarios::ExperimentCourse const course(experiment, machine_->limits);
  check_laser(*machine_, experiment);
  auto const history = history_of(*fine_, experiment, course, fine_step, result);
  result.bound = difference(history, history_of(*coarse_, experiment, course, coarse_step, result));
  for (std::size_t s = 0; s < result.bound.readings.size(); ++s)
    result.bound.readings[s] = safety * result.bound.readings[s] + least_error_.readings[s];
  result.bound.displacements = safety * result.bound.displacements + least_error_.displacements;
  auto& dataset = result.dataset = head_of_run(*machine_, experiment, course);
  dataset.provenance["model"] = "reduced";
  output::resize_rows(dataset, Eigen::Index(history.sampled().size()));
  keep_truth(history, dataset);
  keep_inputs(course, dataset);
  measure(history, experiment, dataset);
  dataset.provenance["reduced.bound_K"] = thermal::format_number(result.bound.largest_reading());
  dataset.provenance["reduced.bound_um"] = thermal::format_number(result.bound.largest_displacement());
  return result;
}

}  // namespace thermotwin::twin
