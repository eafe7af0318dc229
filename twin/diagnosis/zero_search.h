#pragma once

#include <Eigen/Core>
#include <optional>

#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// A question and its answer.
struct Fitted {
  Estimation estimation;
  Fit fit;
};

/// The same question with zeros that changed, of each channel the most evident one, and fitted; nothing where there are
/// none, or less evidence with them. Their score (score.h) is T > `threshold` + 2 ln N, of N that are tried, the
/// readings show them by themselves, a sensor's where the run begins and a displacement's from one sample to the next,
/// and the fit confirms them. A displacement's zero where a run begins is unknown anyway, and where the inputs jump,
/// effects are asked instead.
[[nodiscard]] std::optional<Fitted> with_changed_zeros(Estimation const& estimation, Fit const& fit, double threshold);

}  // namespace thermotwin::twin
