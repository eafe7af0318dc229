#pragma once

namespace thermotwin::twin {

/// Runs the program. Exit codes: 0 done, 2 the input is wrong or an output cannot be written, 1 anything else,
/// 130 stopped by the user.
int command_line(int argc, char** argv);

}  // namespace thermotwin::twin
