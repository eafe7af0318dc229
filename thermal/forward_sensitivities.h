#pragma once

#include <Eigen/Core>
#include <deque>
#include <functional>
#include <vector>

#include "thermal/evaluation.h"
#include "thermal/newton_system.h"
#include "thermal/parameter_columns.h"

namespace thermotwin::thermal {

/// S = dy/dθ, node × parameter, along a run whose steps and orders another integrator chooses:
///
///   dS/dt = J S + F,   J = ∂f/∂y,   F = ∂f/∂θ,
///
/// by the backward differentiation formula that the past times define,
///
///   Σᵢ dᵢ S(tₙ₋ᵢ) = J S(tₙ) + F(tₙ),   i = 0 … order,   d: weights of the derivative at tₙ of the polynomial through
///   all S(tₙ₋ᵢ).
///
/// As it is linear, one solution with the Jacobian of the new point is exact, for all parameters at once. The local
/// error is estimated from what the past predicts,
///
///   E = (S(tₙ) − Σᵢ pᵢ S(tₙ₋ᵢ)) / (d₀ (tₙ − tₙ₋q₋₁)),   i = 1 … q + 1, q the order,
///
/// and a step is cut into parts where the root mean square over the nodes of one parameter's E exceeds the tolerance.
/// Sources: Caracotsios & Stewart, Comput. Chem. Eng. 9 (1985) 359 (staggered direct method); Hairer, Nørsett & Wanner,
/// Solving Ordinary Differential Equations I, 2nd ed. 1993, III.5 (variable steps).
class ForwardSensitivities {
 public:
  /// `parameters` must outlive this. `tolerance` [K]: of S times a parameter's scale.
  ForwardSensitivities(Network const& network, std::vector<NetworkDerivative> const& parameters, LinearSolver solver,
                       double tolerance);

  /// At a start of the run: S of the state there, from the parameters' initial temperatures.
  void start(double time, double const* state);
  /// Begins anew at a time within the last step: behind a jump there is no past.
  void restart(double time);
  /// The run at a time within its last step; valid until asked again.
  struct Instant {
    double const* state;
    double const* input;
  };
  /// To the end of the run's next step. False if the linear systems cannot be solved.
  [[nodiscard]] bool step(double end, int order, std::function<Instant(double time)> const& run);
  /// dT/dθ of the nodes at a time within the last step, where the state is this.
  [[nodiscard]] NodeByParameter const& temperatures(double time, double const* state);

 private:
  struct Point {
    double time;
    NodeByParameter S;
  };
  struct Parts {
    std::vector<std::size_t> together, apart;  ///< of the parameters: those with a column, those without
  };
  ForwardSensitivities(Network const& network, std::vector<NetworkDerivative> const& parameters, LinearSolver solver,
                       double tolerance, Parts parts);
  [[nodiscard]] static Parts parts_of(std::vector<NetworkDerivative> const& parameters);
  [[nodiscard]] NodeByParameter const& forcing(Instant const& at);
  [[nodiscard]] bool advance(double time, Instant const& at);
  [[nodiscard]] double error();
  [[nodiscard]] double weight(std::size_t point, std::size_t first, std::size_t end, double time) const;
  void interpolate(double time, NodeByParameter& S) const;

  Network const* network_;
  std::vector<NetworkDerivative> const* parameters_;
  Parts parts_;
  ParameterColumns columns_;
  Evaluation evaluation_;
  NewtonSystem newton_;
  Eigen::VectorXd per_tolerance_;  ///< scale of a parameter over the tolerance [1/K per unit of S]
  std::deque<Point> past_;         ///< the newest first; of the last step all parts
  int order_ = 0;                  ///< of the last part
  double gamma_ = 0.0;             ///< 1/d₀ of the last part
  NodeByParameter together_, forcing_, at_time_, spare_;
};

}  // namespace thermotwin::thermal
