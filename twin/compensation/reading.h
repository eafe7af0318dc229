#pragma once

#include <string>
#include <string_view>
#include <variant>

namespace thermotwin::twin {

/// What one message says: a temperature, an input of the machine, or an offset.
struct Reading {
  std::string name;
  double value = 0.0;  ///< in `unit`; NaN: the sender has none
  std::string unit;    ///< "degC", "rpm", "um", …
  double time = 0.0;   ///< of the sample [s], on the sender's clock
  std::string quality{"good"};
};

/// Longer messages are refused unread [bytes].
inline constexpr std::size_t longest_payload = 1024;

/// {"name":"T2","quality":"good","time":120.0,"unit":"degC","value":23.41}; a value that is not finite is null.
[[nodiscard]] std::string payload_of(Reading const& reading);

/// The inverse; or the reason why this is not a message: too long, no JSON, a key missing, unknown or of another kind,
/// a time that is not finite. Whatever the bytes, it throws nothing.
[[nodiscard]] std::variant<Reading, std::string> read_payload(std::string_view payload);

}  // namespace thermotwin::twin
