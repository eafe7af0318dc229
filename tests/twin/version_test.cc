#include "twin/version.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

namespace thermotwin::twin {
namespace {

TEST(Version, IsThreeNumbersAndACommit) {
  EXPECT_THAT(std::string(version()), testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(std::string(commit()), testing::MatchesRegex("unknown|.*[0-9a-f]{7,}(-dirty)?|v[0-9.]+(-dirty)?"));
}

}  // namespace
}  // namespace thermotwin::twin
