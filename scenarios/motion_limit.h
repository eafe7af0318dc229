#pragma once

#include <string>

#include "scenarios/machine_limits.h"

namespace thermotwin::scenarios {

/// Times what the machine can do that a record may have.
inline constexpr double overshoot = 1.2;

/// Of a channel whose largest magnitude [SI] is beyond `most` times what the machine can do: "reaches 50, and the most
/// is 1; is its unit right?"; empty for others.
[[nodiscard]] std::string beyond_limit(std::string const& channel, double largest, MachineLimits const& machine,
                                       double most);

}  // namespace thermotwin::scenarios
