#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace thermotwin::twin {

/// Unknowns b on which residuals depend linearly, at their best for whatever the others are (variable projection: Golub
/// & Pereyra, SIAM J. Numer. Anal. 10 (1973) 413, with a constant S):
///
///   min over b of |r − S b|² + |(b − m)/d|²,   (SᵀS + 1/d²) b = Sᵀr + m/d².
class Elimination {
 public:
  /// S: residual × unknown; m and d: of the prior of each, d > 0.
  Elimination(Eigen::MatrixXd columns, Eigen::VectorXd mean, Eigen::VectorXd const& deviation);

  [[nodiscard]] Eigen::MatrixXd const& columns() const { return columns_; }
  /// b.
  [[nodiscard]] Eigen::VectorXd best(Eigen::VectorXd const& residual) const;
  /// |(b − m)/d|².
  [[nodiscard]] double prior_cost(Eigen::VectorXd const& b) const;
  /// What is left of JᵀJ, J: derivative of the residual by others, when b follows: JᵀJ − JᵀS (SᵀS + 1/d²)⁻¹ SᵀJ.
  [[nodiscard]] Eigen::MatrixXd curvature(Eigen::MatrixXd const& jacobian) const;

 private:
  Eigen::MatrixXd columns_;
  Eigen::VectorXd mean_, precision_;  ///< m, 1/d²
  Eigen::LLT<Eigen::MatrixXd> information_;
};

}  // namespace thermotwin::twin
