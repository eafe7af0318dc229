#pragma once

#include <Eigen/Core>
#include <span>

#include "models/contiguous_folds.h"
#include "models/error_model.h"

namespace thermotwin::models {

/// Ridge regression (Hoerl & Kennard, Technometrics 12 (1970) 55) on standardised columns z:
///
///     min 1/N Σ_t (y_t − b₀ − Σ_j c_j z_tj)² + λ Σ_j c_j²,   λ = 10^(−6 … 2) in quarter decades
///
/// with the λ of least mean squared error in a cross-validation that leaves out one fold after the other; columns are
/// standardised by the rows that are fitted. A column that does not move gets the coefficient 0.
struct RidgeRegression {
  double intercept = 0;
  Eigen::VectorXd coefficients;  ///< of the columns as they came
  double penalty = 0;            ///< λ
  double parameters = 0;         ///< 1 + Σ_j d_j/(d_j + λ), d the eigenvalues of zᵀz/N
  double validation_rmse = 0;    ///< √ of that least error [unit of the response]
};

RidgeRegression ridge_regression(Eigen::MatrixXd const& columns, Eigen::VectorXd const& response,
                                 std::vector<Fold> const& folds);

/// Ridge regression on the readings of one instant.
ErrorModel fit_ridge(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
