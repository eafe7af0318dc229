#pragma once

#include <filesystem>
#include <vector>

namespace thermotwin::twin {

/// Each file by its name, and where others have the same, with as many of its folders as tell it from them: "a/run.h5",
/// "b/run.h5".
[[nodiscard]] std::vector<std::filesystem::path> distinct_names(std::vector<std::filesystem::path> const& files);

}  // namespace thermotwin::twin
