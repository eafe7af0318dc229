#pragma once

#include <string_view>

namespace thermotwin::twin {

/// Whether a machine that stands is given this input: temperatures, the room, and that it is on.
inline bool is_given_while_standing(std::string_view channel, bool is_temperature) {
  return is_temperature || channel.starts_with("ambient.") || channel == "machine.on";
}

}  // namespace thermotwin::twin
