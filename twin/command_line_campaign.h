#pragma once

#include <atomic>

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `campaign`: see twin/campaign/run_campaign.h.
void add_campaign_command(CLI::App& app, std::atomic<bool> const& stop);

}  // namespace thermotwin::twin
