#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/diagnosis/hypothesis.h"
#include "twin/diagnosis/linearised_run.h"
#include "twin/diagnosis/lump_interiors.h"
#include "twin/diagnosis/noise_model.h"
#include "twin/diagnosis/uncertain_number.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {

/// What is estimated from the data, with its prior N(mean, deviation²).
struct Unknown {
  enum class Kind {
    number,     ///< ln(value/nominal) of a number of the file
    amplitude,  ///< of an effect that was added, in units of its trial's `largest`
    offset,     ///< of a channel [K, m]: of a sensor in all runs, of a displacement in one
    lag,        ///< of a sensor [s]
    start,      ///< deviation of the whole machine's temperature at the start of a run [K]
    air,        ///< deviation of the room air from its record, in one run [K]
    input,      ///< share of what a run may have been given instead in a gap of its record
    interior,   ///< of what a lump hides, in units of a slab's (lump_interiors.h)
  };
  Kind kind = Kind::number;
  std::string name;
  double mean = 0.0, deviation = 1.0;
  double lower = -INFINITY, upper = INFINITY;
  std::size_t index = 0;  ///< of the number, the effect, the channel, the run's alternative or the interior
  int run = -1;           ///< −1: all
};

/// A fit: the estimates, and what the data and the priors say of them together.
struct Fit {
  Eigen::VectorXd x;
  double cost = 0.0;         ///< |whitened residuals|² + |prior residuals|²: −2 ln posterior + constant
  Eigen::VectorXd residual;  ///< whitened, then the priors'
  Eigen::MatrixXd jacobian;  ///< of the residual
  Eigen::MatrixXd covariance;
  bool converged = false;

  /// −2 ln evidence + constant, by Laplace's method: cost + ln |JᵀJ|, the priors' volume taken off, the choice of each
  /// effect's site added.
  double evidence = 0.0;
};

/// A fit as if one of its unknowns had been known to be zero, to first order: what its effect explained is in the
/// residual again. The others are not at their optimum then.
[[nodiscard]] Fit without(Fit fit, Eigen::Index unknown);

/// Maximum a posteriori of a machine's uncertain numbers, its instruments' offsets and lags, and the amplitudes of
/// effects that were added to it, from several runs at once (physics.md 8.1):
///
///   min Σ |L (z_measured − z(x))|² + Σ ((x − mean)/deviation)²,
///
/// L: the whitening of each channel's noise. The Jacobian is the tangent-linear response (linearised_run.h).
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
  /// The same question to a machine whose lumps hide nothing: all that a file can say.
  [[nodiscard]] Estimation with_lumps() const;

  [[nodiscard]] std::vector<Unknown> const& unknowns() const { return unknowns_; }
  [[nodiscard]] std::vector<Hypothesis> const& effects() const { return effects_; }
  [[nodiscard]] std::vector<UncertainNumber> const& numbers() const { return numbers_; }
  [[nodiscard]] std::vector<std::string> const& channels() const { return channels_; }
  [[nodiscard]] std::vector<BinnedRun> const& data() const { return *data_; }
  [[nodiscard]] std::vector<ChannelNoise> const& noise() const { return noise_; }

  [[nodiscard]] Fit fit(Eigen::VectorXd const& start, int iterations = 10) const;
  [[nodiscard]] Eigen::VectorXd prior_mean() const;

  /// The machine's document with the estimates in it, effects included.
  [[nodiscard]] Value document_at(Eigen::VectorXd const& x) const;
  /// That machine, with the instruments' lags.
  [[nodiscard]] Machine machine_at(Eigen::VectorXd const& x) const;
  /// Measured minus predicted and minus offsets, lags, start, air and gaps, row × channel of each run, not whitened.
  [[nodiscard]] std::vector<Eigen::MatrixXd> residuals_at(Eigen::VectorXd const& x) const;

  /// Whitens signals of all runs, (run; channel · rows + row) × column, in place.
  void whiten(Eigen::Ref<Eigen::MatrixXd> signals) const;
  /// Rows of all runs and channels.
  [[nodiscard]] Eigen::Index rows() const { return rows_; }
  /// Where a run's rows begin.
  [[nodiscard]] Eigen::Index first_row(std::size_t run) const { return first_rows_[run]; }

 private:
  void add_unknowns(LumpInteriors const& interiors);
  void make_whitenings();
  void find_linear_columns(LumpInteriors const& interiors);
  struct Traced;
  [[nodiscard]] std::unique_ptr<Traced const> trace(Eigen::VectorXd const& x) const;
  [[nodiscard]] bool evaluate(Eigen::VectorXd const& x, std::unique_ptr<Traced const>& traced,
                              Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) const;
  [[nodiscard]] std::vector<MachineDerivative> amplitude_derivatives(Eigen::VectorXd const& x) const;

  Value document_;
  std::vector<BinnedRun> const* data_;
  std::vector<std::string> channels_;
  std::vector<ChannelNoise> noise_;
  std::vector<UncertainNumber> numbers_;
  std::vector<MachineDerivative> number_derivatives_;  ///< at the nominal values
  std::vector<Hypothesis> effects_;
  std::vector<Unknown> unknowns_;
  std::vector<std::vector<Whitening>> whitenings_;  ///< per run, per channel
  std::vector<Eigen::Index> first_rows_;
  Eigen::Index rows_ = 0;
  Eigen::MatrixXd linear_columns_;  ///< of the unknowns that need no new run of the twin
  Eigen::MatrixXd whitened_linear_columns_;
  std::vector<std::size_t> linear_;
};

}  // namespace thermotwin::twin
