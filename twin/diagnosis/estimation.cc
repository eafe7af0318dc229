#include "twin/diagnosis/estimation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "thermal/error.h"
#include "twin/diagnosis/least_squares.h"
#include "twin/parallel.h"

namespace thermotwin::twin {
namespace {

constexpr double offset_deviation = 0.3;    // of a temperature sensor [K]
constexpr double zero_deviation = 1e-6;     // of a displacement's zero [m]
constexpr double unread_zero = 200e-6;      // where the run begins before the channel was read
constexpr double usual_lag = 30.0;          // [s]
constexpr double lag_deviation = 25.0;      // [s]
constexpr double start_deviation = 0.3;     // [K]
constexpr double air_deviation = 0.2;       // [K]
constexpr double input_deviation = 0.7;     // of the response to what may have been given instead
constexpr double interior_deviation = 0.5;  // of a lump: half of a slab
constexpr double relative_step = 1e-4;
constexpr int start_halvings = 4;

void scale(thermal::NetworkDerivative& d, double factor) {
  auto const times = [&](std::vector<double>& values) {
    for (double& v : values) v *= factor;
  };
  times(d.capacity);
  times(d.boundary_offset);
  for (auto& group : d.coefficients) times(group);
  for (auto& weights : d.boundary_weights) times(weights);
}

/// The room air, wherever the machine meets it, one kelvin warmer.
thermal::NetworkDerivative warmer_air(thermal::Network const& network) {
  thermal::NetworkDerivative d = thermal::lengthened({}, network);
  auto const& names = network.channel_names();
  for (std::size_t b = 0; b < network.boundaries().size(); ++b)
    for (auto const& term : network.boundaries()[b].terms)
      if (names[std::size_t(term.channel)] == "ambient.floor_temperature") d.boundary_offset[b] = 1.0;
  return d;
}

bool moves_tool(MachineDerivative const& derivative) {
  return std::any_of(derivative.displacements.begin(), derivative.displacements.end(), [](auto const& weights) {
    return std::any_of(weights.begin(), weights.end(), [](auto const& w) { return w.second != 0.0; });
  });
}

bool changes_heat(thermal::NetworkDerivative const& d) {
  auto const any = [](std::vector<double> const& values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
  };
  return any(d.capacity) || any(d.boundary_offset) || std::any_of(d.coefficients.begin(), d.coefficients.end(), any) ||
         std::any_of(d.boundary_weights.begin(), d.boundary_weights.end(), any);
}

/// Every sensor one second slower.
Machine later(Machine machine) {
  for (auto& sensor : machine.sensors) sensor.description.lag = sensor.description.lag.value_or(0.0) + 1.0;
  return machine;
}

/// Besides the lag that the file states, which is known to a third or a second; without that, the usual one.
Unknown lag_unknown(std::vector<Sensor> const& sensors, std::string const& channel, std::size_t index) {
  Unknown unknown{Unknown::Kind::lag, "lag of " + channel, usual_lag, lag_deviation, 0.0, INFINITY, index, -1};
  for (auto const& sensor : sensors)
    if (sensor.description.name == channel && sensor.description.lag) {
      double const stated = *sensor.description.lag;
      unknown.mean = 0.0;
      unknown.deviation = std::max(1.0, stated / 3.0);
      unknown.lower = -stated;
    }
  return unknown;
}

/// A probe's zero is anywhere: where it stood when it was first read, the machine had not moved yet, unless it has a
/// past.
Unknown zero_unknown(MeasuredChannel const& channel, std::size_t index, std::size_t run) {
  auto const& values = channel.values;
  auto const first = std::find_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
  return {Unknown::Kind::offset,
          fmt::format("zero of {}, run {}", channel.name, run + 1),
          first == values.end() ? 0.0 : *first,
          first == values.begin() ? zero_deviation : unread_zero,
          -INFINITY,
          INFINITY,
          index,
          int(run)};
}

/// What the channels show more where this course is the machine's.
Eigen::VectorXd response_to(std::shared_ptr<thermal::Course const> const& course, Machine const& machine,
                            BinnedRun const& data, Eigen::MatrixXd const& prediction) {
  MeasuredRun run = *data.run;
  run.course = course;
  BinnedRun other = data;
  other.run = &run;
  return (LinearisedRun(machine, other).prediction() - prediction).reshaped();
}

std::string table_name(std::size_t effect) { return fmt::format("diagnosed_{}", effect + 1); }

/// What people see of an added effect acts through sensors or displacements, not through heat alone.
bool is_read_directly(Hypothesis const& hypothesis) {
  auto const& changes = hypothesis.effect->changes;
  return changes.find("sensor") != std::string::npos || changes.find("deformation") != std::string::npos;
}

}  // namespace

Fit without(Fit fit, Eigen::Index unknown) {
  auto const prior = fit.residual.size() - fit.x.size() + unknown;
  fit.residual -= fit.jacobian.col(unknown) * fit.x[unknown];
  fit.residual[prior] = 0.0;
  fit.jacobian.col(unknown).setZero();
  fit.jacobian(prior, unknown) = 1.0;
  return fit;
}

Estimation::Estimation(Value document, std::vector<BinnedRun> const& data, std::vector<std::string> const& channels,
                       std::vector<ChannelNoise> const& noise)
    : document_(std::move(document)), data_(&data), channels_(channels), noise_(noise) {
  numbers_ = uncertain_numbers(document_);
  for (auto const& number : numbers_) number_derivatives_.push_back(differentiate(document_, number.path));
  for (auto const& run : data) {
    first_rows_.push_back(rows_);
    rows_ += run.values.size();
  }
  LumpInteriors const interiors(document_);
  add_unknowns(interiors);
  make_whitenings();
  find_linear_columns(interiors);
}

void Estimation::add_unknowns(LumpInteriors const& interiors) {
  using Kind = Unknown::Kind;
  auto const sensors = Machine::build(document_).sensors;
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    unknowns_.push_back(
        {Kind::number, numbers_[i].path, 0.0, numbers_[i].deviation, numbers_[i].lower, numbers_[i].upper, i, -1});
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    auto const holds = [&](MeasuredChannel const& channel) { return channel.name == channels_[c]; };
    bool sensor = false;
    for (std::size_t r = 0; r < data_->size(); ++r) {
      auto const& all = (*data_)[r].run->channels;
      auto const it = std::find_if(all.begin(), all.end(), holds);
      if (it == all.end()) continue;
      sensor = sensor || !it->displacement;
      if (it->displacement) unknowns_.push_back(zero_unknown(*it, c, r));
    }
    if (!sensor) continue;
    unknowns_.push_back({Kind::offset, "offset of " + channels_[c], 0.0, offset_deviation, -INFINITY, INFINITY, c, -1});
    unknowns_.push_back(lag_unknown(sensors, channels_[c], c));
  }
  for (std::size_t r = 0; r < data_->size(); ++r) {
    unknowns_.push_back({Kind::start, fmt::format("warm start of run {}", r + 1), 0.0, start_deviation, -INFINITY,
                         INFINITY, 0, int(r)});
    unknowns_.push_back(
        {Kind::air, fmt::format("air in run {}", r + 1), 0.0, air_deviation, -INFINITY, INFINITY, 0, int(r)});
    auto const& alternatives = (*data_)[r].run->alternatives;
    for (std::size_t a = 0; a < alternatives.size(); ++a)
      unknowns_.push_back({Kind::input, fmt::format("{}, run {}", alternatives[a].name, r + 1), 0.0, input_deviation,
                           -INFINITY, INFINITY, a, int(r)});
  }
  for (std::size_t i = 0; i < interiors.unknowns().size(); ++i)
    unknowns_.push_back(
        {Kind::interior, interiors.unknowns()[i].name, 0.0, interior_deviation, -INFINITY, INFINITY, i, -1});
}

void Estimation::make_whitenings() {
  whitenings_.clear();
  for (auto const& run : *data_) {
    auto& own = whitenings_.emplace_back();
    for (std::size_t c = 0; c < run.run->channels.size(); ++c) {
      auto const it = std::find(channels_.begin(), channels_.end(), run.run->channels[c].name);
      own.push_back(whitening_of(noise_[std::size_t(it - channels_.begin())], run, Eigen::Index(c)));
    }
  }
}

void Estimation::whiten(Eigen::Ref<Eigen::MatrixXd> signals) const {
  for (std::size_t r = 0; r < data_->size(); ++r) {
    auto const rows = (*data_)[r].time.size();
    for (std::size_t c = 0; c < whitenings_[r].size(); ++c)
      whitenings_[r][c].apply(signals.middleRows(first_rows_[r] + Eigen::Index(c) * rows, rows));
  }
}

/// Offsets, the start, the air and what lumps hide: small, so that their response at the prior machine serves
/// throughout. And what was given in gaps, of which a share is estimated: in proportion to its heat, of which only what
/// is stored is seen.
void Estimation::find_linear_columns(LumpInteriors const& interiors) {
  linear_.clear();
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    if (unknowns_[u].kind == Unknown::Kind::offset || unknowns_[u].kind == Unknown::Kind::start ||
        unknowns_[u].kind == Unknown::Kind::air || unknowns_[u].kind == Unknown::Kind::input ||
        unknowns_[u].kind == Unknown::Kind::interior)
      linear_.push_back(u);
  linear_columns_.setZero(rows_, Eigen::Index(linear_.size()));
  Machine const machine = Machine::build(document_);
  auto const air = warmer_air(machine.network());
  auto const none = thermal::lengthened({}, machine.network());
  thermal::ParameterColumns const both(machine.network(), {&none, &air});
  Eigen::MatrixXd initial = Eigen::MatrixXd::Zero(machine.network().nodes(), 2);
  initial.col(0).setOnes();
  for (std::size_t r = 0; r < data_->size(); ++r) {
    auto const& run = (*data_)[r];
    LinearisedRun const twin(machine, run);
    Eigen::MatrixXd const response = twin.response(both, initial), prediction = twin.prediction();
    Eigen::MatrixXd const within = interiors.responses(run);
    auto const rows = run.time.size();
    for (std::size_t l = 0; l < linear_.size(); ++l) {
      auto const& unknown = unknowns_[linear_[l]];
      if (unknown.run >= 0 && unknown.run != int(r)) continue;
      auto column = linear_columns_.col(Eigen::Index(l)).segment(first_rows_[r], run.values.size());
      if (unknown.kind == Unknown::Kind::start) column = response.col(0);
      if (unknown.kind == Unknown::Kind::air) column = response.col(1);
      if (unknown.kind == Unknown::Kind::interior) column = within.col(Eigen::Index(unknown.index));
      if (unknown.kind == Unknown::Kind::input)
        column = response_to(run.run->alternatives[unknown.index].course, machine, run, prediction);
      if (unknown.kind != Unknown::Kind::offset) continue;
      for (std::size_t c = 0; c < run.run->channels.size(); ++c)
        if (run.run->channels[c].name == channels_[unknown.index])
          column.segment(Eigen::Index(c) * rows, rows).setOnes();
    }
  }
  whitened_linear_columns_ = linear_columns_;
  whiten(whitened_linear_columns_);
}

Estimation Estimation::with(std::vector<ChannelNoise> const& noise) const {
  Estimation other = *this;
  other.noise_ = noise;
  other.make_whitenings();
  other.whitened_linear_columns_ = linear_columns_;
  other.whiten(other.whitened_linear_columns_);
  return other;
}

Estimation Estimation::with(std::vector<Hypothesis> const& effects) const {
  Estimation other = *this;
  for (auto const& effect : effects) {
    bool const both = effect.trial->either_sign;
    other.unknowns_.push_back({Unknown::Kind::amplitude, effect.label(), 0.0, amplitude_deviation,
                               both ? -most_of_largest : 1e-9, most_of_largest, other.effects_.size(), -1});
    other.effects_.push_back(effect);
  }
  return other;
}

Estimation Estimation::knowing(std::vector<std::size_t> const& unknowns) const {
  Estimation other = *this;
  for (std::size_t const u : unknowns) other.unknowns_[u].deviation *= 1e-4;
  return other;
}

Estimation Estimation::with_lumps() const {
  std::vector<std::size_t> hidden;
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    if (unknowns_[u].kind == Unknown::Kind::interior) hidden.push_back(u);
  return knowing(hidden);
}

Eigen::VectorXd Estimation::prior_mean() const {
  Eigen::VectorXd x(Eigen::Index(unknowns_.size()));
  for (std::size_t u = 0; u < unknowns_.size(); ++u) x[Eigen::Index(u)] = unknowns_[u].mean;
  return x;
}

Value Estimation::document_at(Eigen::VectorXd const& x) const {
  Value document = document_;
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    auto const& unknown = unknowns_[u];
    if (unknown.kind == Unknown::Kind::number) {
      auto const& number = numbers_[unknown.index];
      set_number(document, {number.path, number.nominal, number.dimension, false}, number.value(x[Eigen::Index(u)]));
    } else if (unknown.kind == Unknown::Kind::amplitude) {
      auto const& effect = effects_[unknown.index];
      document =
          with_hypothesis(std::move(document), effect, table_name(unknown.index), x[Eigen::Index(u)] * effect.largest);
    }
  }
  return document;
}

Machine Estimation::machine_at(Eigen::VectorXd const& x) const {
  Machine machine = Machine::build(document_at(x));
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    if (unknowns_[u].kind == Unknown::Kind::lag)
      for (auto& sensor : machine.sensors)
        if (sensor.description.name == channels_[unknowns_[u].index])
          sensor.description.lag = sensor.description.lag.value_or(0.0) + x[Eigen::Index(u)];
  return machine;
}

/// One per effect, in units of its trial's largest.
std::vector<MachineDerivative> Estimation::amplitude_derivatives(Eigen::VectorXd const& x) const {
  std::vector<MachineDerivative> derivatives;
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    if (unknowns_[u].kind != Unknown::Kind::amplitude) continue;
    double const step = relative_step * std::max(std::abs(x[Eigen::Index(u)]), 1e-6);
    Eigen::VectorXd plus = x, minus = x;
    plus[Eigen::Index(u)] += step;
    minus[Eigen::Index(u)] -= step;
    derivatives.push_back(difference(Machine::build(document_at(plus)), Machine::build(document_at(minus)), step));
  }
  return derivatives;
}

std::vector<Eigen::MatrixXd> Estimation::residuals_at(Eigen::VectorXd const& x) const {
  Machine const machine = machine_at(x);
  Eigen::VectorXd explained = Eigen::VectorXd::Zero(rows_);
  for (std::size_t l = 0; l < linear_.size(); ++l)
    explained += x[Eigen::Index(linear_[l])] * linear_columns_.col(Eigen::Index(l));
  std::vector<Eigen::MatrixXd> residuals;
  for (std::size_t r = 0; r < data_->size(); ++r) {
    auto const& run = (*data_)[r];
    residuals.push_back(run.values - LinearisedRun(machine, run).prediction());
    residuals.back() -=
        explained.segment(first_rows_[r], run.values.size()).reshaped(run.values.rows(), run.values.cols());
  }
  return residuals;
}

/// The twin along the data. The runs take a quarter of a fit: one serves the residual and then the Jacobian.
struct Estimation::Traced {
  Eigen::VectorXd x;
  Machine machine;
  std::vector<std::optional<LinearisedRun>> runs;
};

/// Nothing where a number left the range that a machine may have, or the machine cannot be run.
std::unique_ptr<Estimation::Traced const> Estimation::trace(Eigen::VectorXd const& x) const {
  std::unique_ptr<Traced> traced;
  try {
    traced = std::make_unique<Traced>(Traced{x, machine_at(x), {}});
  } catch (thermal::InputError const&) {
    return nullptr;
  }
  traced->runs.resize(data_->size());
  try {
    in_parallel(data_->size(), [&](std::size_t r) { traced->runs[r].emplace(traced->machine, (*data_)[r]); });
  } catch (std::exception const&) {
    return nullptr;
  }
  return traced;
}

bool Estimation::evaluate(Eigen::VectorXd const& x, std::unique_ptr<Traced const>& traced, Eigen::VectorXd& residual,
                          Eigen::MatrixXd* jacobian) const {
  auto const unknowns = Eigen::Index(unknowns_.size());
  if (!traced || traced->x != x) traced = trace(x);
  if (!traced) return false;
  Machine const& machine = traced->machine;
  auto const& network = machine.network();
  std::vector<thermal::NetworkDerivative> heat;
  std::vector<MachineDerivative> amplitudes;
  std::vector<Eigen::Index> columns;
  if (jacobian) {
    amplitudes = amplitude_derivatives(x);
    for (std::size_t u = 0; u < unknowns_.size(); ++u) {
      auto const& unknown = unknowns_[u];
      bool const number = unknown.kind == Unknown::Kind::number;
      if (!number && unknown.kind != Unknown::Kind::amplitude) continue;
      auto const& own = number ? number_derivatives_[unknown.index].network : amplitudes[unknown.index].network;
      if (!changes_heat(own)) continue;
      heat.push_back(thermal::lengthened(own, network));
      if (number) scale(heat.back(), numbers_[unknown.index].slope(x[Eigen::Index(u)]));
      columns.push_back(Eigen::Index(u));
    }
    jacobian->setZero(rows_ + unknowns, unknowns);
  }
  std::vector<thermal::NetworkDerivative const*> pointers;
  for (auto const& derivative : heat) pointers.push_back(&derivative);
  std::optional<thermal::ParameterColumns> parameters;
  if (jacobian) parameters.emplace(network, pointers);
  residual.setZero(rows_ + unknowns);
  auto const add_run = [&](std::size_t r) {
    auto const& run = (*data_)[r];
    LinearisedRun const& twin = *traced->runs[r];
    auto const first = first_rows_[r];
    auto const count = run.values.size();
    Eigen::MatrixXd const difference = run.values - twin.prediction();
    residual.segment(first, count) = difference.reshaped();
    if (!jacobian) return;
    Eigen::MatrixXd const slower = twin.prediction_of(later(machine));
    Eigen::MatrixXd const response = twin.response(*parameters);
    for (std::size_t k = 0; k < columns.size(); ++k)
      jacobian->col(columns[k]).segment(first, count) -= response.col(Eigen::Index(k));
    for (std::size_t u = 0; u < unknowns_.size(); ++u) {
      auto const& unknown = unknowns_[u];
      auto column = jacobian->col(Eigen::Index(u)).segment(first, count);
      if (unknown.kind == Unknown::Kind::lag)
        for (std::size_t c = 0; c < run.run->channels.size(); ++c)
          if (run.run->channels[c].name == channels_[unknown.index]) {
            auto const rows = run.time.size();
            column.segment(Eigen::Index(c) * rows, rows) =
                (difference - (run.values - slower)).col(Eigen::Index(c)) * -1.0;
          }
      if (unknown.kind == Unknown::Kind::number && moves_tool(number_derivatives_[unknown.index]))
        column -= numbers_[unknown.index].slope(x[Eigen::Index(u)]) *
                  twin.growth(number_derivatives_[unknown.index].displacements).reshaped();
      if (unknown.kind == Unknown::Kind::amplitude && is_read_directly(effects_[unknown.index])) {
        double const step = relative_step * std::max(std::abs(x[Eigen::Index(u)]), 1e-3);
        Eigen::VectorXd plus = x;
        plus[Eigen::Index(u)] += step;
        column -= ((twin.prediction_of(machine_at(plus)) - twin.prediction()) / step).reshaped();
      }
    }
  };
  try {
    in_parallel(data_->size(), add_run);
  } catch (std::exception const&) {
    return false;
  }
  for (Eigen::Index i = 0; i < rows_; ++i)
    if (std::isnan(residual[i])) residual[i] = 0.0;
  whiten(residual.head(rows_));
  for (std::size_t l = 0; l < linear_.size(); ++l)
    residual.head(rows_) -= x[Eigen::Index(linear_[l])] * whitened_linear_columns_.col(Eigen::Index(l));
  for (Eigen::Index u = 0; u < unknowns; ++u) {
    auto const& unknown = unknowns_[std::size_t(u)];
    residual[rows_ + u] = (x[u] - unknown.mean) / unknown.deviation;
    if (jacobian) (*jacobian)(rows_ + u, u) = 1.0 / unknown.deviation;
  }
  if (!jacobian) return true;
  whiten(jacobian->topRows(rows_));
  for (std::size_t l = 0; l < linear_.size(); ++l)
    jacobian->col(Eigen::Index(linear_[l])).head(rows_) = -whitened_linear_columns_.col(Eigen::Index(l));
  return true;
}

Fit Estimation::fit(Eigen::VectorXd const& start, int iterations) const {
  LeastSquares problem;
  std::unique_ptr<Traced const> traced;
  Fit linearised;  // where the Jacobian was asked for last
  problem.evaluate = [&](Eigen::VectorXd const& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    if (linearised.x.size() == x.size() && linearised.x == x) {
      r = linearised.residual;
      if (J) *J = linearised.jacobian;
      return true;
    }
    if (!evaluate(x, traced, r, J)) return false;
    if (J) linearised.x = x, linearised.residual = r, linearised.jacobian = *J;
    return true;
  };
  auto const count = Eigen::Index(unknowns_.size());
  problem.residuals = rows_ + count;
  problem.start = start;
  // So much of an effect may be more than a machine endures.
  for (int i = 0; i < start_halvings && !(traced = trace(problem.start)); ++i)
    problem.start.tail(Eigen::Index(effects_.size())) *= 0.5;
  problem.lower.resize(count);
  problem.upper.resize(count);
  for (Eigen::Index u = 0; u < count; ++u) {
    problem.lower[u] = unknowns_[std::size_t(u)].lower;
    problem.upper[u] = unknowns_[std::size_t(u)].upper;
  }
  problem.iterations = iterations;
  auto const solved = solve(problem);
  Fit fit;
  fit.x = solved.x;
  fit.converged = solved.converged;
  if (!problem.evaluate(fit.x, fit.residual, &fit.jacobian))
    throw thermal::InputError("the machine cannot be run with its nominal values on these data");
  fit.cost = fit.residual.squaredNorm();
  Eigen::LLT<Eigen::MatrixXd> const information((fit.jacobian.transpose() * fit.jacobian).eval());
  fit.covariance = information.solve(Eigen::MatrixXd::Identity(count, count));
  double const log_determinant = 2.0 * information.matrixLLT().diagonal().array().log().sum();
  fit.evidence = fit.cost + log_determinant;
  for (auto const& unknown : unknowns_) fit.evidence += 2.0 * std::log(unknown.deviation);
  for (auto const& effect : effects_) fit.evidence += effect.choice;
  for (auto const& unknown : unknowns_)
    if (unknown.kind == Unknown::Kind::amplitude && unknown.lower > 0.0) fit.evidence -= 2.0 * std::log(2.0);
  return fit;
}

}  // namespace thermotwin::twin
