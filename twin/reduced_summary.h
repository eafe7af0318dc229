#pragma once

#include <string>

#include "twin/reduced_twin.h"

namespace thermotwin::twin {

/// What a reduced run prints at its end: every sensor and displacement with the bound of what it errs by.
[[nodiscard]] std::string reduced_table(ReducedTwin const& twin, ReducedResult const& result);

/// The same for programs, as JSON with the keys of summary_json (twin/summary.h) as far as a reduced run has them; each
/// channel with its `bound`.
[[nodiscard]] std::string reduced_json(ReducedTwin const& twin, ReducedResult const& result);

}  // namespace thermotwin::twin
