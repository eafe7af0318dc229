#pragma once

#include <atomic>

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin place`; `stop`: set from outside to end it.
void add_place_command(CLI::App& app, std::atomic<bool> const& stop);

}  // namespace thermotwin::twin
