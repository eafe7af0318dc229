#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// What one linearisation says about an effect that the machine does not have (physics.md 8.5):
///
///   T = b²/a,  ψ̂ = b/a,  a = s⊥ᵀ s⊥,  b = s⊥ᵀ r,   s⊥ = s − J (JᵀJ)⁻¹ Jᵀ s,
///
/// s: whitened response to the amplitude in units of its `largest`; r, J: residual and Jacobian of a fit,
/// priors included. Under "nothing is missing" T is χ² with one degree of freedom.
struct Score {
  double statistic = 0.0;    ///< T; 0 where the sign is not allowed
  double amplitude = 0.0;    ///< ψ̂, in units of its largest
  double information = 0.0;  ///< a
};

/// The responses of hypotheses about a fit of an estimation, one column each, not whitened: one linearisation for all.
[[nodiscard]] Eigen::MatrixXd signatures(Estimation const& estimation, Fit const& fit,
                                         std::vector<Hypothesis> const& hypotheses);

/// What is left of signatures when a fit's unknowns have imitated what they can of them.
class Remainder {
 public:
  /// `signatures` whitened as the fit is, in its rows from there on, whole blocks of them; both must outlive this.
  Remainder(Fit const& fit, Eigen::MatrixXd const& signatures, Eigen::Index first_row = 0);

  /// Of either sign, one for each signature.
  [[nodiscard]] std::vector<Score> scores() const;
  [[nodiscard]] std::vector<Score> scores(std::vector<Hypothesis> const& hypotheses) const;
  /// Cosine between what is left of one signature and of each other (physics.md 8.9).
  [[nodiscard]] Eigen::VectorXd cosines(Eigen::Index of) const;

 private:
  Fit const* fit_;
  Eigen::MatrixXd const* signatures_;
  Eigen::Index first_row_;
  Eigen::LLT<Eigen::MatrixXd> information_;  ///< JᵀJ
  Eigen::MatrixXd shared_, taken_;           ///< Jᵀs, (JᵀJ)⁻¹ Jᵀs
};

/// The most probable ψ that is plausible, b/(a + 1/σ²) with σ the deviation of its prior, and its standard error.
[[nodiscard]] double probable_amplitude(Score const& score);
[[nodiscard]] double probable_error(Score const& score);

/// 2 ln of the evidence for an effect from its score alone, at the most probable ψ: T less what the prior of ψ and the
/// choice of a site cost. Only the latter where ψ is ordinary.
[[nodiscard]] double evidence_of(Score const& score, Hypothesis const& hypothesis);

/// The smallest amplitude, in units of its largest, whose evidence exceeds what is asked in 95 of 100 such records
/// (minimum detectable value with β = 5 %, ISO 11843-1:1997, 10), from a score's information a alone:
///
///   ψ = (b + 1.645 √a)/a,   b: evidence_of = asked,   as b = a ψ + N(0, a) of a true ψ.
[[nodiscard]] double detectable(double information, Hypothesis const& hypothesis, double asked);

}  // namespace thermotwin::twin
