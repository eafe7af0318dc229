#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// A point for a fit to begin at, drawn from the priors, within bounds.
[[nodiscard]] Eigen::VectorXd drawn_start(Estimation const& estimation, std::uint64_t seed);

/// Where fits begin: at the means of the priors. Without drawings there are many optima, and which one a fit ends in
/// depends on where it began: then at four points more, drawn with a tenth of the priors' deviations.
[[nodiscard]] std::vector<Eigen::VectorXd> starts(Estimation const& estimation);

/// Of the fits from all these starts, the one with the most evidence.
[[nodiscard]] Fit best_fit(Estimation const& estimation, int iterations = 12);

}  // namespace thermotwin::twin
