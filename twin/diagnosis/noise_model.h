#pragma once

#include <Eigen/Core>
#include <vector>

namespace thermotwin::twin {

/// What a channel shows besides the twin's prediction, in the unit of the channel:
///
///   e = v + m₁ + m₂,   m_i: Ornstein–Uhlenbeck processes, cov m_i(t) m_i(t') = σ_i² exp(−|t − t'|/τ_i),
///
/// v white: noise of the samples, and the quantiser's step/√12 that averaging does not take away. m₁ and m₂ are what a
/// model of this kind gets wrong: of some minutes and of some hours (physics.md 8.6, model-form error).
struct ChannelNoise {
  double white = 0.0;     ///< of one sample
  double rounding = 0.0;  ///< of one row, however many samples
  double fast = 0.0, fast_time = 600.0;
  double slow = 0.0, slow_time = 3.0 * 3600.0;
  /// σ₂ besides, of the range that the channel goes through in a run: a machine at rest has little that a model could
  /// get wrong.
  double slow_share = 0.0;
  /// σ₂ besides, of the way that the channel has gone from where it began; the way is forgotten with τ₂. At rest,
  /// before the machine first moves and long after it stopped, there is none.
  double way_share = 0.0;

  /// σ₂ in the rows of a run in which the channel shows these values; NaN: none.
  [[nodiscard]] Eigen::VectorXd slow_along(Eigen::VectorXd const& time, Eigen::VectorXd const& values) const;
};

/// Turns such noise into white noise of variance 1: the innovations of the Kalman filter of (m₁, m₂), divided by their
/// standard deviation. Linear, so that residuals and sensitivities pass through the same filter.
class Whitening {
 public:
  /// `time` of the rows [s]; `samples` averaged in each, 0: missing, whose whitened value is 0; σ₂ in each.
  Whitening(ChannelNoise const& noise, Eigen::VectorXd const& time, Eigen::VectorXd const& samples,
            Eigen::VectorXd const& slow);

  /// In place: one column per signal, one row per row.
  void apply(Eigen::Ref<Eigen::MatrixXd> signals) const;
  /// ½ Σ ln |2π S| of the innovations.
  [[nodiscard]] double log_scale() const { return log_scale_; }

 private:
  struct Row {
    double fast_decay, slow_decay, slow, fast_gain, slow_gain, scale;  ///< scale 0: missing
  };
  std::vector<Row> rows_;
  double log_scale_ = 0.0;
};

}  // namespace thermotwin::twin
