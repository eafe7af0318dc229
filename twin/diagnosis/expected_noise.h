#pragma once

#include <string>
#include <vector>

#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// The noise that is expected of a channel before the data have spoken: its instrument's, a model error of 0.1 K over
/// ten minutes (physics.md 8.6) and, over hours, of 1 % of what a thermometer, 1.5 % of what a displacement goes
/// through in a run.
[[nodiscard]] ChannelNoise expected_noise(Machine const& machine, std::string const& channel,
                                          std::vector<BinnedRun> const& runs);

/// The question to these runs with that noise.
[[nodiscard]] Estimation expected_estimation(Value const& machine, std::vector<BinnedRun> const& runs);

}  // namespace thermotwin::twin
