#pragma once

#include <atomic>

namespace CLI {
class App;
}

namespace thermotwin::twin {

/// `thermotwin calibrate`
void add_calibrate_command(CLI::App& app, std::atomic<bool> const& stop);
/// `thermotwin diagnose`
void add_diagnose_command(CLI::App& app, std::atomic<bool> const& stop);
/// `thermotwin compare`
void add_compare_command(CLI::App& app);
/// `thermotwin challenge`
void add_challenge_command(CLI::App& app);

}  // namespace thermotwin::twin
