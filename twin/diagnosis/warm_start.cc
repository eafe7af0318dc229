#include "twin/diagnosis/warm_start.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unordered_map>

#include "thermal/error.h"
#include "thermal/evaluation.h"
#include "thermal/integrate.h"
#include "twin/diagnosis/channel_reading.h"
#include "twin/diagnosis/likelihood_of_rest.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/diagnosis/standing_input.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index fewest_sensors = 4;   // one of them left out
constexpr Index most_nodes = 500;     // K is decomposed whole
constexpr double least_field = 0.05;  // [K]
constexpr std::size_t most_named = 3;
constexpr double loosest = 1e-6;  // λ of K, of its largest: nothing is tied less to the rest
// What first readings are tried to differ by in the mean, from and to, in steps of [K]
constexpr double least_rise = 0.3, largest_rise = 40.0, rise_step = 1.4142;

std::vector<double> at_rest(Machine const& machine, MeasuredRun const& run) {
  scenarios::Experiment start;
  start.initial_temperature = run.initial_temperature;
  return initial_temperatures(machine, start, *run.course);
}

FirstReadings first_readings(Machine const& machine, MeasuredRun const& run, std::vector<double> const& rest) {
  auto const readings = readings_of(machine, run);
  std::vector<double> inputs(run.course->channels().size());
  run.course->evaluate(0.0, inputs);
  FirstReadings first;
  first.weights.setZero(Index(readings.size()), machine.network().nodes());
  first.rise.resize(Index(readings.size()));
  Index count = 0;
  for (std::size_t c = 0; c < readings.size(); ++c) {
    auto const& reading = readings[c];
    double const shown = run.first_reading(Index(c));
    if (!reading.sensor || reading.sensor->weights.empty() || std::isnan(shown)) continue;
    double body = 0.0;
    for (auto const& [node, weight] : reading.sensor->weights) {
      first.weights(count, node) += (1.0 - reading.air_share) * weight;
      body += weight * rest[std::size_t(node)];
    }
    first.sensors.push_back(reading.sensor->description.name);
    first.rise[count++] = shown - reading.offset - reading.before_lag(body, inputs, inputs);
  }
  first.weights.conservativeResize(count, Eigen::NoChange);
  first.rise.conservativeResize(count);
  return first;
}

std::string farthest(FirstReadings first) {
  std::vector<std::string> texts;
  Index place = 0;
  while (texts.size() < most_named && first.rise.cwiseAbs().maxCoeff(&place) > 0.0) {
    texts.push_back(fmt::format("{} {:+.1f} K", first.sensors[std::size_t(place)], first.rise[place]));
    first.rise[place] = 0.0;
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// What the machine is given where the run begins; `standing`: of that, temperatures and the room.
std::vector<double> input_at_begin(thermal::Network const& network, MeasuredRun const& run, bool standing) {
  auto const& channels = run.course->channels();
  std::vector<double> values(channels.size()), input(std::size_t(network.given_channels()), 0.0);
  run.course->evaluate(0.0, values);
  for (int i = 0; i < network.external_channels(); ++i) {
    int const place = run.course->index_of(network.channel_names()[std::size_t(i)]);
    if (place < 0) continue;
    auto const& channel = channels[std::size_t(place)];
    if (!standing || is_given_while_standing(channel.name, channel.unit == "K"))
      input[std::size_t(i)] = values[std::size_t(place)];
  }
  return input;
}

/// t: how much warmer the machine is than at rest when it has stood for long [K]. Nothing where it does not settle.
VectorXd rise_of_standing(Machine const& machine, RunBegin const& begin) {
  auto const& network = machine.network();
  auto const& rest = begin.rest;
  VectorXd rise = VectorXd::Zero(network.nodes());
  try {
    auto const steady = thermal::steady_state(network, begin.standing, rest);
    for (Index i = 0; i < rise.size(); ++i)
      if (!network.signals()[std::size_t(i)]) rise[i] = steady[std::size_t(i)] - rest[std::size_t(i)];
  } catch (thermal::IntegrationError const&) {
    rise.setZero();
  }
  return rise;
}

/// K, at rest with what the run is given where it begins.
MatrixXd conductances(Machine const& machine, RunBegin const& begin) {
  auto const& network = machine.network();
  auto const state = thermal::start_of_run(network, begin.rest, 0.0).state;
  auto const capacity = VectorXd::Map(network.capacity().data(), network.nodes());
  MatrixXd const jacobian = thermal::Evaluation(network).jacobian(state.data(), begin.given.data());
  MatrixXd const K = -(capacity.asDiagonal() * jacobian);
  return 0.5 * (K + K.transpose());
}

/// F of K⁻¹ = F Fᵀ; a controller's state has no warmth.
MatrixXd root_of_inverse(MatrixXd const& K, std::vector<char> const& signals) {
  std::vector<Index> bodies;
  for (Index i = 0; i < K.rows(); ++i)
    if (!signals[std::size_t(i)]) bodies.push_back(i);
  Eigen::SelfAdjointEigenSolver<MatrixXd> const modes(K(bodies, bodies));
  double const least = loosest * modes.eigenvalues().maxCoeff();
  VectorXd const scale = modes.eigenvalues().cwiseMax(least).cwiseSqrt().cwiseInverse();
  MatrixXd F = MatrixXd::Zero(K.rows(), Index(bodies.size()));
  F(bodies, Eigen::all) = modes.eigenvectors() * scale.asDiagonal();
  return F;
}

/// What nothing gains more than, for each field widens cov(d): dᵀ cov(d)⁻¹ d.
double most_gain(MatrixXd const& rest, VectorXd const& rise) {
  return rise.dot(Eigen::LLT<MatrixXd>(rest).solve(rise));
}

struct Likeliest {
  double root = 0.0;  ///< √κ
  double gain = 0.0;  ///< of 2 ln likelihood, over none
};

/// `shown`: H F.
Likeliest likeliest(MatrixXd const& rest, MatrixXd const& shown, VectorXd const& rise) {
  double const none = likelihood(rest, rise);
  MatrixXd const square = shown * shown.transpose();
  double const per_root = std::sqrt(square.trace() / double(shown.rows()));
  Likeliest best;
  for (double rms = least_rise; rms < largest_rise; rms *= rise_step) {
    double const root = rms / per_root, gain = likelihood(rest + root * root * square, rise) - none;
    if (gain > best.gain) best = {root, gain};
  }
  return best;
}

/// One sensor that is wrong by kelvins is no warm machine.
bool is_evident(MatrixXd const& rest, MatrixXd const& shown, VectorXd const& rise) {
  for (Index left_out = 0; left_out < rise.size(); ++left_out) {
    std::vector<Index> others;
    for (Index i = 0; i < rise.size(); ++i)
      if (i != left_out) others.push_back(i);
    if (likeliest(rest(others, others), shown(others, Eigen::all), rise(others)).gain < evident_gain) return false;
  }
  return true;
}

/// √κ of the likeliest, where it is evident, or the machine has a past anyway; else 0.
double credible_root(MatrixXd const& rest, MatrixXd const& shown, VectorXd const& rise, bool has_past) {
  return has_past || is_evident(rest, shown, rise) ? likeliest(rest, shown, rise).root : 0.0;
}

/// Of what a node is coupled to and whose rows are known.
Eigen::RowVectorXd mean_beside(thermal::Network const& network, int node, std::vector<char> const& is_known,
                               MatrixXd const& rows) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(rows.cols());
  double weight = 0.0;
  auto const add = [&](Index other, double share) {
    if (!is_known[std::size_t(other)]) return;
    sum += share * rows.row(other);
    weight += share;
  };
  Index const averages = network.nodes() + Index(network.boundaries().size());
  for (Eigen::SparseMatrix<double>::InnerIterator it(network.port_pattern(), node); it; ++it) {
    if (it.row() < network.nodes()) add(it.row(), 1.0);
    if (it.row() < averages) continue;
    auto const& average = network.averages()[std::size_t(it.row() - averages)];
    for (std::size_t i = 0; i < average.nodes.size(); ++i) add(average.nodes[i], average.weights[i]);
  }
  return weight > 0.0 ? Eigen::RowVectorXd(sum / weight) : sum;
}

}  // namespace

MatrixXd WarmStart::fields_in(thermal::Network const& network) const {
  std::unordered_map<std::string, Index> known;
  for (std::size_t i = 0; i < nodes.size(); ++i) known.emplace(nodes[i], Index(i));
  std::vector<char> is_known;
  MatrixXd result = MatrixXd::Zero(network.nodes(), fields.cols());
  for (int i = 0; i < network.nodes(); ++i) {
    auto const it = known.find(network.node_name(i));
    is_known.push_back(it != known.end());
    if (is_known.back()) result.row(i) = fields.row(it->second);
  }
  for (int i = 0; i < network.nodes(); ++i)
    if (!is_known[std::size_t(i)] && !network.signals()[std::size_t(i)])
      result.row(i) = mean_beside(network, i, is_known, result);
  return result;
}

std::optional<WarmStart> warm_start(Machine const& machine, RunBegin const& begin, bool another_has_past) {
  auto const& network = machine.network();
  if (network.nodes() > most_nodes) return {};
  auto const& first = begin.first;
  MatrixXd cov = covariance_of_rest(first.rise.size());
  double const asked = another_has_past ? 0.0 : evident_gain;
  if (first.rise.size() < fewest_sensors || most_gain(cov, first.rise) < asked) return {};
  VectorXd standing = rise_of_standing(machine, begin);
  VectorXd const seen = first.weights * standing;
  bool const stood =
      seen.cwiseAbs().maxCoeff() >= least_field && credible_root(cov, seen, first.rise, another_has_past) > 0.0;
  if (stood)
    cov += seen * seen.transpose();
  else
    standing.setZero();
  MatrixXd const F = root_of_inverse(conductances(machine, begin), network.signals());
  MatrixXd const past = credible_root(cov, first.weights * F, first.rise, stood || another_has_past) * F;
  MatrixXd fields(network.nodes(), past.cols() + 1);
  fields << past, standing;
  std::vector<Index> kept;
  for (Index k = 0; k < fields.cols(); ++k)
    if (fields.col(k).cwiseAbs().maxCoeff() > least_field) kept.push_back(k);
  if (kept.empty()) return {};
  MatrixXd const shown = first.weights * past;
  VectorXd const unlikely = Eigen::LLT<MatrixXd>(cov + shown * shown.transpose()).solve(first.rise);
  WarmStart result;
  for (int i = 0; i < network.nodes(); ++i) result.nodes.push_back(network.node_name(i));
  result.fields = fields(Eigen::all, kept);
  result.likely = result.fields.transpose() * first.weights.transpose() * unlikely;
  result.farthest = farthest(first);
  return result;
}

std::optional<WarmStart> warm_start(Machine const& machine, MeasuredRun const& run, bool another_has_past) {
  auto const& network = machine.network();
  auto const rest = at_rest(machine, run);
  return warm_start(machine,
                    {rest, input_at_begin(network, run, false), input_at_begin(network, run, true),
                     first_readings(machine, run, rest)},
                    another_has_past);
}

std::vector<double> start_of(Machine const& machine, MeasuredRun const& run) {
  auto temperatures = at_rest(machine, run);
  if (run.warm_start)
    VectorXd::Map(temperatures.data(), Index(temperatures.size())) +=
        run.warm_start->fields_in(machine.network()) * run.warm_start->likely;
  return temperatures;
}

}  // namespace thermotwin::twin
