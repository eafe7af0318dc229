#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace thermotwin::twin {

/// What a file is kept under: 64 bits of all that went in. Fowler, Noll & Vo, "FNV-1a".
class Fingerprint {
 public:
  void add(std::string_view bytes) {
    for (unsigned char const c : bytes) hash_ = (hash_ ^ c) * 0x100000001b3u;
  }
  /// Numbers by their bytes, with how many there are.
  template <class T>
  void add(std::span<T const> values) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    auto const count = values.size();
    add({reinterpret_cast<char const*>(&count), sizeof count});
    add({reinterpret_cast<char const*>(values.data()), values.size_bytes()});
  }
  template <class T>
  void add(std::vector<T> const& values) {
    add(std::span<T const>(values));
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) { add({reinterpret_cast<char const*>(&value), sizeof value}); }

  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace thermotwin::twin
