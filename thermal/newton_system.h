#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <span>
#include <vector>

#include "thermal/evaluation.h"
#include "thermal/grid_system.h"
#include "thermal/integrate.h"
#include "thermal/linear_factors.h"

namespace thermotwin::thermal {

/// Solves (I − γM) x = b for the state [y | energies], the system that every implicit step poses: y are the network's
/// enthalpy temperatures, the four energies (supplied, withdrawn, lost, exchanged) are counted in units of the
/// network's capacity, so that they are kelvin too:
///
///   M = | J  0 |   J = ∂(dy/dt)/∂y,
///       | P  0 |   P = ∂(powers)/∂y / ΣC.
///
/// J is never formed: every average brings two unknowns of its own, its temperature T̄ and the heat Q̂ into it, so that
/// the matrix stays as sparse as the network,
///
///   yᵢ − γ/Cᵢ (Σ G T + Σ wᵢ Q) = bᵢ,   T̄ − Σ wᵢ Tᵢ = 0,   Q − Σ G T = 0.
///
/// As Σ Cᵢ yᵢ + lost + withdrawn − supplied has derivative zero, and M holds the same sum rule exactly, every Newton
/// correction keeps the balance to round-off, converged or not, however old M is: the energy rows are solved exactly,
/// and what an iterative solver leaves of its residual is put right by one uniform shift of all temperatures.
class NewtonSystem {
 public:
  static constexpr int energies = 4;

  NewtonSystem(Network const& network, LinearSolver solver);

  /// J/K of the whole network: the unit of the energies.
  [[nodiscard]] double energy_unit() const { return total_capacity_; }

  /// Takes G and P at a state and an operating point.
  void linearise(Evaluation& evaluation, double const* state, double const* input);
  /// What was taken last.
  [[nodiscard]] Linearisation const& linearisation() const { return at_; }
  /// Factorises I − γM; false if it is singular.
  [[nodiscard]] bool factorise(double gamma);
  /// −J instead, for a step of Newton's method to the steady state.
  [[nodiscard]] bool factorise_steady();
  /// `tolerance` bounds the 2-norm of the residual of an iterative solver; b and x: nodes and energies. False if it
  /// does not converge.
  [[nodiscard]] bool solve(std::span<double const> b, double tolerance, std::span<double> x);
  /// The nodes alone.
  [[nodiscard]] bool solve_nodes(Eigen::VectorXd const& b, double tolerance, Eigen::VectorXd& x);
  /// The same for many right-hand sides, which the solutions replace; `tolerance` is relative to each.
  [[nodiscard]] bool solve_nodes(double tolerance, NodeByParameter& x);

  /// Pattern of the matrix that is factorised; empty with multigrid.
  [[nodiscard]] Eigen::SparseMatrix<double> const& pattern() const { return matrix_; }

 private:
  [[nodiscard]] bool factorise(double identity, double gamma);
  [[nodiscard]] bool solve_nodes(double const* b, double tolerance, double* x);
  void lay_out();
  void fill_matrix();
  void take_power();
  [[nodiscard]] Eigen::Vector4d power_of(double const* temperature) const;
  void keep_balance(double const* b, double* x) const;

  Network const& network_;
  int nodes_, averages_;
  Eigen::VectorXd capacity_, has_heat_;  ///< 0 for a controller's state
  double total_capacity_, unit_capacity_;
  Linearisation at_;
  std::vector<int> power_nodes_;                           ///< whose temperature changes a power
  Eigen::Matrix<double, energies, Eigen::Dynamic> power_;  ///< P, of these
  Eigen::Vector4d power_of_shift_;                         ///< when all that has heat becomes 1 K warmer
  double gamma_ = 0.0;
  std::vector<double> right_side_;
  Eigen::VectorXd right_, all_;
  NodeByParameter all_columns_;

  /// I·identity + fixed − γ·rate, on the nodes, the averages' T̄ and their Q̂ = γ Q/unit_capacity.
  Eigen::SparseMatrix<double> matrix_;
  Eigen::VectorXd fixed_, rate_;
  std::vector<int> diagonal_slots_, coupling_slots_;
  struct WeightSlots {
    int mean, share;
  };
  std::vector<std::vector<WeightSlots>> weight_slots_;
  std::unique_ptr<LinearFactors> factors_;
  std::unique_ptr<GridSystem> grids_;  ///< instead of matrix and factors
};

}  // namespace thermotwin::thermal
