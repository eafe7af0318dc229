#pragma once

#include <atomic>

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin run`; `stop`: set from outside to end it.
void add_run_command(CLI::App& app, std::atomic<bool> const& stop);

/// `thermotwin replay`
void add_replay_command(CLI::App& app, std::atomic<bool> const& stop);

}  // namespace thermotwin::twin
