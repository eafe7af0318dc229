#pragma once

#include <vector>

#include "thermal/evaluation.h"
#include "thermal/multigrid.h"

namespace thermotwin::thermal {

/// Solves (s I − γJ) x = b, J = ∂(dy/dt)/∂y, for networks that are mostly grids of cells: flexible GMRES,
/// preconditioned by a cycle of multigrid. Only corrections are found here, so the work is done in single precision,
/// and repeated on the residual where more digits are asked for. Nothing is factorised but the coarsest level: a new γ
/// costs next to nothing. Source: Saad, Iterative Methods for Sparse Linear Systems, 2nd ed. 2003, §9.4.
///
/// With x = dy and τ = dT = x dT/dy: (s C (dy/dT) − γ SᵀGS) τ = C b.
class GridSystem {
 public:
  explicit GridSystem(Network const& network);

  void linearise(Linearisation const& at);
  /// s and γ; false if the system is singular.
  [[nodiscard]] bool shift(double identity, double gamma);
  /// Until the residual's 2-norm is below `tolerance`; false if it does not come that far.
  [[nodiscard]] bool solve(double const* b, double tolerance, double* x);

 private:
  template <class X>
  void multiply(X const* temperature, X* result);
  [[nodiscard]] double reduce(double const* residual, double size, double target, double* x);
  void orthogonalise(std::size_t count, std::vector<double>& column);

  Network const* network_;
  int nodes_;
  std::vector<float> capacity_, inverse_capacity_;
  std::vector<float> slope_;  ///< dT/dy; empty where it is 1 everywhere
  std::vector<PortCoupling> couplings_;
  Multigrid multigrid_;
  double identity_ = 1.0, gamma_ = -1.0;              ///< of the last shift
  std::vector<double> port_temperature_, port_heat_;  ///< of averages
  std::vector<double> residual_;
  std::vector<float> scaled_;
  std::vector<std::vector<float>> basis_, preconditioned_;
};

}  // namespace thermotwin::thermal
