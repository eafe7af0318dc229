#pragma once

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin volumetric`.
void add_volumetric_command(CLI::App& app);

}  // namespace thermotwin::twin
