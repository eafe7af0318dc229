#pragma once

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin difference`: two runs, or a measurement and its twin, as fields on the machine.
void add_difference_command(CLI::App& app);

}  // namespace thermotwin::twin
