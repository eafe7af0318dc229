#include "twin/diagnosis/estimation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <numeric>

#include "models/log_determinant.h"
#include "thermal/error.h"
#include "thermal/threaded_product.h"
#include "thermal/units.h"
#include "twin/diagnosis/least_squares.h"
#include "twin/file/document.h"
#include "twin/parallel.h"

namespace thermotwin::twin {
namespace {

constexpr double usual_lag = 30.0;      // [s]
constexpr double lag_deviation = 25.0;  // [s]
constexpr double most_lag = 900.0;      // that a sensor may have [s]
constexpr double relative_step = 1e-4;
constexpr int start_halvings = 4;
constexpr std::size_t numbers_at_once = 64;  // whose responses are found together
constexpr std::string_view cannot_be_run = "the machine cannot be run with its nominal values on these data";

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

/// A sensor slower by so much than the file says.
void add_lag(Value& document, std::string const& sensor, double more) {
  for (auto* table : tables_of(document, "temperature_sensor")) {
    if (name_in(*table) != sensor) continue;
    double const stated = number_in(*table, "lag", thermal::dimension::time).value_or(0.0);
    double const lag = std::clamp(stated + more, 0.0, most_lag);
    set_key(*table, "lag", thermal::format_quantity(lag, thermal::dimension::time));
  }
}

std::string table_name(std::size_t effect) { return fmt::format("diagnosed_{}", effect + 1); }

}  // namespace

Estimation::Estimation(Value document, std::vector<BinnedRun> const& data, std::vector<std::string> const& channels,
                       std::vector<ChannelNoise> const& noise)
    : document_(std::move(document)), data_(&data), channels_(channels) {
  numbers_ = uncertain_numbers(document_);
  derivatives_ = std::make_shared<NumberDerivatives const>(document_, numbers_);
  for (auto const& run : data) {
    first_rows_.push_back(rows_);
    rows_ += run.values.size();
  }
  add_numbers_and_lags();
  linear_ = std::make_shared<LinearUnknowns const>(document_at(prior_mean()), data, channels,  // with the usual lags
                                                   has_drawings(numbers_));
  first_linear_ = Eigen::Index(unknowns_.size());
  unknowns_.insert(unknowns_.end(), linear_->all().begin(), linear_->all().end());
  hear(noise);
}

void Estimation::add_numbers_and_lags() {
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    unknowns_.push_back({Unknown::Kind::number, numbers_[i].path, 0.0, numbers_[i].deviation, numbers_[i].lower,
                         numbers_[i].upper, i, -1});
  auto const sensors = Machine::build(document_).sensors;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    bool const sensor = std::any_of(data_->begin(), data_->end(), [&](BinnedRun const& run) {
      auto const& all = run.run->channels;
      return std::any_of(all.begin(), all.end(),
                         [&](auto const& own) { return own.name == channels_[c] && !own.displacement; });
    });
    if (sensor) unknowns_.push_back(lag_unknown(sensors, channels_[c], c));
  }
}

/// Whitens with this noise from now on.
void Estimation::hear(std::vector<ChannelNoise> const& noise) {
  noise_ = noise;
  whitenings_.clear();
  for (auto const& run : *data_) {
    auto& own = whitenings_.emplace_back();
    for (std::size_t c = 0; c < run.run->channels.size(); ++c) {
      auto const it = std::find(channels_.begin(), channels_.end(), run.run->channels[c].name);
      own.push_back(whitening_of(noise_[std::size_t(it - channels_.begin())], run, Eigen::Index(c)));
    }
  }
  Eigen::MatrixXd columns = linear_->columns();
  whiten(columns);
  eliminate(std::move(columns));
}

void Estimation::eliminate(Eigen::MatrixXd whitened_columns) {
  auto const count = whitened_columns.cols();
  Eigen::VectorXd mean(count), deviation(count);
  for (Eigen::Index l = 0; l < count; ++l) {
    auto const& unknown = unknowns_[std::size_t(first_linear_ + l)];
    mean[l] = unknown.mean;
    deviation[l] = unknown.deviation;
  }
  std::vector<Eigen::Index> first_rows;  // of every channel of every run
  for (std::size_t r = 0; r < data_->size(); ++r)
    for (std::size_t c = 0; c < whitenings_[r].size(); ++c)
      first_rows.push_back(first_rows_[r] + Eigen::Index(c) * (*data_)[r].time.size());
  elimination_ = std::make_shared<Elimination const>(std::move(whitened_columns), mean, deviation, first_rows);
}

void Estimation::whiten(Eigen::Ref<Eigen::MatrixXd> signals) const {
  for (std::size_t r = 0; r < data_->size(); ++r)
    whiten(r, signals.middleRows(first_rows_[r], (*data_)[r].values.size()));
}

void Estimation::whiten(std::size_t run, Eigen::Ref<Eigen::MatrixXd> signals) const {
  auto const rows = (*data_)[run].time.size();
  in_parallel(whitenings_[run].size(),
              [&](std::size_t c) { whitenings_[run][c].apply(signals.middleRows(Eigen::Index(c) * rows, rows)); });
}

Estimation Estimation::with(std::vector<ChannelNoise> const& noise) const {
  Estimation other = *this;
  other.hear(noise);
  return other;
}

double Estimation::noise_scale() const {
  double sum = 0.0;
  for (auto const& run : whitenings_)
    for (auto const& channel : run) sum += 2.0 * channel.log_scale();
  return sum;
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
  other.eliminate(elimination_->columns());
  return other;
}

Estimation Estimation::with_loops(double deviation) const {
  Estimation other = *this;
  for (auto& unknown : other.unknowns_)
    if (unknown.kind == Unknown::Kind::loop) unknown.deviation = deviation;
  other.eliminate(elimination_->columns());
  return other;
}

Estimation Estimation::with_laws(double share) const {
  Estimation other = *this;
  for (auto& unknown : other.unknowns_)
    if (unknown.kind == Unknown::Kind::number && numbers_[unknown.index].of_law)
      unknown.deviation = share * numbers_[unknown.index].deviation;
  return other;
}

Estimation Estimation::about(Eigen::VectorXd const& x) const {
  Estimation other = *this;
  auto linear =
      std::make_shared<LinearUnknowns const>(document_at(x), *data_, channels_, has_drawings(numbers_), zeros());
  if (linear->all().size() != linear_->all().size()) return other;
  other.linear_ = std::move(linear);
  other.hear(noise_);
  return other;
}

bool Estimation::has_open_loops() const {
  auto const& closed = linear_->all();
  for (std::size_t l = 0; l < closed.size(); ++l)
    if (closed[l].kind == Unknown::Kind::loop &&
        unknowns_[std::size_t(first_linear_) + l].deviation > closed[l].deviation)
      return true;
  return false;
}

Estimation Estimation::with_form_of_file(std::vector<std::size_t> const& but) const {
  std::vector<std::size_t> hidden;
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    if (is_beyond_a_file(unknowns_[u].kind) && std::find(but.begin(), but.end(), u) == but.end()) hidden.push_back(u);
  return knowing(hidden);
}

Estimation Estimation::with_zeros(std::vector<ChangedZero> const& zeros) const {
  Estimation other = *this;
  auto const place = std::ptrdiff_t(unknowns_.size() - effects_.size());
  other.linear_ = std::make_shared<LinearUnknowns const>(linear_->with(zeros, *data_));
  auto const& all = other.linear_->all();
  other.unknowns_.insert(other.unknowns_.begin() + place, all.end() - std::ptrdiff_t(zeros.size()), all.end());
  other.hear(noise_);
  return other;
}

Eigen::VectorXd Estimation::with_zeros(Eigen::VectorXd const& x, std::size_t zeros) const {
  auto const effects = Eigen::Index(effects_.size());
  Eigen::VectorXd longer(x.size() + Eigen::Index(zeros));
  longer << x.head(x.size() - effects), Eigen::VectorXd::Zero(Eigen::Index(zeros)), x.tail(effects);
  return longer;
}

Estimation Estimation::watched(FitWatch watch) const {
  Estimation other = *this;
  other.watch_ = std::move(watch);
  return other;
}

double Estimation::measured() const {
  double values = 0.0;
  for (auto const& run : *data_) values += double((run.samples.array() > 0.0).count());
  return std::max(values, 1.0);
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
    } else if (unknown.kind == Unknown::Kind::lag) {
      add_lag(document, channels_[unknown.index], x[Eigen::Index(u)]);
    } else if (unknown.kind == Unknown::Kind::amplitude) {
      auto const& effect = effects_[unknown.index];
      document =
          with_hypothesis(std::move(document), effect, table_name(unknown.index), x[Eigen::Index(u)] * effect.largest);
    }
  }
  return document;
}

Machine Estimation::machine_at(Eigen::VectorXd const& x) const { return Machine::build(document_at(x)); }

/// One per effect, in units of its hypothesis' `largest`.
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
  Eigen::VectorXd const explained = linear_->columns() * x.segment(first_linear_, linear_->columns().cols());
  std::vector<Eigen::MatrixXd> residuals(data_->size());
  in_parallel(residuals.size(), [&](std::size_t r) {
    auto const& run = (*data_)[r];
    residuals[r] = run.values - LinearisedRun(machine, run).prediction();
    residuals[r] -= explained.segment(first_rows_[r], run.values.size()).reshaped(run.values.rows(), run.values.cols());
  });
  return residuals;
}

/// The twin along the data. The runs take a quarter of a fit: one serves the residual and then the Jacobian.
struct Estimation::Traced {
  Eigen::VectorXd x;
  Value document;
  Machine machine;
  std::vector<std::optional<LinearisedRun>> runs;
};

/// Nothing where a number left the range that a machine may have, or the machine cannot be run.
std::unique_ptr<Estimation::Traced const> Estimation::trace(Eigen::VectorXd const& x) const {
  std::unique_ptr<Traced> traced;
  try {
    Value document = document_at(x);
    Machine machine = Machine::build(document);
    traced = std::make_unique<Traced>(Traced{x, std::move(document), std::move(machine), {}});
  } catch (thermal::InputError const&) {
    return nullptr;
  }
  traced->runs.resize(data_->size());
  try {
    in_parallel(data_->size(), [&](std::size_t r) { traced->runs[r].emplace(traced->machine, (*data_)[r]); });
  } catch (thermal::InputError const&) {
    return nullptr;
  } catch (thermal::IntegrationError const&) {
    return nullptr;
  }
  return traced;
}

/// Of what is searched: the whitened difference between data and twin, before what is linear, and its derivative.
struct Estimation::Linearisation {
  Eigen::VectorXd x;  ///< of all unknowns; empty where nothing was linearised
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;  ///< residual × searched
  Eigen::MatrixXd own;       ///< JᵀJ
  Eigen::MatrixXd shared;    ///< SᵀJ, S: of what is linear

  [[nodiscard]] bool is_at(Eigen::VectorXd const& other) const { return x.size() == other.size() && x == other; }
};

std::vector<Eigen::Index> Estimation::searched() const {
  std::vector<Eigen::Index> result;
  auto const linear = linear_->columns().cols();
  for (Eigen::Index u = 0; u < Eigen::Index(unknowns_.size()); ++u)
    if (u < first_linear_ || u >= first_linear_ + linear) result.push_back(u);
  return result;
}

/// To a linearisation, what searched numbers and amplitudes do as heat; nothing where they are none.
void Estimation::add_heat(Traced const& traced, Linearisation& at) const {
  auto const& network = traced.machine.network();
  auto const unknowns = searched();
  auto const amplitudes = amplitude_derivatives(traced.x);
  std::vector<thermal::NetworkDerivative> heat;
  std::vector<Eigen::Index> heated;
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    auto const& unknown = unknowns_[std::size_t(unknowns[k])];
    thermal::NetworkDerivative own;
    if (unknown.kind == Unknown::Kind::number)
      own = derivatives_->network(unknown.index, traced.document, traced.x[unknowns[k]]);
    if (unknown.kind == Unknown::Kind::amplitude) own = amplitudes[unknown.index].network;
    if (changes_heat(own)) {
      heat.push_back(thermal::lengthened(std::move(own), network));
      heated.push_back(Eigen::Index(k));
    } else {
      at.jacobian.col(Eigen::Index(k)).setZero();
    }
  }
  std::vector<thermal::NetworkDerivative const*> pointers;
  for (auto const& derivative : heat) pointers.push_back(&derivative);
  in_parts(data_->size(), heat.size(), numbers_at_once, [&](std::size_t run, std::size_t first, std::size_t end) {
    auto const response = traced.runs[run]->response(thermal::ParameterColumns(
        network, {pointers.begin() + std::ptrdiff_t(first), pointers.begin() + std::ptrdiff_t(end)}));
    std::vector<Eigen::Index> const places(heated.begin() + std::ptrdiff_t(first),
                                           heated.begin() + std::ptrdiff_t(end));
    put_columns(response, -1.0, places, at.jacobian.middleRows(first_rows_[run], response.rows()));
  });
}

/// It changes readings at the same temperatures.
bool Estimation::is_read_directly(Unknown const& unknown) const {
  if (unknown.kind == Unknown::Kind::amplitude) return effects_[unknown.index].is_read_directly();
  return unknown.kind == Unknown::Kind::number && derivatives_->is_read_directly(unknown.index);
}

/// To a linearisation, what searched unknowns do to the readings of one run at the same temperatures.
void Estimation::add_readings(std::size_t run, Traced const& traced, Linearisation& at) const {
  auto const& data = (*data_)[run];
  LinearisedRun const& twin = *traced.runs[run];
  auto const first = first_rows_[run], rows = data.time.size();
  auto jacobian = at.jacobian.middleRows(first, data.values.size());
  Eigen::MatrixXd const prediction = twin.prediction(), slower = twin.prediction_of(later(traced.machine));
  auto const unknowns = searched();
  for (std::size_t k = 0; k < unknowns.size(); ++k) {
    auto const& unknown = unknowns_[std::size_t(unknowns[k])];
    double const value = traced.x[unknowns[k]];
    auto column = jacobian.col(Eigen::Index(k));
    if (unknown.kind == Unknown::Kind::lag)
      for (std::size_t c = 0; c < data.run->channels.size(); ++c)
        if (data.run->channels[c].name == channels_[unknown.index])
          column.segment(Eigen::Index(c) * rows, rows) = (prediction - slower).col(Eigen::Index(c));
    if (unknown.kind == Unknown::Kind::number)
      if (auto const& weights = derivatives_->displacements(unknown.index); !weights.empty())
        column -= numbers_[unknown.index].slope(value) * twin.growth(weights).reshaped();
    if (is_read_directly(unknown)) {
      double const step = relative_step * std::max(std::abs(value), 1e-3);
      Eigen::VectorXd plus = traced.x;
      plus[unknowns[k]] += step;
      column -= ((twin.prediction_of(machine_at(plus)) - prediction) / step).reshaped();
    }
  }
  whiten(run, jacobian);
}

bool Estimation::evaluate(Eigen::VectorXd const& x, std::unique_ptr<Traced const>& traced, bool linearised,
                          Linearisation& at) const {
  at.x.resize(0);
  if (!traced || traced->x != x) traced = trace(x);
  if (!traced) return false;
  at.residual.resize(rows_);
  for (std::size_t r = 0; r < data_->size(); ++r)
    at.residual.segment(first_rows_[r], (*data_)[r].values.size()) =
        ((*data_)[r].values - traced->runs[r]->prediction()).reshaped();
  at.residual = at.residual.array().isNaN().select(0.0, at.residual);
  whiten(at.residual);
  if (!linearised) return true;
  at.jacobian.resize(rows_, Eigen::Index(searched().size()));
  try {
    add_heat(*traced, at);
    in_parallel(data_->size(), [&](std::size_t r) { add_readings(r, *traced, at); });
  } catch (thermal::InputError const&) {
    return false;
  } catch (thermal::IntegrationError const&) {
    return false;
  }
  at.own = thermal::threaded_square(at.jacobian);
  at.shared = elimination_->shared(at.jacobian);
  at.x = x;
  return true;
}

double Estimation::cost_of_document() const {
  std::unique_ptr<Traced const> traced;
  Linearisation at;
  if (!evaluate(prior_mean(), traced, false, at)) throw thermal::InputError(std::string(cannot_be_run));
  Eigen::VectorXd const linear = elimination_->best(at.residual);
  return (at.residual - elimination_->effect_of(linear)).squaredNorm() + elimination_->prior_cost(linear);
}

Fit Estimation::fit(Eigen::VectorXd const& start, int iterations) const {
  auto const unknowns = searched();
  auto const count = Eigen::Index(unknowns.size());
  LeastSquares problem{.evaluate = {},
                       .start = start(unknowns),
                       .lower = Eigen::VectorXd(count),
                       .upper = Eigen::VectorXd(count),
                       .iterations = iterations};
  Eigen::VectorXd mean(count), precision(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    auto const& unknown = unknowns_[std::size_t(unknowns[std::size_t(k)])];
    problem.lower[k] = unknown.lower;
    problem.upper[k] = unknown.upper;
    mean[k] = unknown.mean;
    precision[k] = 1.0 / (unknown.deviation * unknown.deviation);
  }
  auto const whole = [&](Eigen::VectorXd const& values) {
    Eigen::VectorXd x = prior_mean();
    x(unknowns) = values;
    return x;
  };
  std::unique_ptr<Traced const> traced;
  Linearisation last, trial;
  int step = 0;
  problem.evaluate = [&](Eigen::VectorXd const& values, bool linearised, NormalEquations& at) {
    Eigen::VectorXd const x = whole(values);
    Linearisation& here = linearised || last.is_at(x) ? last : trial;
    if (!last.is_at(x) && !evaluate(x, traced, linearised, here)) return false;
    Eigen::VectorXd const linear = elimination_->best(here.residual), from_mean = values - mean;
    Eigen::VectorXd const left = here.residual - elimination_->effect_of(linear);
    at.cost = left.squaredNorm() + elimination_->prior_cost(linear) + from_mean.cwiseAbs2().dot(precision);
    if (!linearised) return true;
    if (watch_) watch_(++step, at.cost / measured());
    at.gradient = here.jacobian.transpose() * left + precision.cwiseProduct(from_mean);
    at.curvature = elimination_->curvature(here.own, here.shared);
    at.curvature.diagonal() += precision;
    return true;
  };
  // So much of an effect may be more than a machine endures.
  for (int i = 0; i < start_halvings && !(traced = trace(whole(problem.start))); ++i)
    problem.start.tail(Eigen::Index(effects_.size())) *= 0.5;
  auto const solved = solve(problem);
  Eigen::VectorXd const x = whole(solved.x);
  if (!last.is_at(x) && !evaluate(x, traced, true, last)) throw thermal::InputError(std::string(cannot_be_run));
  Fit fit = fit_at(x, std::move(last));
  fit.converged = solved.converged;
  return fit;
}

std::optional<Fit> Estimation::try_fit(Eigen::VectorXd const& start, int iterations) const {
  try {
    return fit(start, iterations);
  } catch (thermal::InputError const&) {
  } catch (thermal::IntegrationError const&) {
  }
  return std::nullopt;
}

/// With all unknowns.
Fit Estimation::fit_at(Eigen::VectorXd const& x, Linearisation at) const {
  auto const count = Eigen::Index(unknowns_.size());
  Fit fit;
  fit.x = x;
  auto linear = fit.x.segment(first_linear_, elimination_->columns().cols());
  linear = elimination_->best(at.residual);
  fit.residual.resize(rows_ + count);
  fit.residual.head(rows_) = at.residual - elimination_->effect_of(linear);
  Eigen::VectorXd priors(count);
  for (Eigen::Index u = 0; u < count; ++u) {
    auto const& unknown = unknowns_[std::size_t(u)];
    fit.residual[rows_ + u] = (fit.x[u] - unknown.mean) / unknown.deviation;
    priors[u] = 1.0 / unknown.deviation;
  }
  fit.cost = fit.residual.squaredNorm();
  auto const free = searched();
  std::vector<Eigen::Index> held(std::size_t(linear.size()));
  std::iota(held.begin(), held.end(), first_linear_);
  auto& product = fit.information = Eigen::MatrixXd::Zero(count, count);
  for (auto const u : free) product(u, u) = priors[u] * priors[u];
  product(free, free) += at.own;
  product(held, held) = elimination_->information();
  product(held, free) = -at.shared;
  product(free, held) = -at.shared.transpose();
  fit.jacobian = Jacobian(std::move(at.jacobian), std::move(priors), elimination_, first_linear_);
  Eigen::LLT<Eigen::MatrixXd> const information(product);
  if (information.info() != Eigen::Success) throw thermal::InputError(std::string(cannot_be_run));
  fit.covariance = information.solve(Eigen::MatrixXd::Identity(count, count));
  fit.evidence = fit.cost + models::log_determinant(information);
  for (auto const& unknown : unknowns_) fit.evidence += 2.0 * std::log(unknown.deviation);
  for (auto const& effect : effects_) fit.evidence += effect.choice;
  for (auto const& unknown : unknowns_)
    if (unknown.kind == Unknown::Kind::amplitude && unknown.lower > 0.0) fit.evidence -= 2.0 * std::log(2.0);
  return fit;
}

}  // namespace thermotwin::twin
