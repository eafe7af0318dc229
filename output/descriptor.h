#pragma once

#include <filesystem>
#include <string_view>

namespace thermotwin::output {

/// An open file as the system counts them, closed with its owner. Whatever fails leaves its reason in errno.
class Descriptor {
 public:
  /// `flags` as open(2) takes them.
  Descriptor(std::filesystem::path const& path, int flags);
  /// A second one for a file that is open already: 1 is standard output.
  [[nodiscard]] static Descriptor of(int number);
  ~Descriptor();
  Descriptor(Descriptor const&) = delete;
  Descriptor& operator=(Descriptor const&) = delete;

  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  [[nodiscard]] int number() const { return number_; }

  /// All bytes; false when only a part of them could be written. A limit to the size of files (RLIMIT_FSIZE) is an
  /// error like a full disk: from the first write on, this process ignores SIGXFSZ, which would kill it.
  [[nodiscard]] bool write(std::string_view bytes) const;
  [[nodiscard]] bool synchronise() const;

 private:
  explicit Descriptor(int number) : number_(number) {}

  int number_;
};

}  // namespace thermotwin::output
