#pragma once

#include <vector>

namespace thermotwin::scenarios {

/// The most likely course of what was recorded with noise: a random walk x seen with white noise,
///
///   x_k = x_{k−1} + w_k,  var w_k = q (t_k − t_{k−1}),      y_k = x_k + v_k,  var v_k = r,
///
/// smoothed with the ratio r/q that makes the record most likely (local level model: Durbin and Koopman, Time Series
/// Analysis by State Space Methods, 2nd ed. 2012, ch. 2). A record without noise comes back as it is.
///
/// `times` increase strictly, one value for each.
[[nodiscard]] std::vector<double> without_noise(std::vector<double> const& times, std::vector<double> const& values);

}  // namespace thermotwin::scenarios
