#pragma once

#include <Eigen/Core>
#include <functional>

namespace thermotwin::thermal {

/// e^{−Λh} and φ_k(−Λh) of a diagonal Λ: φ₀ = e^z, φ_{k+1}(z) = (φ_k(z) − 1/k!)/z, φ_k(0) = 1/k!.
struct ExponentialFactors {
  Eigen::ArrayXd decay, phi1, phi2, phi3;

  /// `rate`: Λ ≥ 0, ascending.
  void set(Eigen::VectorXd const& rate, double h);
};

/// One step of dξ/dt = −Λ ξ + N(t, ξ), with the linear part solved exactly: fourth order, four evaluations of N, the
/// last of which is the first of the next step. Source: Krogstad, J. Comput. Phys. 203 (2005) 72, ETDRK4-B; error
/// estimate of third order: Whalen, Brio & Moloney, J. Comput. Phys. 280 (2015) 579.
///
/// Right for heat networks, whose fast part is conduction and whose rest is slow: a step is not bound by the cells.
class ExponentialStep {
 public:
  using Rest = std::function<void(double t, Eigen::VectorXd const& state, Eigen::VectorXd& result)>;

  ExponentialStep(Eigen::VectorXd const& rate, Rest rest);

  /// Begins anew at t, for example after a jump of the inputs.
  void restart(double t, Eigen::VectorXd const& state);
  /// Tries a step; `result` is where it leads to, `error` the estimate. The state moves on by `accept`.
  void attempt(double h);
  void accept();

  [[nodiscard]] double time() const { return t_; }
  [[nodiscard]] Eigen::VectorXd const& state() const { return state_; }
  [[nodiscard]] Eigen::VectorXd const& error() const { return error_; }
  /// ξ at t + θ within the step that was attempted last: the linear part exactly, N as the parabola through the step's
  /// beginning, middle and end.
  void interpolate(double theta, Eigen::VectorXd& result);

 private:
  Eigen::VectorXd const* rate_;
  Rest rest_;
  double t_ = 0.0, h_ = 0.0;
  Eigen::VectorXd state_, result_, error_, first_, middle_, second_middle_, last_, next_, stage_;
  ExponentialFactors half_, full_, part_;
};

}  // namespace thermotwin::thermal
