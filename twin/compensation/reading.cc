#include "twin/compensation/reading.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace thermotwin::twin {
namespace {

using nlohmann::json;

constexpr std::size_t keys = 5;

/// Null where the message has no such key, or one of another kind.
std::string const* text_of(json const& message, char const* key) {
  auto const it = message.find(key);
  return it == message.end() ? nullptr : it->get_ptr<std::string const*>();
}

std::variant<Reading, std::string> read_message(json const& message) {
  auto const* name = text_of(message, "name");
  auto const* unit = text_of(message, "unit");
  auto const* quality = text_of(message, "quality");
  if (!name || !unit || !quality) return "'name', 'unit' and 'quality' must be texts";
  auto const time = message.find("time"), value = message.find("value");
  if (time == message.end() || !time->is_number()) return "'time' must be a number";
  if (value == message.end() || !(value->is_number() || value->is_null())) return "'value' must be a number or null";
  if (message.size() != keys) return "a message has name, value, unit, time and quality, and nothing else";
  double const number = value->is_null() ? std::numeric_limits<double>::quiet_NaN() : value->get<double>();
  return Reading{*name, number, *unit, time->get<double>(), *quality};
}

}  // namespace

std::string payload_of(Reading const& reading) {
  json message{{"name", reading.name}, {"unit", reading.unit}, {"time", reading.time}, {"quality", reading.quality}};
  message["value"] = std::isfinite(reading.value) ? json(reading.value) : json(nullptr);
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::variant<Reading, std::string> read_payload(std::string_view payload) {
  if (payload.size() > longest_payload)
    return fmt::format("a message of {} bytes; {} are the most", payload.size(), longest_payload);
  auto const message = json::parse(payload, nullptr, false);
  if (message.is_discarded() || !message.is_object()) return "not a JSON object";
  return read_message(message);
}

}  // namespace thermotwin::twin
