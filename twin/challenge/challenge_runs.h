#pragma once

#include <cstdint>
#include <vector>

#include "scenarios/experiment.h"
#include "scenarios/machine_limits.h"

namespace thermotwin::twin {

/// The three runs of a challenge, drawn from its seed: two to diagnose with, the last one held out.
///
/// | run | load | |
/// |---|---|---|
/// | 1 | five times 1 h on, 1 h off at full speed; three steps of 2 h; cool-down (schedule C of physics.md §7) | 21 h |
/// | 2 | blocks of 20 min at random speeds for 8 h, 2 h of rest, a step of 2 h; cool-down | 16 h |
/// | 3 | blocks of 20 to 90 min at random speeds for 8 h; cool-down | 13 h |
///
/// Each begins with an hour of rest, the drives off for its first half; after the load the drives are switched off,
/// then the machine. The door opens some times, coolant runs for some hours, air temperature and its course differ.
/// Speed, or feed where the machine has no spindle, follows the load.
[[nodiscard]] std::vector<scenarios::Experiment> challenge_runs(scenarios::MachineLimits const& limits,
                                                                std::uint64_t seed);

}  // namespace thermotwin::twin
