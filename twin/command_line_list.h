#pragma once

namespace CLI {
class Option;
}

namespace thermotwin::twin {

/// Makes an option one of names with commas between them, and spaces around these as people like: "T1, T4". It takes
/// one word; what follows is not its.
void take_list(CLI::Option& option);

}  // namespace thermotwin::twin
