#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace thermotwin::twin {

/// A path, or the name of a file that comes with the program: `<folder>/<name>.toml`, folder from the source's root.
/// What has neither a folder nor the suffix .toml is the name where there is one, whatever lies in the present folder.
/// InputError "there is no <kind> …" with the nearest name.
[[nodiscard]] std::filesystem::path shipped_file(std::string const& kind, std::filesystem::path const& folder,
                                                 std::string const& name_or_path);

/// The names of what comes with the program in such a folder, in order.
[[nodiscard]] std::vector<std::string> shipped_names(std::filesystem::path const& folder);

}  // namespace thermotwin::twin
