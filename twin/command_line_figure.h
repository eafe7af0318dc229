#pragma once

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin figure`: one panel of the report page for print.
void add_figure_command(CLI::App& app);

}  // namespace thermotwin::twin
