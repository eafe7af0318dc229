#include "twin/diagnosis/unknown_heat.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

#include "thermal/error.h"
#include "twin/diagnosis/discretisation.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using thermal::InputError;

/// What the covariances say about one row: all but the data. The state is (δy, q).
struct Row {
  std::vector<Index> channels;      ///< that are present
  MatrixXd observation;             ///< of these, on the state
  MatrixXd gain;                    ///< K
  Eigen::LLT<MatrixXd> innovation;  ///< S
  double log_volume = 0.0;          ///< ln |2π S|
  VectorXd heat_covariance;         ///< p: the column of P, after the update, that belongs to q
  int regime_before = -1;           ///< whose F leads here from the row before; -1: none
};

/// What one set of data makes of them.
struct Pass {
  VectorXd heat;                ///< filtered
  std::vector<VectorXd> score;  ///< S⁻¹ e per row
  double log_likelihood = 0.0, nis = 0.0;
};

/// The filter for one supposed source, or none; for every set of residuals with the same gaps.
class HeatFilter {
 public:
  HeatFilter(ResidualModel const& model, std::optional<HeatSource> const& source, MatrixXd const& gaps)
      : model_(&model), heat_(model.capacity.size()) {
    for (auto const& regime : model.regimes) transitions_.push_back(discretised(regime, source));
    MatrixXd covariance = MatrixXd::Zero(heat_ + 1, heat_ + 1);
    covariance.diagonal().setConstant(model.initial_deviation * model.initial_deviation);
    covariance(heat_, heat_) = source ? model.prior_heat * model.prior_heat : 0.0;
    std::size_t regime = 0;
    for (Index k = 0; k < gaps.rows(); ++k) {
      auto& row = rows_.emplace_back();
      if (k > 0) predict(covariance, row, int(regime));
      while (regime + 1 < model.regimes.size() && model.regimes[regime + 1].first_row <= k) ++regime;
      for (Index c = 0; c < gaps.cols(); ++c)
        if (!std::isnan(gaps(k, c))) row.channels.push_back(c);
      if (!row.channels.empty()) update(covariance, row, model.regimes[regime].observation);
      row.heat_covariance = covariance.col(heat_);
    }
  }

  [[nodiscard]] Pass forward(MatrixXd const& residuals) const {
    Pass pass{VectorXd(residuals.rows()), {}, 0.0, 0.0};
    VectorXd state = VectorXd::Zero(heat_ + 1);
    Index samples = 0;
    for (Index k = 0; k < residuals.rows(); ++k) {
      Row const& row = rows_[std::size_t(k)];
      if (row.regime_before >= 0) state = (transition(row) * state).eval();
      VectorXd& score = pass.score.emplace_back(Index(row.channels.size()));
      if (!row.channels.empty()) {
        VectorXd const innovation = residuals(k, row.channels).transpose() - row.observation * state;
        score = row.innovation.solve(innovation);
        state += row.gain * innovation;
        double const square = innovation.dot(score);
        pass.log_likelihood -= 0.5 * (square + row.log_volume);
        pass.nis += square;
        samples += innovation.size();
      }
      pass.heat[k] = state[heat_];
    }
    if (samples > 0) pass.nis /= double(samples);
    return pass;
  }

  [[nodiscard]] VectorXd filtered_error() const {
    VectorXd error(Index(rows_.size()));
    for (std::size_t k = 0; k < rows_.size(); ++k)
      error[Index(k)] = std::sqrt(std::max(0.0, rows_[k].heat_covariance[heat_]));
    return error;
  }

  [[nodiscard]] HeatCourse backward(Pass const& pass) const {
    HeatCourse course{pass.heat, VectorXd(pass.heat.size())};
    VectorXd adjoint = VectorXd::Zero(heat_ + 1);
    MatrixXd information = MatrixXd::Zero(heat_ + 1, heat_ + 1);
    for (std::size_t k = rows_.size(); k-- > 0;) {
      Row const& row = rows_[k];
      VectorXd const& p = row.heat_covariance;
      course.heat[Index(k)] -= p.dot(adjoint);
      course.standard_error[Index(k)] = std::sqrt(std::max(0.0, p[heat_] - p.dot(information * p)));
      if (!row.channels.empty()) {
        MatrixXd const& H = row.observation;
        adjoint -= H.transpose() * (row.gain.transpose() * adjoint + pass.score[k]);
        information -= H.transpose() * (row.gain.transpose() * information).eval();
        information -= (information * row.gain).eval() * H;
        information += H.transpose() * row.innovation.solve(H);
      }
      if (row.regime_before < 0) continue;
      adjoint = (transition(row).transpose() * adjoint).eval();
      information = (transition(row).transpose() * (information * transition(row)).eval()).eval();
    }
    return course;
  }

 private:
  [[nodiscard]] Discretisation discretised(Regime const& regime, std::optional<HeatSource> const& source) const {
    MatrixXd dynamics = MatrixXd::Zero(heat_ + 1, heat_ + 1);
    dynamics.topLeftCorner(heat_, heat_) = regime.dynamics;
    VectorXd intensity = VectorXd::Constant(heat_ + 1, model_->disturbance);
    if (source) dynamics(source->node, heat_) = 1.0 / model_->capacity[source->node];
    intensity[heat_] = source ? source->intensity : 0.0;
    return discretise(dynamics, intensity, model_->interval);
  }

  [[nodiscard]] MatrixXd const& transition(Row const& row) const {
    return transitions_[std::size_t(row.regime_before)].transition;
  }

  void predict(MatrixXd& covariance, Row& row, int regime) const {
    row.regime_before = regime;
    auto const& step = transitions_[std::size_t(regime)];
    MatrixXd const half = step.transition * covariance;
    covariance = step.noise;
    covariance.triangularView<Eigen::Lower>() += half * step.transition.transpose();
    covariance.triangularView<Eigen::StrictlyUpper>() = covariance.transpose();
  }

  /// Joseph's (I − K H) P (I − K H)ᵀ + K R Kᵀ, from right to left, so that no product is larger than nodes² × channels.
  void update(MatrixXd& covariance, Row& row, MatrixXd const& observation) const {
    row.observation.setZero(Index(row.channels.size()), heat_ + 1);
    row.observation.leftCols(heat_) = observation(row.channels, Eigen::all);
    VectorXd const variance = model_->noise(row.channels).cwiseAbs2();
    MatrixXd const seen = row.observation * covariance;
    MatrixXd spread = seen * row.observation.transpose();
    spread.diagonal() += variance;
    row.innovation.compute(spread);
    row.gain = row.innovation.solve(seen).transpose();
    row.log_volume = 2.0 * row.innovation.matrixLLT().diagonal().array().log().sum() +
                     double(row.channels.size()) * std::log(2.0 * M_PI);
    covariance.noalias() -= row.gain * seen;
    MatrixXd const left = covariance * row.observation.transpose() - row.gain * variance.asDiagonal();
    covariance.noalias() -= left * row.gain.transpose();
    covariance = (0.5 * (covariance + covariance.transpose())).eval();
  }

  ResidualModel const* model_;
  Index heat_;  ///< place of q in the state
  std::vector<Discretisation> transitions_;
  std::vector<Row> rows_;
};

void check_source(ResidualModel const& model, HeatSource const& source) {
  if (source.node < 0 || source.node >= model.capacity.size())
    throw InputError(fmt::format("heat into node {}: there are nodes 0 to {}", source.node, model.capacity.size() - 1));
  if (!(source.intensity >= 0.0) || std::isinf(source.intensity))
    throw InputError(fmt::format("intensity {} W/s^0.5 of the unknown heat: it must be 0 or above", source.intensity));
}

void check_gaps(MatrixXd const& first, MatrixXd const& other) {
  if (other.rows() != first.rows() || (other.array().isNaN() != first.array().isNaN()).any())
    throw InputError("sets of residuals that are scanned together need the same rows and the same gaps");
}

/// Best first, weights ∝ exp(gain), with "no source" among them.
void rank(HeatScan& scan) {
  std::stable_sort(scan.ranking.begin(), scan.ranking.end(),
                   [](auto const& a, auto const& b) { return a.gain > b.gain; });
  double const largest = std::max(0.0, scan.ranking.front().gain);
  scan.weight_without = std::exp(-largest);
  double sum = scan.weight_without;
  for (auto& entry : scan.ranking) sum += entry.weight = std::exp(entry.gain - largest);
  scan.weight_without /= sum;
  for (auto& entry : scan.ranking) entry.weight /= sum;
}

}  // namespace

HeatEstimate estimate_heat(ResidualModel const& model, MatrixXd const& residuals, HeatSource const& source) {
  check(model, residuals);
  check_source(model, source);
  HeatFilter const filter(model, source, residuals);
  Pass const pass = filter.forward(residuals);
  return {{pass.heat, filter.filtered_error()}, filter.backward(pass), pass.log_likelihood, pass.nis};
}

std::vector<HeatScan> scan_for_heat(ResidualModel const& model, std::vector<MatrixXd> const& residuals,
                                    std::vector<Index> const& nodes, std::vector<double> const& intensities) {
  if (residuals.empty() || nodes.empty() || intensities.empty())
    throw InputError(fmt::format("a scan needs residuals, nodes and intensities; here are {}, {} and {}",
                                 residuals.size(), nodes.size(), intensities.size()));
  for (auto const& set : residuals) check(model, set), check_gaps(residuals.front(), set);
  for (Index node : nodes)
    for (double intensity : intensities) check_source(model, {node, intensity});

  std::vector<HeatScan> scans(residuals.size());
  std::vector<double> without;
  HeatFilter const nothing(model, {}, residuals.front());
  for (std::size_t s = 0; s < scans.size(); ++s) {
    Pass const pass = nothing.forward(residuals[s]);
    without.push_back(pass.log_likelihood);
    scans[s].nis_without = pass.nis;
    scans[s].ranking.assign(nodes.size(), {{}, -std::numeric_limits<double>::infinity(), 0.0, 0.0});
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (double intensity : intensities) {
      HeatFilter const filter(model, HeatSource{nodes[i], intensity}, residuals.front());
      for (std::size_t s = 0; s < scans.size(); ++s) {
        Pass const pass = filter.forward(residuals[s]);
        double const gain = pass.log_likelihood - without[s];
        if (gain > scans[s].ranking[i].gain) scans[s].ranking[i] = {{nodes[i], intensity}, gain, 0.0, pass.nis};
      }
    }
  for (auto& scan : scans) rank(scan);
  return scans;
}

HeatScan scan_for_heat(ResidualModel const& model, MatrixXd const& residuals, std::vector<Index> const& nodes,
                       std::vector<double> const& intensities) {
  return scan_for_heat(model, std::vector<MatrixXd>{residuals}, nodes, intensities).front();
}

}  // namespace thermotwin::twin
