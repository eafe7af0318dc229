#pragma once

#include <Eigen/Core>

namespace thermotwin::twin {

/// How much later than its prediction a channel changes: the shift in time at which the changes from row to row
/// correlate best. Neither the size of a prediction nor its slow errors matter.
struct Lateness {
  double time = 0.0;       ///< [s]; negative: earlier
  double agreement = 0.0;  ///< correlation of the changes then
  double unshifted = 0.0;  ///< ... and at no shift

  /// What the shift leaves of the share of the changes that the prediction does not explain.
  [[nodiscard]] double left() const;
};

/// Within an hour and a half, and an eighth of the run, to either side, to a minute. `seen` may have NaN, `due` none.
[[nodiscard]] Lateness lateness_of(Eigen::VectorXd const& time, Eigen::VectorXd const& seen,
                                   Eigen::VectorXd const& due);

}  // namespace thermotwin::twin
