#pragma once

#include <string>
#include <vector>

#include "twin/machine.h"

namespace thermotwin::twin {

/// Input channels that a machine's parts and displacements ask for, in alphabetical order, each once.
[[nodiscard]] std::vector<std::string> needed_channels(Machine const& machine);

}  // namespace thermotwin::twin
