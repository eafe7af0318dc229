#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace thermotwin::twin {

/// Each file by its name, and where others have the same, with as many of its folders as tell it from them: "a/run.h5",
/// "b/run.h5".
[[nodiscard]] std::vector<std::filesystem::path> distinct_names(std::vector<std::filesystem::path> const& files);

/// What a run is called, by the name of its file: "a/run" of "a/run.h5".
[[nodiscard]] std::string name_of_run(std::filesystem::path const& file);

}  // namespace thermotwin::twin
