#pragma once

#include <span>

namespace thermotwin::models {

/// The value below which the share of the numbers lies, along straight lines between them: of n, at place share·(n −
/// 1). `ordered`: ascending, at least one; `share`: 0 to 1.
[[nodiscard]] double quantile(std::span<double const> ordered, double share);

}  // namespace thermotwin::models
