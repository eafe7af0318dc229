#pragma once

#include <Eigen/Core>
#include <memory>

#include "twin/diagnosis/elimination.h"

namespace thermotwin::twin {

/// Derivative of a fit's residual by its unknowns, J: dense by those that are searched; by those that are linear in the
/// blocks of an elimination, which all fits of an estimation share; of the priors' residuals a diagonal.
class Jacobian {
 public:
  Jacobian() = default;
  /// Of unknowns that are all searched. `own`: data row × unknown; `priors`: the diagonal, 1/deviation.
  Jacobian(Eigen::MatrixXd own, Eigen::VectorXd priors);
  /// Those that are linear are the unknowns from `first_linear` on; the columns of `own` are before and after them.
  Jacobian(Eigen::MatrixXd own, Eigen::VectorXd priors, std::shared_ptr<Elimination const> linear,
           Eigen::Index first_linear);

  [[nodiscard]] Eigen::VectorXd const& priors() const { return priors_; }
  /// By one unknown, data rows.
  [[nodiscard]] Eigen::VectorXd column(Eigen::Index unknown) const;
  /// By all, data row × unknown.
  [[nodiscard]] Eigen::MatrixXd of_data() const;
  /// Jᵀ s, s: signals in data rows from there on.
  [[nodiscard]] Eigen::MatrixXd transposed_times(Eigen::MatrixXd const& signals, Eigen::Index first_row = 0) const;
  /// Jᵀ r, r: data rows and priors.
  [[nodiscard]] Eigen::VectorXd gradient(Eigen::VectorXd const& residual) const;
  /// As if a searched unknown had no effect.
  void forget(Eigen::Index unknown);

 private:
  [[nodiscard]] Eigen::Index linear() const { return linear_ ? linear_->columns().cols() : 0; }
  [[nodiscard]] bool is_linear(Eigen::Index unknown) const;
  /// Of a searched one.
  [[nodiscard]] Eigen::Index place(Eigen::Index unknown) const;

  Eigen::MatrixXd own_;
  Eigen::VectorXd priors_;
  std::shared_ptr<Elimination const> linear_;
  Eigen::Index first_linear_ = 0;
};

/// A fit: the estimates, and what the data and the priors say of them together.
struct Fit {
  Eigen::VectorXd x;
  double cost = 0.0;         ///< |whitened residuals|² + |prior residuals|²: −2 ln posterior + constant
  Eigen::VectorXd residual;  ///< whitened, then the priors'
  Jacobian jacobian;
  Eigen::MatrixXd information;  ///< JᵀJ
  Eigen::MatrixXd covariance;   ///< its inverse
  bool converged = false;

  /// −2 ln evidence + constant, by Laplace's method: cost + ln |JᵀJ|, the priors' volume taken off, the choice of each
  /// effect's site added.
  double evidence = 0.0;
};

/// A fit as if one of its searched unknowns had been known to be zero, to first order: what its effect explained is in
/// the residual again. The others are not at their optimum then.
[[nodiscard]] Fit without(Fit fit, Eigen::Index unknown);

}  // namespace thermotwin::twin
