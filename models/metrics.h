#pragma once

#include <Eigen/Core>

namespace thermotwin::models {

/// How far a prediction is from the truth (methods.md §8), e = y − ŷ, N samples.
struct Metrics {
  double rmse = 0;                ///< √(Σ e²/N) [µm]
  double mae = 0;                 ///< Σ |e|/N [µm]
  double max = 0;                 ///< max |e| [µm]
  double r_squared = 0;           ///< 1 − Σ e²/Σ (y − ȳ)²; NaN where y is constant
  double mape = 0;                ///< mean of 100 |e/y| over the samples with |y| ≥ the guard [%]; NaN without any
  Eigen::Index mape_samples = 0;  ///< how many these are
};

/// Refuses vectors of different length and empty ones (std::invalid_argument). `guard` [µm]: MAPE blows up where the
/// truth is nearly zero, as at the start of every run.
Metrics metrics(Eigen::VectorXd const& truth, Eigen::VectorXd const& prediction, double guard = 1.0);

/// 100 (1 − after/before) of a metric that shall be small [%]; say which one beside it. Refuses `before` ≤ 0.
double improvement(double before, double after);

/// 1 − max |after|/max |before| of an error course.
double compensation_rate(Eigen::VectorXd const& before, Eigen::VectorXd const& after);

}  // namespace thermotwin::models
