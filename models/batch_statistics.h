#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace thermotwin::models {

/// Residual standard deviation of a model of batch l on batch k (methods.md §7.5; Miao et al. 2016, Eq. 8):
///
///     S_{l→k} = √( Σ_t (y_t − ŷ_t)²/ν )
///
/// ν = N − parameters on the batch that the model was fitted to, N on others (parameters = 0); N as well where a model
/// has as many parameters as samples.
double residual_deviation(Eigen::VectorXd const& truth, Eigen::VectorXd const& prediction, double parameters = 0);

/// S_{l→k} for L models (rows), the l-th of them fitted to batch l, on K ≥ L batches (columns). `predictions[l][k]` is
/// model l on batch k, the last instants of that batch where it is shorter (ErrorModel::unclaimed_instants);
/// `parameters[l]` are those of model l.
Eigen::MatrixXd deviation_matrix(std::span<Eigen::VectorXd const> errors,
                                 std::vector<std::vector<Eigen::VectorXd>> const& predictions,
                                 std::span<double const> parameters);

/// How well models of single batches fit and how well, and how evenly, they predict the others:
///
///     S_l = S_{l→l},   Mn_l = 1/(L−1) Σ_{k≠l} S_{l→k},   Sd_l = √( 1/(L−2) Σ_{k≠l} (S_{l→k} − Mn_l)² ),   k ≤ L
///
/// and over the batches k > L, which no model has seen, with the divisors K−L and K−L−1: the verification.
struct BatchStatistics {
  Eigen::VectorXd S, Mn, Sd;                         ///< L each [µm]
  Eigen::VectorXd verification_Mn, verification_Sd;  ///< L each; empty without such batches [µm]
};

/// Needs L ≥ 3, and none or at least two batches of verification (std::invalid_argument).
BatchStatistics batch_statistics(Eigen::MatrixXd const& deviations);

}  // namespace thermotwin::models
