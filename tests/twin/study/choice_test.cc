#include "twin/study/choice.h"

#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

TEST(StudySwitches, CountChangesFromOneSetToTheNext) {
  std::vector<Choice> choices(4);
  choices[0].columns = choices[1].columns = {0, 2};
  choices[2].columns = {1, 2};
  choices[3].columns = {0, 2};
  EXPECT_NEAR(*switch_share({&choices[0], &choices[1], &choices[2], &choices[3]}), 2.0 / 3.0, 1e-12);
  EXPECT_FALSE(switch_share({&choices[0]}));
}

}  // namespace
}  // namespace thermotwin::twin
