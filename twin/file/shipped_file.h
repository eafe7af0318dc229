#pragma once

#include <filesystem>
#include <string>

namespace thermotwin::twin {

/// A path, or the name of a file that comes with the program: `<folder>/<name>.toml`, folder from the source's root.
/// What has neither a folder nor the suffix .toml is the name where there is one, whatever lies in the present folder.
/// InputError "there is no <kind> …" with the nearest name.
[[nodiscard]] std::filesystem::path shipped_file(std::string const& kind, std::filesystem::path const& folder,
                                                 std::string const& name_or_path);

}  // namespace thermotwin::twin
