#pragma once

#include <string>

#include "twin/reduced_twin.h"

namespace thermotwin::twin {

/// What a reduced run prints at its end: every sensor and displacement with the bound of what it errs by.
[[nodiscard]] std::string reduced_table(ReducedTwin const& twin, ReducedResult const& result);

}  // namespace thermotwin::twin
