#include "twin/diagnosis/score.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>

#include "twin/diagnosis/estimate_text.h"
#include "twin/parallel.h"

namespace thermotwin::twin {
namespace {

constexpr double step = 1e-3;
constexpr double one_sided_95 = 1.645;      // of a normal distribution, in standard deviations
constexpr std::size_t shapes_at_once = 96;  // whose responses are found together

/// How the response to a hypothesis is found.
enum class Way {
  shared,    ///< heat, by parts of its own: all such hypotheses share one network
  readings,  ///< other sensors or displacements, at the same temperatures
  air,       ///< another temperature of the machine's own boundaries
};

Way way_of(Hypothesis const& hypothesis) {
  if (hypothesis.is_read_directly()) return Way::readings;
  return hypothesis.site == "machine" ? Way::air : Way::shared;
}

std::string trial_table(std::size_t hypothesis) { return fmt::format("trial_{}", hypothesis); }

/// The columns of many hypotheses at once: a machine that has them all, at amplitudes that change nothing.
class SharedNetwork {
 public:
  /// Seen through the sensors of `fitted`, with their lags.
  SharedNetwork(Value const& document, std::vector<Hypothesis> const& hypotheses, std::vector<std::size_t> shared,
                Machine const& fitted);

  [[nodiscard]] Machine const& machine() const { return machine_; }
  [[nodiscard]] std::vector<thermal::NetworkDerivative const*> derivatives() const;

 private:
  static Machine with_all(Value document, std::vector<Hypothesis> const& hypotheses,
                          std::vector<std::size_t> const& shared, double amplitude);

  std::vector<std::size_t> shared_;
  Machine machine_;
  std::vector<thermal::NetworkDerivative> derivatives_;
};

Machine SharedNetwork::with_all(Value document, std::vector<Hypothesis> const& hypotheses,
                                std::vector<std::size_t> const& shared, double amplitude) {
  for (std::size_t const h : shared)
    document = with_hypothesis(std::move(document), hypotheses[h], trial_table(h), amplitude * hypotheses[h].largest);
  return Machine::build(document);
}

SharedNetwork::SharedNetwork(Value const& document, std::vector<Hypothesis> const& hypotheses,
                             std::vector<std::size_t> shared, Machine const& fitted)
    : shared_(std::move(shared)), machine_(with_all(document, hypotheses, shared_, as_good_as_none)) {
  machine_.sensors = fitted.sensors;
  Machine const larger = with_all(document, hypotheses, shared_, step);
  auto const& network = machine_.network();
  std::map<std::string, std::size_t> column_of;
  for (std::size_t k = 0; k < shared_.size(); ++k)
    column_of[hypotheses[shared_[k]].effect->name + "." + trial_table(shared_[k])] = k;
  derivatives_.assign(shared_.size(), thermal::lengthened({}, network));
  for (std::size_t g = 0; g < network.groups().size(); ++g) {
    auto const& from = network.groups()[g];
    auto const& to = larger.network().groups()[g];
    int const count = from.law->coefficients();
    for (int e = 0; e < from.count(); ++e) {
      auto const it = column_of.find(network.parts()[std::size_t(from.parts[std::size_t(e)])]);
      if (it == column_of.end()) continue;
      auto& rates = derivatives_[it->second].coefficients[g];
      rates.resize(from.coefficients.size());
      for (int i = e * count; i < (e + 1) * count; ++i)
        rates[std::size_t(i)] =
            (to.coefficients[std::size_t(i)] - from.coefficients[std::size_t(i)]) / (step - as_good_as_none);
    }
  }
}

std::vector<thermal::NetworkDerivative const*> SharedNetwork::derivatives() const {
  std::vector<thermal::NetworkDerivative const*> pointers;
  for (auto const& derivative : derivatives_) pointers.push_back(&derivative);
  return pointers;
}

/// One hypothesis alone, where it changes readings, displacements or the air. `plain`: what the twins predict without.
void add_alone(Estimation const& estimation, Value const& document, Hypothesis const& hypothesis, std::size_t index,
               std::vector<std::optional<LinearisedRun>> const& twins, std::vector<Eigen::MatrixXd> const& plain,
               Eigen::MatrixXd& columns) {
  double const unit = hypothesis.largest;
  auto const at = [&](double amplitude) {
    return Machine::build(with_hypothesis(document, hypothesis, trial_table(index), amplitude * unit));
  };
  double const tried = hypothesis.about > 0.0 ? hypothesis.about : 2.0 * step;
  Machine const with = at(tried);
  if (way_of(hypothesis) == Way::readings) {
    for (std::size_t r = 0; r < twins.size(); ++r)
      columns.col(Eigen::Index(index)).segment(estimation.first_row(r), plain[r].size()) =
          ((twins[r]->prediction_of(with) - plain[r]) / tried).reshaped();
    return;
  }
  Machine const without = at(as_good_as_none);
  auto const derivative = difference(with, without, step);
  for (std::size_t r = 0; r < twins.size(); ++r) {
    auto const& run = estimation.data()[r];
    auto column = columns.col(Eigen::Index(index)).segment(estimation.first_row(r), run.values.size());
    LinearisedRun const twin(without, run);  // its air may follow inputs that the other's does not
    column = twin.response(thermal::ParameterColumns(without.network(), {&derivative.network}));
  }
}

/// Of an amplitude, with its prior.
double precision_of(double information) { return information + 1.0 / (amplitude_deviation * amplitude_deviation); }

/// What the prior of an amplitude takes of 2 ln of the evidence; half of it is nowhere where one sign is allowed.
double cost_of_prior(double information, Hypothesis const& hypothesis) {
  double const cost = std::log1p(information * amplitude_deviation * amplitude_deviation);
  return hypothesis.trial->either_sign ? cost : cost - 2.0 * std::log(2.0);
}

}  // namespace

Eigen::MatrixXd signatures(Estimation const& estimation, Fit const& fit, std::vector<Hypothesis> const& hypotheses) {
  Value const document = estimation.document_at(fit.x);
  std::vector<std::size_t> shared, alone;
  for (std::size_t h = 0; h < hypotheses.size(); ++h)
    (way_of(hypotheses[h]) == Way::shared ? shared : alone).push_back(h);
  Eigen::MatrixXd columns(estimation.rows(), Eigen::Index(hypotheses.size()));
  Machine const machine = estimation.machine_at(fit.x);
  SharedNetwork const all(document, hypotheses, shared, machine);
  auto const derivatives = all.derivatives();
  std::size_t const runs = estimation.data().size();
  std::vector<std::optional<LinearisedRun>> twins(runs), with_all(runs);
  in_parallel(2 * runs, [&](std::size_t i) {
    auto const& data = estimation.data()[i / 2];
    i % 2 == 0 ? twins[i / 2].emplace(machine, data) : with_all[i / 2].emplace(all.machine(), data);
  });
  in_parts(runs, shared.size(), shapes_at_once, [&](std::size_t r, std::size_t first, std::size_t end) {
    thermal::ParameterColumns const parameters(all.machine().network(), {derivatives.begin() + std::ptrdiff_t(first),
                                                                         derivatives.begin() + std::ptrdiff_t(end)});
    auto const response = with_all[r]->response(parameters, {}, machine.network().nodes());
    std::vector<Eigen::Index> const places(shared.begin() + std::ptrdiff_t(first),
                                           shared.begin() + std::ptrdiff_t(end));
    put_columns(response, 1.0, places, columns.middleRows(estimation.first_row(r), response.rows()));
  });
  std::vector<Eigen::MatrixXd> plain;
  for (auto const& twin : twins) plain.push_back(twin->prediction());
  in_parallel(alone.size(), [&](std::size_t i) {
    add_alone(estimation, document, hypotheses[alone[i]], alone[i], twins, plain, columns);
  });
  return columns;
}

Remainder::Remainder(Fit const& fit, Eigen::MatrixXd const& signatures, Eigen::Index first_row)
    : fit_(&fit), signatures_(&signatures), first_row_(first_row), information_(fit.information) {
  shared_ = fit.jacobian.transposed_times(signatures, first_row);
  taken_ = information_.solve(shared_);
}

std::vector<Score> Remainder::scores() const {
  Eigen::VectorXd const explained = information_.solve(fit_->jacobian.gradient(fit_->residual));
  std::vector<Score> scores;
  for (Eigen::Index k = 0; k < signatures_->cols(); ++k) {
    auto const signature = signatures_->col(k);
    Score score;
    double const whole = signature.squaredNorm();
    score.information = whole - shared_.col(k).dot(taken_.col(k));
    double const b =
        signature.dot(fit_->residual.segment(first_row_, signature.size())) - shared_.col(k).dot(explained);
    if (score.information > 1e-9 * whole && whole > 0.0) {
      score.amplitude = b / score.information;
      score.statistic = b * score.amplitude;
    }
    scores.push_back(score);
  }
  return scores;
}

std::vector<Score> Remainder::scores(std::vector<Hypothesis> const& hypotheses) const {
  auto all = scores();
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].amplitude <= 0.0 && !hypotheses[k].trial->either_sign) all[k].statistic = 0.0;
  return all;
}

Eigen::VectorXd Remainder::cosines(Eigen::Index of) const {
  Eigen::VectorXd const product =
      signatures_->transpose() * signatures_->col(of) - shared_.transpose() * taken_.col(of);
  Eigen::VectorXd const squares =
      (signatures_->colwise().squaredNorm() - shared_.cwiseProduct(taken_).colwise().sum()).transpose().cwiseMax(1e-30);
  return product.cwiseQuotient((squares * squares[of]).cwiseSqrt());
}

double probable_amplitude(Score const& score) {
  double const amplitude = score.amplitude * score.information / precision_of(score.information);
  return std::clamp(amplitude, -most_of_largest, most_of_largest);
}

double probable_error(Score const& score) { return 1.0 / std::sqrt(precision_of(score.information)); }

double evidence_of(Score const& score, Hypothesis const& hypothesis) {
  double const a = score.information, b = score.amplitude * a, amplitude = probable_amplitude(score);
  if (score.statistic <= 0.0 || hypothesis.is_ordinary(amplitude, probable_error(score))) return -hypothesis.choice;
  return (2.0 * b - precision_of(a) * amplitude) * amplitude - cost_of_prior(a, hypothesis) - hypothesis.choice;
}

double detectable(double information, Hypothesis const& hypothesis, double asked) {
  if (information <= 0.0) return INFINITY;
  double const precision = precision_of(information);
  double const needed = asked + hypothesis.choice + cost_of_prior(information, hypothesis);
  double b = std::sqrt(std::max(0.0, needed) * precision);
  if (hypothesis.trial->ordinary > 0.0)
    b = std::max(b, precision * hypothesis.trial->ordinary / hypothesis.largest + two_sided_95 * std::sqrt(precision));
  return (b + one_sided_95 * std::sqrt(information)) / information;
}

}  // namespace thermotwin::twin
