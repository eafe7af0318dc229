#pragma once

#include <span>
#include <vector>

namespace thermotwin::models {

/// The value below which the share of the numbers lies, along straight lines between them: of n, at place share·(n −
/// 1). `ordered`: ascending, at least one; `share`: 0 to 1.
[[nodiscard]] double quantile(std::span<double const> ordered, double share);

/// The number in the middle, of an even count the upper one. At least one value, in any order.
[[nodiscard]] double upper_median(std::vector<double> values);

}  // namespace thermotwin::models
