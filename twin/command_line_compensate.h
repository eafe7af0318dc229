#pragma once

#include <atomic>

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin compensate` and `play`; `stop`: set from outside to end them.
void add_compensation_commands(CLI::App& app, std::atomic<bool> const& stop);

}  // namespace thermotwin::twin
