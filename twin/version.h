#pragma once

#include <string_view>

namespace thermotwin::twin {

/// Of the program, as in CMakeLists.txt: "0.1.0".
[[nodiscard]] std::string_view version();

/// The commit that was built, as `git describe --always --dirty --tags` names it, or "unknown" outside a repository.
[[nodiscard]] std::string_view commit();

/// CRC-32 of the sources that a result is computed by, committed or not.
[[nodiscard]] std::string_view sources();

}  // namespace thermotwin::twin
