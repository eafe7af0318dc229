#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "twin/machine.h"
#include "twin/run.h"

namespace thermotwin::twin {

/// Of a table with a row per channel: as wide as the longest name and title.
struct ChannelWidths {
  std::size_t name = 14, title = 34;
};
[[nodiscard]] ChannelWidths channel_widths(std::vector<output::Channel> const& channels);

/// What a run prints at its end: rise of every sensor, drift of every channel, what the solver did, the energy balance.
[[nodiscard]] std::string summary_table(Machine const& machine, RunResult const& result);

/// The same for programs, as JSON.
[[nodiscard]] std::string summary_json(Machine const& machine, RunResult const& result);

/// Its part about channels: each one's name, unit, start, end, lowest and highest, null where nothing was read.
[[nodiscard]] nlohmann::ordered_json extremes_json(std::vector<output::Channel> const& channels);

}  // namespace thermotwin::twin
