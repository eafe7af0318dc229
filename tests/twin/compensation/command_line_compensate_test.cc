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
  for (auto const& [option, value, allowed] : std::vector<Setting>{{"--stale", "-1 s", "positive"},
                                                                   {"--stale", "0 s", "positive"},
                                                                   {"--stuck", "0 s", "positive"},
                                                                   {"--start", "-1 s", "positive"},
                                                                   {"--start", "0 s", "positive"},
                                                                   {"--jump", "-0.3 K", "0 or more"},
                                                                   {"--fastest", "-0.02 K/s", "0 or more"},
                                                                   {"--hold", "-1 min", "0 or more"},
                                                                   {"--fade", "-1 min", "0 or more"}})
    EXPECT_THAT(
        tests::answer(std::string(THERMOTWIN_PROGRAM) + " compensate --model none.toml " + option + " '" + value + "'",
                      2),
        testing::HasSubstr(option + " '" + value + "': it must be " + allowed));
}

}  // namespace
}  // namespace thermotwin::twin
