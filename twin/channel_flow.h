#pragma once

#include "thermal/channel.h"
#include "twin/assembly.h"
#include "twin/description.h"

namespace thermotwin::twin {

/// The fluid line that a `[[channel]]` describes, with the fluid's properties at 20 °C.
[[nodiscard]] thermal::Channel channel_of(ChannelDescription const& description);

/// Lets the fluid flow: in at the temperature of the inlet's input channel, out at its own.
void add_channel_flow(Assembly& assembly, ChannelDescription const& description);

}  // namespace thermotwin::twin
