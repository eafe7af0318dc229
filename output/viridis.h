#pragma once

#include <array>

namespace thermotwin::output {

/// Red, green and blue, 0 to 1, from dark violet at 0 to yellow at 1 (van der Walt and Smith 2015).
[[nodiscard]] std::array<double, 3> viridis(double share);

}  // namespace thermotwin::output
