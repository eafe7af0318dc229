#pragma once

#include <Eigen/Core>
#include <vector>

#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// What one linearisation says about an effect that the machine does not have (physics.md 8.5):
///
///   T = b²/a,  ψ̂ = b/a,  a = s⊥ᵀ s⊥,  b = s⊥ᵀ r,   s⊥ = s − J (JᵀJ)⁻¹ Jᵀ s,
///
/// s: whitened response to the amplitude in units of the trial's `largest`; r, J: residual and Jacobian of a fit,
/// priors included. Under "nothing is missing" T is χ² with one degree of freedom.
struct Score {
  double statistic = 0.0;    ///< T; 0 where the sign is not allowed
  double amplitude = 0.0;    ///< ψ̂, in units of the trial's largest
  double information = 0.0;  ///< a
  double kept = 0.0;         ///< |s⊥|/|s|: what nuisance parameters leave of the signature
};

/// The whitened responses of hypotheses about a fit of an estimation, one column each: one linearisation for all.
/// Hypotheses that the machine cannot be built with have a zero column.
[[nodiscard]] Eigen::MatrixXd signatures(Estimation const& estimation, Fit const& fit,
                                         std::vector<Hypothesis> const& hypotheses);

/// What is left of signatures when everything that the fit could explain by its own unknowns is taken away.
[[nodiscard]] Eigen::MatrixXd projected(Fit const& fit, Eigen::MatrixXd const& signatures);

[[nodiscard]] std::vector<Score> score(Fit const& fit, Eigen::MatrixXd const& signatures,
                                       std::vector<Hypothesis> const& hypotheses);

}  // namespace thermotwin::twin
