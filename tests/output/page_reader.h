#pragma once

#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include <zlib.h>

namespace thermotwin::tests {

/// A report page as a browser reads it: the document and the numbers.
class PageReader {
 public:
  explicit PageReader(std::string const& html)
      : document(nlohmann::json::parse(element(html, "document"))), bytes_(document["bytes"].get<std::size_t>(), '\0') {
    auto const packed = from_base64(element(html, "numbers"));
    auto size = uLongf(bytes_.size());
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes_.data()), &size, reinterpret_cast<Bytef const*>(packed.data()),
                         uLong(packed.size())),
              Z_OK);
    EXPECT_EQ(size, bytes_.size());
  }

  template <class T>
  [[nodiscard]] std::vector<T> numbers(nlohmann::json const& reference) const {
    std::size_t count = 1;
    for (auto const& length : reference["shape"]) count *= length.get<std::size_t>();
    std::vector<T> values(count);
    std::memcpy(values.data(), bytes_.data() + reference["at"].get<std::size_t>(), count * sizeof(T));
    return values;
  }

  nlohmann::json document;

 private:
  static std::string element(std::string const& html, std::string const& id) {
    auto const at = html.find("id=\"" + id + "\">");
    EXPECT_NE(at, std::string::npos) << id;
    auto const begin = html.find('>', at) + 1;
    return html.substr(begin, html.find("</script>", begin) - begin);
  }

  static std::string from_base64(std::string const& text) {
    static std::string const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int held = 0;
    for (char const c : text) {
      if (c == '=') break;
      bits = bits << 6 | std::uint32_t(digits.find(c));
      held += 6;
      if (held >= 8) bytes += char(bits >> (held -= 8) & 0xff);
    }
    return bytes;
  }

  std::string bytes_;
};

}  // namespace thermotwin::tests
