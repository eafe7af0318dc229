#include "twin/file/distinct_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

using testing::ElementsAre;

TEST(DistinctNames, HaveAsManyFoldersAsTellThemApart) {
  EXPECT_THAT(distinct_names({"a/run.h5", "a/other.h5"}), ElementsAre("run.h5", "other.h5"));
  EXPECT_THAT(distinct_names({"x/a/run.h5", "x/b/run.h5", "x/b/other.h5"}),
              ElementsAre("a/run.h5", "b/run.h5", "other.h5"));
  EXPECT_THAT(distinct_names({"/x/a/run.h5", "/y/a/run.h5", "/y/b/run.h5"}),
              ElementsAre("x/a/run.h5", "y/a/run.h5", "b/run.h5"));
  EXPECT_THAT(distinct_names({"run.h5", "b/run.h5"}), ElementsAre("run.h5", "b/run.h5"));
  EXPECT_THAT(distinct_names({"a/run.h5", "a/run.h5"}), ElementsAre("run.h5", "run.h5"));
}

TEST(DistinctNames, OfRunsAreThoseOfTheirFilesWithoutSuffix) {
  EXPECT_EQ(name_of_run("a/run.h5"), "a/run");
  EXPECT_EQ(name_of_run("a.b/day.2.csv"), "a.b/day.2");
  EXPECT_EQ(name_of_run("a.b/run"), "a.b/run");
}

}  // namespace
}  // namespace thermotwin::twin
