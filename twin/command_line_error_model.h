#pragma once

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin fit` and `predict`.
void add_error_model_commands(CLI::App& app);

}  // namespace thermotwin::twin
