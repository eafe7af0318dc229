#pragma once

#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Numbers as the bytes that they are in memory, for files that only this program reads, on a machine like this one.
namespace thermotwin::twin::packed {

template <class T>
void put(std::string& bytes, T const& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<char const*>(&value), sizeof value);
}

/// Their number, then they.
template <class T>
void put_all(std::string& bytes, std::span<T const> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  put(bytes, values.size());
  bytes.append(reinterpret_cast<char const*>(values.data()), values.size_bytes());
}

/// Takes what was put, in the same order; std::out_of_range where there is less. The bytes must outlive this.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : left_(bytes) {}

  [[nodiscard]] bool empty() const { return left_.empty(); }
  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    copy(&value, sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> take_all() {
    auto const count = take<std::size_t>();
    if (count > left_.size() / sizeof(T)) throw std::out_of_range("packed bytes are cut short");
    std::vector<T> values(count);
    copy(values.data(), count * sizeof(T));
    return values;
  }

 private:
  void copy(void* to, std::size_t size) {
    if (size > left_.size()) throw std::out_of_range("packed bytes are cut short");
    if (size > 0) std::memcpy(to, left_.data(), size);
    left_.remove_prefix(size);
  }

  std::string_view left_;
};

}  // namespace thermotwin::twin::packed
