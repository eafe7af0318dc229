#pragma once

#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/diagnosis/hypothesis.h"

namespace thermotwin::twin {

/// Whether any of the runs lets an effect be seen that makes the air follow an input: max u − min u ≥ 1/4 of that
/// input's scale 1. Where the input hardly moves, as the daily cycle within an hour, the effect is a constant, which
/// the offsets of air and sensors are already. A trial that is for changes of an input alone (Trial::if_changes) asks
/// the same of that one. True for effects that follow no input.
[[nodiscard]] bool is_excited(Hypothesis const& hypothesis, Value const& document, Machine const& machine,
                              std::vector<BinnedRun> const& runs);

}  // namespace thermotwin::twin
