#include "scenarios/time_stamp.h"

#include <cstddef>

namespace thermotwin::scenarios {
namespace {

using std::chrono::microseconds;
using Seconds = std::chrono::duration<double>;

/// Takes a text from its front.
class Scanner {
 public:
  explicit Scanner(std::string_view rest) : rest_(rest) {}

  [[nodiscard]] bool done() const { return rest_.empty(); }

  bool take(std::string_view any_of) {
    if (rest_.empty() || any_of.find(rest_.front()) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }

  /// The next digits, `most` at most; −1 if fewer than `fewest` are there.
  int number(std::size_t fewest, std::size_t most) {
    int value = 0;
    std::size_t digits = 0;
    for (; digits < most && !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'; ++digits) {
      value = 10 * value + (rest_.front() - '0');
      rest_.remove_prefix(1);
    }
    return digits < fewest ? -1 : value;
  }

 private:
  std::string_view rest_;
};

std::optional<std::chrono::sys_days> calendar_day(int year, int month, int day) {
  if (year < 0 || month < 0 || day < 0) return std::nullopt;
  std::chrono::year_month_day const date{std::chrono::year(year), std::chrono::month(unsigned(month)),
                                         std::chrono::day(unsigned(day))};
  if (!date.ok()) return std::nullopt;
  return std::chrono::sys_days(date);
}

/// "2025-11-24", and what stands before the hour.
std::optional<std::chrono::sys_days> take_iso_date(Scanner& text) {
  int const year = text.number(4, 4);
  if (!text.take("-")) return std::nullopt;
  int const month = text.number(2, 2);
  if (!text.take("-")) return std::nullopt;
  int const day = text.number(2, 2);
  if (!text.take("T ")) return std::nullopt;
  return calendar_day(year, month, day);
}

/// "24.11.2025", and the space.
std::optional<std::chrono::sys_days> take_german_date(Scanner& text) {
  int const day = text.number(1, 2);
  if (!text.take(".")) return std::nullopt;
  int const month = text.number(1, 2);
  if (!text.take(".")) return std::nullopt;
  int const year = text.number(4, 4);
  if (!text.take(" ")) return std::nullopt;
  return calendar_day(year, month, day);
}

/// "7:00", "07:00:00", "07:00:00.5"
std::optional<microseconds> take_time(Scanner& text) {
  int const hour = text.number(1, 2);
  if (!text.take(":")) return std::nullopt;
  int const minute = text.number(2, 2);
  bool const has_seconds = text.take(":");
  int const second = has_seconds ? text.number(2, 2) : 0;
  if (hour < 0 || hour > 23 || minute < 0 || minute > 59 || second < 0 || second > 59) return std::nullopt;
  microseconds time = std::chrono::hours(hour) + std::chrono::minutes(minute) + std::chrono::seconds(second);
  if (!has_seconds || !text.take(".,")) return time;
  int digit = text.number(1, 1);
  if (digit < 0) return std::nullopt;
  for (microseconds share = std::chrono::milliseconds(100); digit >= 0; share /= 10, digit = text.number(1, 1))
    time += digit * share;
  return time;
}

/// "Z", "+01:00", "+0100", "+01"
std::optional<std::chrono::minutes> take_zone(Scanner& text) {
  text.take(" ");
  if (text.take("Z")) return std::chrono::minutes(0);
  bool const ahead = text.take("+");
  if (!ahead && !text.take("-")) return std::nullopt;
  int const hours = text.number(2, 2);
  bool const has_minutes = text.take(":") || !text.done();
  int const minutes = has_minutes ? text.number(2, 2) : 0;
  if (hours < 0 || hours > 14 || minutes < 0 || minutes > 59) return std::nullopt;
  return (ahead ? 1 : -1) * (std::chrono::hours(hours) + std::chrono::minutes(minutes));
}

/// 0 h of the last Sunday of a month, in the year of a stamp.
std::chrono::sys_days last_sunday(std::chrono::month month, TimeStamp const& stamp) {
  auto const year = std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(stamp.clock)).year();
  return year / month / std::chrono::Sunday[std::chrono::last];
}

}  // namespace

std::optional<TimeStamp> parse_time_stamp(std::string_view text) {
  bool const year_first = text.size() > 4 && text[4] == '-';
  Scanner scanner(text);
  auto const day = year_first ? take_iso_date(scanner) : take_german_date(scanner);
  auto const time = day ? take_time(scanner) : std::nullopt;
  if (!time) return std::nullopt;
  if (scanner.done()) return TimeStamp{*day + *time, std::nullopt};
  auto const zone = year_first ? take_zone(scanner) : std::nullopt;
  if (!zone || !scanner.done()) return std::nullopt;
  return TimeStamp{*day + *time, zone};
}

double seconds_between(TimeStamp const& from, TimeStamp const& to) {
  auto const utc = [](TimeStamp const& stamp) { return stamp.clock - stamp.zone.value_or(std::chrono::minutes(0)); };
  return Seconds(utc(to) - utc(from)).count();
}

bool may_be_put_forward(TimeStamp const& from, TimeStamp const& to) {
  constexpr auto hour = std::chrono::hours(1);
  auto const day = last_sunday(std::chrono::March, to);
  return !to.zone && from.clock < day + 2 * hour && to.clock >= day + 3 * hour &&
         to.clock - from.clock <= hour + std::chrono::minutes(15);
}

bool may_be_put_back(TimeStamp const& from, TimeStamp const& to) {
  constexpr auto hour = std::chrono::hours(1);
  auto const day = last_sunday(std::chrono::October, to);
  return !to.zone && to.clock >= day + 2 * hour && to.clock <= from.clock && from.clock <= day + 3 * hour;
}

double time_of_day(TimeStamp const& stamp, double later) {
  auto const then = stamp.clock + std::chrono::round<microseconds>(Seconds(later));
  return Seconds(then - std::chrono::floor<std::chrono::days>(then)).count();
}

}  // namespace thermotwin::scenarios
