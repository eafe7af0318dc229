#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/diagnosis/elimination.h"
#include "twin/diagnosis/fit.h"
#include "twin/diagnosis/hypothesis.h"
#include "twin/diagnosis/linear_unknowns.h"
#include "twin/diagnosis/linearised_run.h"
#include "twin/diagnosis/noise_model.h"
#include "twin/diagnosis/number_derivatives.h"
#include "twin/diagnosis/uncertain_number.h"
#include "twin/diagnosis/unknown.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {

/// Is told how far a fit is, from whatever thread: the step that it takes next, and the mean square of the whitened
/// residuals before it, priors included. What it throws ends the fit.
using FitWatch = std::function<void(int step, double misfit)>;

/// Maximum a posteriori of a machine's uncertain numbers, its instruments' offsets and lags, and the amplitudes of
/// effects that were added to it, from several runs at once (physics.md 8.1):
///
///   min Σ |L (z_measured − z(x))|² + Σ ((x − mean)/deviation)²,
///
/// L: the whitening of each channel's noise. The Jacobian is the tangent-linear response (linearised_run.h). Searched
/// are numbers, lags and amplitudes; the unknowns that are linear (linear_unknowns.h) are at their best for these.
class Estimation {
 public:
  /// `data` and their runs must outlive this.
  Estimation(Value document, std::vector<BinnedRun> const& data, std::vector<std::string> const& channels,
             std::vector<ChannelNoise> const& noise);

  /// The same question with effects added to the machine; shares what does not change.
  [[nodiscard]] Estimation with(std::vector<Hypothesis> const& effects) const;
  /// The same question with other noise.
  [[nodiscard]] Estimation with(std::vector<ChannelNoise> const& noise) const;
  /// The same question with some of the unknowns as good as known: to a hundredth of a per cent of their priors.
  [[nodiscard]] Estimation knowing(std::vector<std::size_t> const& unknowns) const;
  /// The same question where displacements may leave their structural loops by so much of free growth (loop_gaps.h).
  [[nodiscard]] Estimation with_loops(double deviation) const;
  [[nodiscard]] bool has_open_loops() const;
  /// The same question where the forms of laws are as uncertain as that share of their priors.
  [[nodiscard]] Estimation with_laws(double share) const;
  /// The same question where what is linear answers as about these estimates; where effects brought more of it, as it
  /// was.
  [[nodiscard]] Estimation about(Eigen::VectorXd const& x) const;
  /// The same question to a machine of the form that its file has, but for these unknowns of it (is_beyond_a_file).
  [[nodiscard]] Estimation with_form_of_file(std::vector<std::size_t> const& but = {}) const;

  /// The same question where zeros have changed, too (changed_zero.h).
  [[nodiscard]] Estimation with_zeros(std::vector<ChangedZero> const& zeros) const;
  /// Estimates of this question as those of one with so many zeros more, which are as they were.
  [[nodiscard]] Eigen::VectorXd with_zeros(Eigen::VectorXd const& x, std::size_t zeros) const;

  /// The same question, each of whose fits is watched.
  [[nodiscard]] Estimation watched(FitWatch watch) const;

  [[nodiscard]] Value const& document() const { return document_; }
  [[nodiscard]] std::vector<Unknown> const& unknowns() const { return unknowns_; }
  [[nodiscard]] std::vector<Hypothesis> const& effects() const { return effects_; }
  [[nodiscard]] std::vector<UncertainNumber> const& numbers() const { return numbers_; }
  [[nodiscard]] std::vector<SensorPlace> const& places() const { return linear_->places(); }
  [[nodiscard]] std::vector<LoopGap> const& gaps() const { return linear_->gaps(); }
  [[nodiscard]] std::vector<ChangedZero> const& zeros() const { return linear_->zeros(); }
  [[nodiscard]] std::vector<std::string> const& channels() const { return channels_; }
  [[nodiscard]] std::vector<BinnedRun> const& data() const { return *data_; }
  [[nodiscard]] std::vector<ChannelNoise> const& noise() const { return noise_; }

  /// Steps of a fit that all later ones start from, which converges: half a valley down, the ninth digit of a number
  /// would decide what is named.
  static constexpr int to_the_end = 50;
  /// From there on; what is linear needs no start.
  [[nodiscard]] Fit fit(Eigen::VectorXd const& start, int iterations = 10) const;
  /// The same; nothing where the machine cannot be run there.
  [[nodiscard]] std::optional<Fit> try_fit(Eigen::VectorXd const& start, int iterations) const;
  /// Of the machine as the document has it: squares of residuals and of what is linear, at its best, by their errors.
  [[nodiscard]] double cost_of_document() const;
  [[nodiscard]] Eigen::VectorXd prior_mean() const;

  /// The machine's document with the estimates in it: numbers, the sensors' lags, effects.
  [[nodiscard]] Value document_at(Eigen::VectorXd const& x) const;
  [[nodiscard]] Machine machine_at(Eigen::VectorXd const& x) const;
  /// Measured minus predicted and minus offsets, lags, start, air and gaps, row × channel of each run, not whitened.
  [[nodiscard]] std::vector<Eigen::MatrixXd> residuals_at(Eigen::VectorXd const& x) const;

  /// Whitens signals of all runs, (run; channel · rows + row) × column, in place.
  void whiten(Eigen::Ref<Eigen::MatrixXd> signals) const;
  /// Whitens signals of one run.
  void whiten(std::size_t run, Eigen::Ref<Eigen::MatrixXd> signals) const;
  /// Whitens signals of one channel of that.
  void whiten(std::size_t run, std::size_t channel, Eigen::MatrixXd& signals) const {
    whitenings_[run][channel].apply(signals);
  }
  /// Σ ln |2π S| of the innovations of all channels: what the evidence of a fit lacks beside one with other noise.
  [[nodiscard]] double noise_scale() const;
  /// Rows of all runs and channels.
  [[nodiscard]] Eigen::Index rows() const { return rows_; }
  /// Values that were measured, of all runs and channels: rows that are not empty.
  [[nodiscard]] double measured() const;
  /// Where a run's rows begin.
  [[nodiscard]] Eigen::Index first_row(std::size_t run) const { return first_rows_[run]; }

 private:
  void add_numbers_and_lags();
  void hear(std::vector<ChannelNoise> const& noise);
  void eliminate(Eigen::MatrixXd whitened_columns);
  [[nodiscard]] std::vector<Eigen::Index> searched() const;
  struct Traced;
  [[nodiscard]] std::unique_ptr<Traced const> trace(Eigen::VectorXd const& x) const;
  struct Linearisation;
  [[nodiscard]] bool evaluate(Eigen::VectorXd const& x, std::unique_ptr<Traced const>& traced, bool linearised,
                              Linearisation& at) const;
  void add_heat(Traced const& traced, Linearisation& at) const;
  [[nodiscard]] bool is_read_directly(Unknown const& unknown) const;
  void add_readings(std::size_t run, Traced const& traced, Linearisation& at) const;
  [[nodiscard]] std::vector<MachineDerivative> amplitude_derivatives(Eigen::VectorXd const& x) const;
  [[nodiscard]] Fit fit_at(Eigen::VectorXd const& x, Linearisation at) const;

  Value document_;
  std::vector<BinnedRun> const* data_;
  std::vector<std::string> channels_;
  std::vector<ChannelNoise> noise_;
  std::vector<UncertainNumber> numbers_;
  std::shared_ptr<NumberDerivatives const> derivatives_;
  std::vector<Hypothesis> effects_;
  std::vector<Unknown> unknowns_;  ///< numbers and lags, what is linear, amplitudes
  std::shared_ptr<LinearUnknowns const> linear_;
  Eigen::Index first_linear_ = 0;
  std::vector<std::vector<Whitening>> whitenings_;  ///< per run, per channel
  std::vector<Eigen::Index> first_rows_;
  Eigen::Index rows_ = 0;
  std::shared_ptr<Elimination const> elimination_;  ///< of what is linear, whitened
  FitWatch watch_;
};

}  // namespace thermotwin::twin
