#pragma once

#include <Eigen/Core>

namespace thermotwin::twin {

/// τ dy/dt = x(t) − y, y(t₀) = x(t₀): a course x, linear between its points, as seen through a first-order lag.
///
/// On a piece x = x₀ + r s the solution is exact: y(s) = x₀ + (y₀ − x₀) e^{−s/τ} + r (s − τ (1 − e^{−s/τ})).
/// With τ = 0 it is x itself. Before the first point and after the last the course is held.
class FirstOrderLag {
 public:
  /// Times strictly increasing [s], one value for each; `lag` τ ≥ 0 [s]. Throws InputError.
  FirstOrderLag(Eigen::VectorXd time, Eigen::VectorXd course, double lag);

  [[nodiscard]] double at(double t) const;

 private:
  [[nodiscard]] double advance(Eigen::Index piece, double elapsed) const;

  Eigen::VectorXd time_;
  Eigen::VectorXd course_;
  Eigen::VectorXd state_;  ///< y at the points
  double lag_;
};

}  // namespace thermotwin::twin
