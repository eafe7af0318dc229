#pragma once

#include <atomic>

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin view`: the report page, served on loopback and renewed while its files change.
void add_view_command(CLI::App& app, std::atomic<bool> const& stop);

}  // namespace thermotwin::twin
