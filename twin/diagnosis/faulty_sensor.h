#pragma once

#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"

namespace thermotwin::twin {

/// The one sensor that shows nothing in a run, or whose readings jump about as no temperature does; empty: none, or
/// more than one.
[[nodiscard]] std::string faulty_sensor(std::vector<BinnedRun> const& runs);

}  // namespace thermotwin::twin
