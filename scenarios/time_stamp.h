#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace thermotwin::scenarios {

/// A date and a time of day as loggers write them, to the microsecond.
struct TimeStamp {
  std::chrono::sys_time<std::chrono::microseconds> clock;  ///< what the logger's clock showed
  std::optional<std::chrono::minutes> zone;                ///< by which that is ahead of UTC, where it says so
};

/// The forms that are read, for people.
inline constexpr std::string_view time_stamp_forms =
    "\"2025-11-24 07:00:00\", \"2025-11-24T07:00:00.5+01:00\" (or Z), \"24.11.2025 07:00:00\", \"24.11.2025 07:00\"";

/// ISO 8601 with a space or a T, seconds and their decimals (after a point or a comma) as far as there are any, and a
/// zone or none; or day.month.year. Nothing for any other text, and for days and hours that no calendar has.
[[nodiscard]] std::optional<TimeStamp> parse_time_stamp(std::string_view text);

/// From one to the other [s]. Stamps without a zone count as UTC.
[[nodiscard]] double seconds_between(TimeStamp const& from, TimeStamp const& to);

/// What the clock shows so much later [s], 0 to 86400 s.
[[nodiscard]] double time_of_day(TimeStamp const& stamp, double later = 0.0);

/// Whether a clock of Central Europe that keeps summer time was put between two of its stamps, which have no zone: from
/// 2 h to 3 h on a last Sunday of March, with no more than a quarter of an hour between the stamps besides; back from 3
/// h to 2 h on a last Sunday of October. Other zones, and stamps further apart, are not known.
[[nodiscard]] bool may_be_put_forward(TimeStamp const& from, TimeStamp const& to);
[[nodiscard]] bool may_be_put_back(TimeStamp const& from, TimeStamp const& to);

}  // namespace thermotwin::scenarios
