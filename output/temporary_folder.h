#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace thermotwin::output {

/// A folder of its own for files that are needed for a while; it goes with the object, with all that is in it.
class TemporaryFolder {
 public:
  /// OutputError when there is no room for it.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(TemporaryFolder const&) = delete;
  TemporaryFolder& operator=(TemporaryFolder const&) = delete;

  /// Writes a file into it, and says where that is.
  std::filesystem::path put(std::string const& name, std::string_view text) const;
  [[nodiscard]] std::filesystem::path operator/(std::string const& name) const { return path_ / name; }
  [[nodiscard]] std::filesystem::path const& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace thermotwin::output
