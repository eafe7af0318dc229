#pragma once

#include <filesystem>
#include <string>

namespace thermotwin::twin {

/// A file's bytes. FileError that says why they cannot be had: no such file, a folder.
[[nodiscard]] std::string text_of_file(std::filesystem::path const& path);

}  // namespace thermotwin::twin
