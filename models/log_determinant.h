#pragma once

#include <Eigen/Cholesky>
#include <limits>

namespace thermotwin::models {

/// ln det A = 2 Σ ln L_ii of A = L Lᵀ; −∞ where A was not positive definite.
[[nodiscard]] inline double log_determinant(Eigen::LLT<Eigen::MatrixXd> const& factors) {
  if (factors.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  return 2.0 * factors.matrixLLT().diagonal().array().log().sum();
}

}  // namespace thermotwin::models
