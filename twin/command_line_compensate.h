#pragma once

#include <atomic>

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin fit`, `compensate` and `play`; `stop`: set from outside to end the latter two.
void add_compensation_commands(CLI::App& app, std::atomic<bool> const& stop);

}  // namespace thermotwin::twin
