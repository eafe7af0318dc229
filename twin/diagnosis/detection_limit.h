#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "twin/diagnosis/estimation.h"
#include "twin/diagnosis/score.h"

namespace thermotwin::twin {

/// How large an effect at a site may be without being named: what data cannot show, calibration takes for numbers of
/// the file.
struct DetectionLimit {
  Hypothesis hypothesis;
  double amplitude = 0.0;  ///< [SI]; the largest plausible one where that would not be named either
  bool any_size = false;   ///< it would not
  std::string channel{};   ///< that it moves most there: a displacement where any was measured, else a sensor
  std::string unit{};      ///< in which people read that: um, K
  double swing = 0.0;      ///< of that channel in the run where it is largest, numbers as calibrated [m, K]
};

/// The smallest amplitude, in units of its largest, whose evidence exceeds what is asked in 95 of 100 such records
/// (minimum detectable value with β = 5 %, ISO 11843-1:1997, 10), from a score's information a alone:
///
///   ψ = (b + 1.645 √a)/a,   b: evidence_of = asked,   as b = a ψ + N(0, a) of a true ψ.
[[nodiscard]] double detectable(double information, Hypothesis const& hypothesis, double asked);

/// One per effect and site, in the shape in which it moves most, by how much that is; not of what is a sensor's fault.
/// `signatures`: of the hypotheses about a fit, not whitened; `scores`: of the same.
[[nodiscard]] std::vector<DetectionLimit> detection_limits(Estimation const& estimation, Fit const& fit,
                                                           std::vector<Hypothesis> const& hypotheses,
                                                           Eigen::MatrixXd const& signatures,
                                                           std::vector<Score> const& scores, double asked);

}  // namespace thermotwin::twin
