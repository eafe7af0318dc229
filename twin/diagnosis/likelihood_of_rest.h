#pragma once

#include <Eigen/Cholesky>

#include "models/log_determinant.h"
#include "twin/diagnosis/unknown.h"

namespace thermotwin::twin {

/// Of 2 ln likelihood: what a machine that is warm, or a sensor that is wrong, has to gain over one at rest.
inline constexpr double evident_gain = 11.0;

/// cov(d) of first readings of a machine at rest, σ_o² I + σ_s² 1 1ᵀ [K²]: offsets of the sensors, and a start that is
/// warmer throughout.
[[nodiscard]] inline Eigen::MatrixXd covariance_of_rest(Eigen::Index sensors) {
  Eigen::MatrixXd cov = offset_deviation * offset_deviation * Eigen::MatrixXd::Identity(sensors, sensors);
  cov.array() += start_deviation * start_deviation;
  return cov;
}

/// 2 ln of N(d; 0, cov(d)), without what does not depend on it.
[[nodiscard]] inline double likelihood(Eigen::MatrixXd const& cov, Eigen::VectorXd const& d) {
  Eigen::LLT<Eigen::MatrixXd> const factor(cov);
  return -d.dot(factor.solve(d)) - models::log_determinant(factor);
}

}  // namespace thermotwin::twin
