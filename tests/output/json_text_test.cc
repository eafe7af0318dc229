#include "output/json_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace thermotwin::output {
namespace {

TEST(JsonText, NumbersAreWithoutTheLastBitsOfArithmeticAtAnyDepth) {
  nlohmann::ordered_json const report = {{"amplitude", 3 * 0.1},
                                         {"list", {{{"position_mm", 1e3 * 0.0201}}, 1.0 / 3.0}},
                                         {"count", 3},
                                         {"text", "0.30000000000000004"}};
  std::string const text = json_text(report);
  EXPECT_NE(text.find("\"amplitude\": 0.3,"), std::string::npos) << text;
  EXPECT_NE(text.find("\"position_mm\": 20.1"), std::string::npos) << text;
  auto const back = nlohmann::ordered_json::parse(text);
  EXPECT_EQ(back["list"][1], 1.0 / 3.0);
  EXPECT_TRUE(back["count"].is_number_integer());
  EXPECT_EQ(back["text"], "0.30000000000000004");
  EXPECT_EQ(text.back(), '\n');
}

}  // namespace
}  // namespace thermotwin::output
