#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "models/error_model.h"

namespace thermotwin::models {

/// What ε-SVR minimises besides flatness, and how exactly (methods.md §4.4).
struct SupportVectorOptions {
  double cost = 1;          ///< C
  double epsilon = 0.02;    ///< half width of the tube without loss [unit of the target]
  double tolerance = 1e-3;  ///< largest violation of the optimality conditions
};

/// f(x) = Σ_k a_k K(x_k, x) + b, a = α − α*, on the given rows of a kernel's matrix; a_k = 0 outside of them.
struct SupportVectorRegression {
  Eigen::VectorXd weights;
  double intercept = 0;
};

/// The dual of ε-SVR, solved by LIBSVM (Chang & Lin 2011) for a kernel given as a matrix over all N samples:
///
///     max −½ ΣΣ a_i a_j K_ij − ε Σ|a_i| + Σ y_i a_i,   Σ a_i = 0,   |a_i| ≤ C
class SupportVectorSolver {
 public:
  explicit SupportVectorSolver(Eigen::MatrixXd const& kernel);
  [[nodiscard]] SupportVectorRegression solve(Eigen::VectorXd const& target, std::vector<Eigen::Index> const& rows,
                                              SupportVectorOptions const& options) const;

 private:
  struct Node {  ///< as LIBSVM lays a precomputed kernel out: number of the row, then its values
    int index;
    double value;
  };
  Eigen::Index samples_;
  std::vector<Node> nodes_;
};

/// ε-SVR with K = exp(−g ‖x − x'‖²) on inputs and target of mean 0 and variance 1 among the rows that are fitted; C and
/// g from 2⁻⁴, 2⁻³, …, 2⁴, the pair of least squared error in a cross-validation by contiguous folds, of several runs
/// by whole ones. (Paper 001: grid and kernel; ε, folds and scaling are not stated there.)
ErrorModel fit_support_vector(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
