#pragma once

#include <vector>

#include "scenarios/sampled.h"
#include "scenarios/signal.h"

namespace thermotwin::twin {

/// A change of what is held between samples. It shows in the first sample after it.
struct InputChange {
  double time = 0.0;     ///< of that sample [s]
  double earlier = 0.0;  ///< how long before, at most: since the sample before it [s]
  double size = 0.0;     ///< of the largest value of the input
};

/// Those of a sampled input whose course is `signal`. What is recorded where it changes is recorded in time, and has
/// none, though rows at regular times may stand between.
[[nodiscard]] std::vector<InputChange> changes_of(scenarios::SampledInput const& input,
                                                  scenarios::Signal const& signal);

/// In order of time; those of one moment are one. Of more than `most` those with the most size times time: a
/// linearisation has a column for each.
[[nodiscard]] std::vector<InputChange> merged(std::vector<InputChange> changes, std::size_t most = 500);

}  // namespace thermotwin::twin
