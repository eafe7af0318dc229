#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "output/descriptor.h"

namespace thermotwin::output {

/// A file that this process alone may use while the object lives; the system frees it when the process ends, however
/// it ends. (flock; on network file systems as far as they have it.)
class LockedFile {
 public:
  enum class Busy { wait, refuse };

  /// Opens the file, or makes it. OutputError when it cannot be opened, or is in use and `busy` says refuse.
  LockedFile(std::filesystem::path path, Busy busy);

  [[nodiscard]] std::filesystem::path const& path() const { return path_; }
  [[nodiscard]] std::string contents() const;
  /// Cuts everything behind the first `size` bytes.
  void shorten(std::size_t size);
  /// In one piece, at the end. OutputError when the disk is full, or at a size limit; the file is as it was, then.
  void append(std::string_view bytes);
  void remove() const;

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  Descriptor descriptor_;
};

}  // namespace thermotwin::output
