#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/program.h"

namespace thermotwin::twin {
namespace {

struct Setting {
  std::string option, value, allowed;
};

/// Each would leave every sensor unbelieved, or end at once; none is met with the broker or the model.
TEST(CompensateCommand, RefusesTimesAndBoundsThatAreNone) {
  for (auto const& [option, value, allowed] : std::vector<Setting>{{"--stale", "-1 s", "above 0"},
                                                                   {"--stale", "0 s", "above 0"},
                                                                   {"--stuck", "0 s", "above 0"},
                                                                   {"--start", "-1 s", "above 0"},
                                                                   {"--start", "0 s", "above 0"},
                                                                   {"--jump", "-0.3 K", "of 0 or more"},
                                                                   {"--fastest", "-0.02 K/s", "of 0 or more"},
                                                                   {"--hold", "-1 min", "of 0 or more"},
                                                                   {"--fade", "-1 min", "of 0 or more"}})
    EXPECT_THAT(
        tests::answer(std::string(THERMOTWIN_PROGRAM) + " compensate --model none.toml " + option + " '" + value + "'",
                      2),
        testing::AllOf(testing::HasSubstr(option + " " + value + ": a "),
                       testing::HasSubstr(" " + allowed + " is due")));
}

}  // namespace
}  // namespace thermotwin::twin
