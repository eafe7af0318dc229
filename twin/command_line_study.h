#pragma once

#include <atomic>

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin study`; `stop`: set from outside to end it.
void add_study_command(CLI::App& app, std::atomic<bool> const& stop);

}  // namespace thermotwin::twin
