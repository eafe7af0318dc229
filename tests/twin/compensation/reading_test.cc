#include "twin/compensation/reading.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

std::string refusal(std::string const& payload) {
  auto const message = read_payload(payload);
  return std::holds_alternative<std::string>(message) ? std::get<std::string>(message) : "taken";
}

TEST(Reading, ComesBackAsItWasSent) {
  for (double const value : {23.41, -0.1, 1e-300, 4500.0, 1.0 / 3.0}) {
    Reading const sent{"T \"2\"\n", value, "degC", 1.6e9 + 0.125, "good"};
    auto const back = std::get<Reading>(read_payload(payload_of(sent)));
    EXPECT_EQ(back.name, sent.name);
    EXPECT_EQ(back.value, sent.value);
    EXPECT_EQ(back.unit, sent.unit);
    EXPECT_EQ(back.time, sent.time);
    EXPECT_EQ(back.quality, sent.quality);
  }
}

TEST(Reading, WithoutAValueIsNull) {
  auto const payload = payload_of({"T2", std::nan(""), "degC", 1.0, "bad"});
  EXPECT_THAT(payload, testing::HasSubstr("\"value\":null"));
  EXPECT_TRUE(std::isnan(std::get<Reading>(read_payload(payload)).value));
}

TEST(Reading, RefusesWhatIsNoMessage) {
  EXPECT_EQ(refusal(""), "not a JSON object");
  EXPECT_EQ(refusal("23.4"), "not a JSON object");
  EXPECT_EQ(refusal("{\"name\":\"T2\""), "not a JSON object");
  EXPECT_EQ(refusal(std::string(1000, '[')), "not a JSON object");
  EXPECT_EQ(refusal("\xff\xfe{}"), "not a JSON object");
  EXPECT_EQ(refusal(std::string(2000, ' ')), "a message of 2000 bytes; 1024 are the most");
  EXPECT_EQ(refusal("{}"), "'name', 'unit' and 'quality' must be texts");
  EXPECT_EQ(refusal(R"({"name":2,"unit":"degC","quality":"good","time":0,"value":1})"),
            "'name', 'unit' and 'quality' must be texts");
  EXPECT_EQ(refusal(R"({"name":"T2","unit":"degC","quality":"good","time":"0","value":1})"), "'time' must be a number");
  EXPECT_EQ(refusal(R"({"name":"T2","unit":"degC","quality":"good","time":0,"value":"1"})"),
            "'value' must be a number or null");
  EXPECT_EQ(refusal(R"({"name":"T2","unit":"degC","quality":"good","time":0,"value":1,"x":0})"),
            "a message has name, value, unit, time and quality, and nothing else");
  EXPECT_EQ(refusal(R"({"name":"T2","unit":"degC","quality":"good","time":0,"value":NaN})"), "not a JSON object");
  EXPECT_EQ(refusal(R"({"name":"T2","unit":"degC","quality":"good","time":0,"value":1e999})"), "not a JSON object");
}

}  // namespace
}  // namespace thermotwin::twin
