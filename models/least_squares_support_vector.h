#pragma once

#include <Eigen/Core>
#include <span>

#include "models/error_model.h"

namespace thermotwin::models {

/// The least-squares support vector machine (Suykens & Vandewalle 1999; methods.md §5.6): f(x) = Σ α_i K(x, x_i) + b,
///
///     [ 0   1ᵀ      ] [b]   [0]
///     [ 1   Ω + I/γ ] [α] = [y],   Ω_ij = K(x_i, x_j),
///
/// by one Cholesky factor of A = Ω + I/γ: η = A⁻¹ 1, ν = A⁻¹ y, b = 1ᵀν/1ᵀη, α = ν − b η.
struct LeastSquaresSupportVector {
  Eigen::VectorXd weights;  ///< α
  double intercept = 0;     ///< b
  double parameters = 0;    ///< trace of ∂ŷ/∂y = N − (tr A⁻¹ − ηᵀη/1ᵀη)/γ
};

LeastSquaresSupportVector solve_least_squares(Eigen::MatrixXd const& kernel, Eigen::VectorXd const& target,
                                              double gamma);

/// Many targets on one kernel, a column each, by one factor; and by how much each sample misses what a machine trained
/// on all others predicts, in closed form (Cawley & Talbot, Neural Networks 17 (2004) 1467):
///
///     y_i − f₋ᵢ(x_i) = α_i / (A⁻¹_ii − η_i²/1ᵀη)
struct LeastSquaresSupportVectors {
  Eigen::MatrixXd weights;        ///< α, samples × targets
  Eigen::RowVectorXd intercepts;  ///< b
  Eigen::MatrixXd left_out;       ///< y_i − f₋ᵢ(x_i), samples × targets
};

LeastSquaresSupportVectors solve_least_squares_leaving_out(Eigen::MatrixXd const& kernel,
                                                           Eigen::MatrixXd const& targets, double gamma);

/// K = exp(−‖x − x'‖²/(2σ²)), γ = 56.2 and σ² = 0.2 (paper 002); inputs and target each between 0 and 1, the range in
/// which this σ² makes sense.
ErrorModel fit_least_squares_support_vector(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
