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

/// One per effect and site, in the shape in which it moves most, by how much that is; not of what is a sensor's fault.
/// `signatures`: of the hypotheses about a fit, not whitened; `scores`: of the same.
[[nodiscard]] std::vector<DetectionLimit> detection_limits(Estimation const& estimation, Fit const& fit,
                                                           std::vector<Hypothesis> const& hypotheses,
                                                           Eigen::MatrixXd const& signatures,
                                                           std::vector<Score> const& scores, double asked);

}  // namespace thermotwin::twin
