#pragma once

#include <Eigen/Core>
#include <functional>

namespace thermotwin::twin {

/// |r(x)|² and, of its linearisation, the normal equations: all that a fit needs of r, however long it is.
struct NormalEquations {
  double cost = 0.0;          ///< |r|²
  Eigen::VectorXd gradient;   ///< Jᵀr, J = ∂r/∂x
  Eigen::MatrixXd curvature;  ///< JᵀJ, positive definite
};

/// min |r(x)|² with lower ≤ x ≤ upper.
struct LeastSquares {
  /// The cost, and the rest if asked for. False where x has no answer.
  std::function<bool(Eigen::VectorXd const& x, bool linearised, NormalEquations& at)> evaluate;
  Eigen::VectorXd start, lower, upper;
  int iterations = 12;
  double tolerance = 1e-4;  ///< of the cost: it stops where a step would gain less, by the linearisation
};

struct LeastSquaresResult {
  Eigen::VectorXd x;
  bool converged = false;
};

/// Levenberg–Marquardt with bounds: Ceres.
[[nodiscard]] LeastSquaresResult solve(LeastSquares const& problem);

}  // namespace thermotwin::twin
