#include "scenarios/time_stamp.h"

#include <gtest/gtest.h>

namespace thermotwin::scenarios {
namespace {

TimeStamp stamp(std::string_view text) { return parse_time_stamp(text).value(); }

/// From 7 o'clock UTC [s].
double after_seven(std::string_view text) { return seconds_between(stamp("2025-11-24T07:00:00Z"), stamp(text)); }

TEST(TimeStamp, IsReadInEachForm) {
  for (auto const* text :
       {"2025-11-24 07:00:00", "2025-11-24T07:00:00", "2025-11-24T07:00", "2025-11-24 07:00:00.000",
        "2025-11-24T07:00:00Z", "2025-11-24T08:00:00+01:00", "2025-11-24 08:00:00 +0100", "2025-11-24T01:30:00-05:30",
        "2025-11-24T08:00+01", "24.11.2025 07:00:00", "24.11.2025 07:00", "24.11.2025 7:00:00,0"})
    EXPECT_EQ(after_seven(text), 0.0) << text;
}

TEST(TimeStamp, CountsSecondsAndDays) {
  EXPECT_DOUBLE_EQ(after_seven("2025-11-24T07:00:00.5"), 0.5);
  EXPECT_DOUBLE_EQ(after_seven("24.11.2025 07:00:01,123456789"), 1.123456);
  EXPECT_DOUBLE_EQ(after_seven("1.12.2025 06:59:00"), 7 * 86400.0 - 60.0);
  EXPECT_DOUBLE_EQ(seconds_between(stamp("28.02.2024 12:00"), stamp("01.03.2024 12:00")), 2 * 86400.0);
}

TEST(TimeStamp, MayHaveAZone) {
  EXPECT_FALSE(stamp("2025-11-24 07:00:00").zone);
  EXPECT_FALSE(stamp("24.11.2025 07:00:00").zone);
  EXPECT_EQ(stamp("2025-11-24 07:00:00Z").zone, std::chrono::minutes(0));
  EXPECT_EQ(stamp("2025-11-24 07:00:00-03:30").zone, -std::chrono::minutes(210));
}

TEST(TimeStamp, HasTheTimeOfDayOfItsOwnClock) {
  EXPECT_EQ(time_of_day(stamp("2025-11-24T07:30:00+01:00")), 7.5 * 3600.0);
  EXPECT_EQ(time_of_day(stamp("24.11.2025 23:00"), 2 * 3600.0), 3600.0);
  EXPECT_EQ(time_of_day(stamp("24.11.2025 01:00"), -25 * 3600.0), 0.0);
}

/// In 2025 on 30 March and 26 October.
TEST(TimeStamp, TellsWhereAClockWasPut) {
  auto const forward = [](char const* from, char const* to) { return may_be_put_forward(stamp(from), stamp(to)); };
  EXPECT_TRUE(forward("30.03.2025 01:59:59", "30.03.2025 03:00:00"));
  EXPECT_TRUE(forward("2025-03-30 01:50", "2025-03-30 03:00"));
  EXPECT_FALSE(forward("2025-03-30 01:59", "2025-03-30 02:00"));
  EXPECT_FALSE(forward("2025-03-30 01:00", "2025-03-30 03:00"));  // may be a logger that was off
  EXPECT_FALSE(forward("2025-03-23 01:59", "2025-03-23 03:00"));
  EXPECT_FALSE(forward("2025-03-30T01:59+01:00", "2025-03-30T03:00+02:00"));
  auto const back = [](char const* from, char const* to) { return may_be_put_back(stamp(from), stamp(to)); };
  EXPECT_TRUE(back("26.10.2025 02:59:59", "26.10.2025 02:00:00"));
  EXPECT_TRUE(back("2025-10-26 02:50", "2025-10-26 02:05"));
  EXPECT_FALSE(back("2025-10-26 02:00", "2025-10-26 02:59"));
  EXPECT_FALSE(back("2025-10-26 03:59", "2025-10-26 03:00"));
  EXPECT_FALSE(back("2025-10-19 02:59", "2025-10-19 02:00"));
  EXPECT_FALSE(back("2025-10-26T02:59+02:00", "2025-10-26T02:00+02:00"));
}

TEST(TimeStamp, IsNothingElse) {
  for (auto const* text : {"",
                           "0",
                           "21.5",
                           "1e3",
                           "-12",
                           "2025",
                           "time",
                           "2025-11-24",
                           "24.11.2025",
                           "07:00:00",
                           "11/24/2025 07:00:00",
                           "24/11/2025 07:00",
                           "24.11.25 07:00:00",
                           "24-11-2025 07:00:00",
                           "2025-11-24 7 h",
                           "2025-11-24 07",
                           "2025-11-24 07:",
                           "2025-11-24 07:0",
                           "2025-11-24 07:00:",
                           "2025-11-24 07:00:00.",
                           "2025-11-24 07:00:00 PM",
                           "2025-11-24 07:00:00+",
                           "2025-11-24 07:00:00+01:",
                           "2025-11-24 07:00:00+25:00",
                           "24.11.2025 07:00:00Z",
                           "2025-13-01 07:00:00",
                           "2025-02-29 07:00:00",
                           "31.04.2025 07:00",
                           "2025-11-24 24:00:00",
                           "2025-11-24 07:60",
                           "2025-11-24 07:00:60",
                           "99999-11-24 07:00",
                           "24.11.2025  07:00"})
    EXPECT_FALSE(parse_time_stamp(text)) << text;
}

}  // namespace
}  // namespace thermotwin::scenarios
