#pragma once

#include <Eigen/Core>

namespace thermotwin::twin {

/// A linear system in white noise, from one sample to the next, exactly:
///
///   dx/dt = M x + w   ⇒   x(t + Δt) = F x(t) + ε,   F = exp(M Δt),   cov ε = Q = ∫₀^Δt exp(M s) W exp(Mᵀ s) ds.
struct Discretisation {
  Eigen::MatrixXd transition;  ///< F
  Eigen::MatrixXd noise;       ///< Q
};

/// `intensity`: √W of each state [unit of the state/√s]; W is diagonal.
///
/// Van Loan's block exponential (IEEE Trans. Automatic Control 23 (1978) 395, theorem 1) over Δt/2^k, short enough for
/// the fastest node; then k times Q ← Q + F Q Fᵀ, F ← F². So exp(−M Δt), which a stiff network makes overflow, never
/// appears.
[[nodiscard]] Discretisation discretise(Eigen::MatrixXd const& dynamics, Eigen::VectorXd const& intensity,
                                        double interval);

}  // namespace thermotwin::twin
