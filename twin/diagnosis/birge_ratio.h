#pragma once

#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// How much farther the numbers of the file and the lags of its sensors are from their priors than those say:
///
///   R² = Σ ((x − mean)/deviation)² / Σ (1 − σ²/deviation²),  not below 1,
///
/// σ: the standard error of the fit; numbers that the data do not know count for as little in both sums. Where it is
/// above 1, the machine's form is not quite right and numbers stand in for it: every 2 ln of evidence is R² times too
/// large, as if all uncertainties were R times what they are taken for (R. T. Birge, Phys. Rev. 40, 1932, p. 207).
[[nodiscard]] double squared_birge_ratio(Estimation const& estimation, Fit const& fit);

/// How many times more 2 ln must say than where R is 1, since they are too large and chance makes large ones more
/// often: R⁴, and no more than 4, for a rough file is no reason to name nothing.
[[nodiscard]] double strictness(Estimation const& estimation, Fit const& fit);
inline constexpr double strictest = 4.0;

/// Whether a number is farther from the file than `far_from_file` of its prior deviations. That alone says that the
/// form of the machine is not quite right: many numbers that are do not make up for it, as they do in R.
[[nodiscard]] bool has_left_file(Estimation const& estimation, Fit const& fit);

}  // namespace thermotwin::twin
