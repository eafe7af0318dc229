#pragma once

#include <Eigen/Core>
#include <span>

#include "models/error_model.h"
#include "models/training_set.h"

namespace thermotwin::models {

/// Principal components of the correlation matrix (methods.md §7.2):
///
///     Z_j = (A_j − μ_j)/s_j,   R = ZᵀZ/(N−1),   R u_k = λ_k u_k,   λ_1 ≥ … ≥ λ_p
///
/// A column that does not move takes no part. The largest entry of each u_k is positive.
struct PrincipalComponents {
  Eigen::VectorXd mean, deviation;  ///< p: μ, s (divisor N − 1)
  Eigen::VectorXd variances;        ///< λ, descending
  Eigen::MatrixXd directions;       ///< p × p, column k is u_k

  /// m = min{k : Σ_{i≤k} λ_i / Σ λ_i > share}.
  [[nodiscard]] Eigen::Index count_for(double share) const;
};

PrincipalComponents principal_components(Eigen::MatrixXd const& columns);

/// y = b₀ + Σ b_j A_j through the first m components:
///
///     F_k = Z u_k,   θ_k = F_kᵀ(y − ȳ)/((N−1) λ_k),   b_j = (1/s_j) Σ_{k≤m} θ_k u_jk,   b₀ = ȳ − Σ b_j μ_j
///
/// With m = p this is least squares.
struct ComponentRegression {
  Eigen::VectorXd scores;  ///< m: θ
  double intercept = 0;
  Eigen::VectorXd coefficients;
};

ComponentRegression component_regression(Eigen::MatrixXd const& columns, Eigen::VectorXd const& response,
                                         PrincipalComponents const& components, Eigen::Index count);

/// Component regression of a set, as many components as explain more than 85 % of the variance (Miao et al. 2016).
ErrorModel component_model(std::string method, TrainingSet const& set);

/// On the readings of one instant.
ErrorModel fit_principal_component(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
