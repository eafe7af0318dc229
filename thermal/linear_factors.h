#pragma once

#include <Eigen/SparseCore>
#include <memory>

#include "thermal/integrate.h"

namespace thermotwin::thermal {

/// A square sparse matrix, factorised exactly or nearly, that solves A x = b many times. All matrices given to one
/// object have the pattern of the first.
class LinearFactors {
 public:
  LinearFactors() = default;
  LinearFactors(LinearFactors const&) = delete;
  LinearFactors& operator=(LinearFactors const&) = delete;
  virtual ~LinearFactors() = default;

  /// False if the matrix is singular.
  [[nodiscard]] virtual bool factorise(Eigen::SparseMatrix<double> const& matrix) = 0;
  /// `tolerance` bounds the 2-norm of the residual where the solution is found by iteration. False if it is not found.
  [[nodiscard]] virtual bool solve(Eigen::Ref<Eigen::VectorXd const> const& b, double tolerance,
                                   Eigen::Ref<Eigen::VectorXd> x) = 0;
  /// The same for many right-hand sides, one per column, which the solutions replace; `tolerance` is relative to each.
  [[nodiscard]] virtual bool solve_columns(double tolerance, NodeByParameter& x);
};

/// By solve(b, tolerance of its residual, x), one column after another.
template <class Solve>
bool solve_one_by_one(double tolerance, NodeByParameter& x, Solve solve) {
  Eigen::VectorXd right, solution(x.rows());
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    right = x.col(k);
    if (!solve(right, tolerance * right.norm(), solution)) return false;
    x.col(k) = solution;
  }
  return true;
}

/// Dense LU, KLU (Davis & Palamadai Natarajan, ACM TOMS 37 (2010) 36), or BiCGSTAB with incomplete LU (van der Vorst
/// 1992).
[[nodiscard]] std::unique_ptr<LinearFactors> make_linear_factors(LinearSolver solver);

/// What a sparse LU of this pattern costs: KLU's estimate of its multiplications per nonzero.
[[nodiscard]] double factorisation_effort(Eigen::SparseMatrix<double> const& pattern);

}  // namespace thermotwin::thermal
