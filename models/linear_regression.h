#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace thermotwin::models {

/// y = b₀ + Σ_i b_i x_i + e by ordinary least squares (QR), with the statistics that judge it (methods.md §3.6):
///
///     F = (SSR/p) / (SSE/ν),   p_F = P(F_{p,ν} > F),   ν = N − p − 1
///     R² = 1 − SSE/SST,        R²_adj = 1 − (1 − R²)(N − 1)/ν
///     σ_res = √(SSE/ν),        e_max = max |e|
///     t_i = b_i / s_i,         p_i = 2 P(t_ν > |t_i|),   s_i² = σ_res² [(AᵀA)⁻¹]_ii,  A = [1 x]
///
/// These p values take residuals for independent. A thermal record's are not; hence a second column with the standard
/// errors of Newey and West (Econometrica 55 (1987) 703), valid under autocorrelation up to L samples:
///
///     V = N/ν Σ_{|l| ≤ L} (1 − |l|/(L+1)) Σ_t g_t g_{t−l}ᵀ,   g_t = (AᵀA)⁻¹ a_t e_t
///
/// Without residuals (SSE = 0) F and t are infinite and the p values 0.
struct LinearRegression {
  double intercept = 0;          ///< b₀
  Eigen::VectorXd coefficients;  ///< p
  Eigen::VectorXd residuals;     ///< N
  Eigen::Index degrees_of_freedom = 0;

  double F = 0, p_F = 1;
  double r_squared = 0, adjusted_r_squared = 0;
  double residual_deviation = 0, largest_residual = 0;  ///< σ_res, e_max in the response's unit

  Eigen::VectorXd standard_errors, t, p;              ///< of each coefficient, for independent residuals
  Eigen::VectorXd hac_standard_errors, hac_t, hac_p;  ///< the same under autocorrelated ones
  int hac_lags = 0;                                   ///< L
};

struct RegressionOptions {
  std::vector<std::string> names{};         ///< of the regressors, for messages; numbers without it
  std::vector<Eigen::Index> run_lengths{};  ///< samples of each run, in order; products g_t g_{t−l} stay in a run
  std::optional<int> hac_lags{};            ///< L; without it ⌊4 (N/100)^(2/9)⌋, at most the longest run less one
};

/// Throws std::invalid_argument, with the regressor's name, unless N ≥ p + 2, all numbers are finite, the response
/// moves, and no regressor is constant or a combination of the ones that precede it.
LinearRegression linear_regression(Eigen::MatrixXd const& regressors, Eigen::VectorXd const& response,
                                   RegressionOptions const& options = {});

}  // namespace thermotwin::models
