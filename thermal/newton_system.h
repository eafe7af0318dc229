#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <span>

#include "thermal/evaluation.h"
#include "thermal/integrate.h"

namespace thermotwin::thermal {

/// Solves (I − γM) x = b for the state [y | energies], the system that every implicit step poses: y are the network's
/// enthalpy temperatures, the four energies (supplied, withdrawn, lost, exchanged) are counted in units of the
/// network's capacity, so that they are kelvin too:
///
///   M = | J  0 |   J = ∂(dy/dt)/∂y,
///       | P  0 |   P = ∂(powers)/∂y / ΣC.
///
/// As Σ Cᵢ yᵢ + lost + withdrawn − supplied has derivative zero, and M holds the same sum rule exactly, every Newton
/// correction keeps the balance to round-off, converged or not, however old M is: the energy rows are solved exactly,
/// and what an iterative solver leaves of its residual is put right by one uniform shift of all temperatures.
class NewtonSystem {
 public:
  static constexpr int energies = 4;

  NewtonSystem(Network const& network, LinearSolver solver);
  ~NewtonSystem();
  NewtonSystem(NewtonSystem const&) = delete;
  NewtonSystem& operator=(NewtonSystem const&) = delete;

  /// J/K of the whole network: the unit of the energies.
  [[nodiscard]] double energy_unit() const { return total_capacity_; }

  /// Takes J and P at a state and an operating point.
  void linearise(Evaluation& evaluation, double const* state, double const* input);
  /// Factorises I − γM; false if it is singular.
  [[nodiscard]] bool factorise(double gamma);
  /// `tolerance` bounds the 2-norm of the residual of an iterative solver; x may be b. False if it does not converge.
  [[nodiscard]] bool solve(std::span<double const> b, double tolerance, std::span<double> x);

 private:
  struct Factors;
  struct DenseFactors;
  struct SparseFactors;
  struct KrylovFactors;

  void keep_balance(Eigen::Ref<Eigen::VectorXd const> const& b, Eigen::Ref<Eigen::VectorXd> x) const;

  Eigen::VectorXd capacity_, has_heat_;  ///< 0 for a controller's state
  double total_capacity_;
  Eigen::SparseMatrix<double> jacobian_, matrix_;  ///< J; I − γJ
  PowerGradient power_;
  double gamma_ = 0.0;
  std::unique_ptr<Factors> factors_;
};

}  // namespace thermotwin::thermal
