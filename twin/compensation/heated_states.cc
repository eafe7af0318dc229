#include "twin/compensation/heated_states.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "thermal/physical_constant.h"
#include "twin/challenge/challenge_runs.h"
#include "twin/diagnosis/likelihood_of_rest.h"
#include "twin/parallel.h"
#include "twin/room_air.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::uint64_t histories = 4;    // of three runs each
constexpr double between_states = 300.0;  // [s]
constexpr double run_tolerance = 1e-4;    // of the integration
constexpr double input_width = 0.1;       // of an input's range
constexpr double reading_width = 2.0;     // [K]
constexpr double fewest_alike = 40.0;     // states
constexpr double widening = 1.5;
constexpr double least_weight = 1e-4;  // of the largest
// What the sensors are tried to show of heat from elsewhere, rms, from and to, in steps of [K]
constexpr double least_elsewhere = 0.5, most_elsewhere = 40.0, elsewhere_step = 1.4142;
constexpr double how_wrong = 10.0;  // a sensor may be [K]

/// Not counters, clocks and temperatures.
bool heats(std::string_view channel) {
  std::array<std::string_view, 6> constexpr what{"speed", "moving_speed", "feed", "duty", "running", "on"};
  return std::find(what.begin(), what.end(), channel.substr(channel.rfind('.') + 1)) != what.end();
}

std::vector<std::size_t> heating_channels(thermal::Network const& network) {
  std::vector<std::size_t> channels;
  for (std::size_t i = 0; i < std::size_t(network.external_channels()); ++i)
    if (heats(network.channel_names()[i])) channels.push_back(i);
  return channels;
}

struct States {
  MatrixXd rise, inputs;
};

/// A run's states, over the air at the height of each node.
States states_of(Machine const& machine, std::vector<std::size_t> const& heating, scenarios::Experiment experiment) {
  experiment.sampling = between_states;
  RunOptions options;
  options.integration.relative_tolerance = options.integration.absolute_tolerance = run_tolerance;
  options.node_temperatures = true;
  auto const data = run(machine, experiment, options).dataset;
  scenarios::ExperimentCourse const course(experiment, machine.limits);
  RoomAir const air(course);
  VectorXd const heights = heights_of_nodes(machine);
  auto const& network = machine.network();
  std::vector<double> values(course.channels().size());
  States states{data.node_temperatures->transpose().cast<double>(),
                MatrixXd(Index(heating.size()), data.time_s.size())};
  for (Index s = 0; s < data.time_s.size(); ++s) {
    course.evaluate(data.time_s[s], values);
    for (Index i = 0; i < heights.size(); ++i)
      states.rise(i, s) = network.signals()[std::size_t(i)]
                              ? 0.0
                              : states.rise(i, s) + thermal::zero_celsius - air.at(heights[i], values);
    for (std::size_t c = 0; c < heating.size(); ++c) {
      int const place = course.index_of(network.channel_names()[heating[c]]);
      states.inputs(Index(c), s) = place < 0 ? 0.0 : values[std::size_t(place)];
    }
  }
  return states;
}

double effective(VectorXd const& weights) { return std::pow(weights.sum(), 2) / weights.squaredNorm(); }

/// What readings differ by from what is expected of them, Gaussian.
struct Differences {
  MatrixXd own, other;  ///< H root of the machine's own heat, and of heat from elsewhere
  VectorXd missed;      ///< d − H mean

  /// `wrong`: the sensor that tells nothing; −1: none.
  [[nodiscard]] MatrixXd covariance(double elsewhere, Index wrong) const {
    MatrixXd cov = covariance_of_rest(missed.size()) + own * own.transpose();
    cov += elsewhere * elsewhere * other * other.transpose();
    if (wrong >= 0) cov(wrong, wrong) += how_wrong * how_wrong;
    return cov;
  }
};

/// √κ and the sensor that is wrong, such that the differences are likeliest.
struct Explanation {
  double elsewhere = 0.0;
  Index wrong = -1;
  double likelihood = -std::numeric_limits<double>::infinity();  ///< 2 ln
};

Explanation likeliest(Differences const& differences, Index wrong) {
  double const per_root = differences.other.norm() / std::sqrt(double(differences.missed.size()));
  Explanation best;
  for (double rms = least_elsewhere; rms < most_elsewhere; rms *= elsewhere_step) {
    double const root = rms / per_root, found = likelihood(differences.covariance(root, wrong), differences.missed);
    if (found > best.likelihood) best = {root, wrong, found};
  }
  return best;
}

Explanation likeliest(Differences const& differences) {
  auto best = likeliest(differences, -1);
  best.likelihood += evident_gain;
  for (Index wrong = 0; wrong < differences.missed.size(); ++wrong)
    if (auto const one = likeliest(differences, wrong); one.likelihood > best.likelihood) best = one;
  return best;
}

}  // namespace

HeatedStates::HeatedStates(Machine const& machine) : heating_(heating_channels(machine.network())) {
  std::vector<scenarios::Experiment> experiments;
  for (std::uint64_t seed = 1; seed <= histories; ++seed)
    for (auto& experiment : challenge_runs(machine.limits, seed)) experiments.push_back(std::move(experiment));
  std::vector<States> parts(experiments.size());
  try {
    in_parallel(parts.size(), [&](std::size_t e) { parts[e] = states_of(machine, heating_, experiments[e]); });
  } catch (thermal::InputError const&) {
    return;
  } catch (thermal::IntegrationError const&) {
    return;
  }
  Index count = 0;
  for (auto const& part : parts) count += part.rise.cols();
  rise_.resize(machine.network().nodes(), count);
  inputs_.resize(Index(heating_.size()), count);
  Index at = 0;
  for (auto const& part : parts) {
    rise_.middleCols(at, part.rise.cols()) = part.rise;
    inputs_.middleCols(at, part.rise.cols()) = part.inputs;
    at += part.rise.cols();
  }
  range_ = inputs_.rowwise().maxCoeff() - inputs_.rowwise().minCoeff();
}

VectorXd HeatedStates::weights(RunBegin const& begin) const {
  auto const& first = begin.first;
  VectorXd unlike = ((first.weights * rise_).colwise() - first.rise).colwise().squaredNorm().transpose() /
                    (double(first.rise.size()) * reading_width * reading_width);
  for (std::size_t c = 0; c < heating_.size(); ++c)
    if (double const width = input_width * range_[Index(c)]; width > 0.0)
      unlike.array() += 0.5 * ((inputs_.row(Index(c)).array() - begin.given[heating_[c]]) / width).square().transpose();
  unlike.array() -= unlike.minCoeff();
  VectorXd weights;
  for (double width = 1.0; weights.size() == 0 || effective(weights) < fewest_alike; width *= widening)
    weights = (-unlike.array() / (width * width)).exp();
  return weights / weights.sum();
}

HeatedStates::Own HeatedStates::own(RunBegin const& begin) const {
  Index const nodes = begin.first.weights.cols();
  if (double(rise_.cols()) < fewest_alike) return {VectorXd::Zero(nodes), MatrixXd(nodes, 0)};
  VectorXd const weights = this->weights(begin);
  std::vector<Index> alike;
  for (Index s = 0; s < weights.size(); ++s)
    if (weights[s] > least_weight * weights.maxCoeff()) alike.push_back(s);
  VectorXd const mean = rise_ * weights;
  return {mean, (rise_(Eigen::all, alike).colwise() - mean) * weights(alike).cwiseSqrt().asDiagonal()};
}

HeatedStates::Likely HeatedStates::likely(RunBegin const& begin, WarmStart const& otherwise) const {
  auto const& [sensors, seen, rise] = begin.first;
  auto const own = this->own(begin);
  Differences const differences{seen * own.root, seen * otherwise.fields, rise - seen * own.mean};
  auto const best = likeliest(differences);
  MatrixXd root(own.mean.size(), own.root.cols() + otherwise.fields.cols());
  root.leftCols(own.root.cols()) = own.root;
  root.rightCols(otherwise.fields.cols()) = best.elsewhere * otherwise.fields;
  MatrixXd const told = root * (seen * root).transpose();
  Eigen::LLT<MatrixXd> const factor(differences.covariance(best.elsewhere, best.wrong));
  return {own.mean + told * factor.solve(differences.missed),
          root * root.transpose() - told * factor.solve(told.transpose()),
          best.wrong < 0 ? std::string() : sensors[std::size_t(best.wrong)]};
}

}  // namespace thermotwin::twin
