#pragma once

#include <Eigen/Core>
#include <vector>

#include "thermal/exponential_step.h"
#include "thermal/reduced_network.h"
#include "twin/reduced_twin.h"

namespace thermotwin::twin {

/// What an observer believes of its model and of its sensors.
struct ObserverTrust {
  double interval = 1.0;       ///< between two steps [s]
  double unknown_heat = 20.0;  ///< that each friction, loss or film patch errs by, white over `heat_memory` [W]
  double heat_memory = 600.0;  ///< [s]
  double reading_noise = 0.1;  ///< of each sensor [K]
};

/// The reduced twin beside a running machine: a step forward with the inputs, a correction by the sensors,
///
///   ξ⁻ = e^{−Λh} ξ + h φ₁ N(ξ, u) + h φ₂ (N(ξ*, u) − N(ξ, u)),   ξ = ξ⁻ + L (z − ẑ(ξ⁻)),
///
/// the first an exponential Runge–Kutta step of second order (Cox & Matthews, J. Comput. Phys. 176 (2002) 430, eq. 22),
/// L the steady gain of the Kalman filter of the linear part, whose Riccati equation is solved by doubling (Chu, Fan,
/// Lin & Wang, Int. J. Control 77 (2004) 767). A sensor without a reading (NaN) corrects nothing. One per machine and
/// thread; the twin must outlive it.
class LiveTwin {
 public:
  /// The machine begins at one temperature [K].
  LiveTwin(ReducedTwin const& twin, double start_temperature, ObserverTrust const& trust = {});

  /// One interval on, with inputs in the order of the network's channels, held. InputError when one is out of range.
  void advance(std::vector<double> const& input);
  /// One reading [K] per sensor of the machine that is on a body, in their order.
  void correct(Eigen::VectorXd const& readings);

  [[nodiscard]] Eigen::VectorXd const& readings() const { return seen_; }  ///< expected now [K]
  [[nodiscard]] Eigen::VectorXd displacements() const;  ///< Σ w (T − T(0)), SI, in the machine's order
  [[nodiscard]] Eigen::VectorXd const& state() const { return state_; }
  [[nodiscard]] Eigen::MatrixXd const& gain() const { return gain_; }

 private:
  void find_gain(ObserverTrust const& trust);

  ReducedTwin const* twin_;
  thermal::ReducedEvaluation evaluation_;
  thermal::ReducedSums sensors_, displacements_;
  thermal::ExponentialFactors factors_;
  double interval_;
  Eigen::VectorXd state_, begin_, end_, seen_, first_displacements_;
  Eigen::MatrixXd gain_, sensor_rows_;
};

}  // namespace thermotwin::twin
