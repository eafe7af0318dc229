#pragma once

#include <Eigen/Core>
#include <functional>

namespace thermotwin::twin {

/// min ½ |r(x)|² with lower ≤ x ≤ upper.
struct LeastSquares {
  /// r(x), and ∂r/∂x if asked for. False where x has no answer.
  std::function<bool(Eigen::VectorXd const& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian)> evaluate;
  Eigen::Index residuals = 0;
  Eigen::VectorXd start, lower, upper;
  int iterations = 12;
  double tolerance = 1e-4;  ///< of the cost: it stops where a step gains less, or would by the linearisation
};

struct LeastSquaresResult {
  Eigen::VectorXd x;
  double cost = 0.0;  ///< ½ |r|²
  int iterations = 0;
  bool converged = false;
};

/// Levenberg–Marquardt with bounds: Ceres.
[[nodiscard]] LeastSquaresResult solve(LeastSquares const& problem);

}  // namespace thermotwin::twin
