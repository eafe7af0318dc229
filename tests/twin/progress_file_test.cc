#include "twin/progress_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/error.h"
#include "tests/output/temporary_directory.h"

namespace thermotwin::twin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;
using thermotwin::tests::contents;
using thermotwin::tests::put;
using thermotwin::tests::TemporaryDirectory;

TEST(ProgressFile, TakesTheFolderOfAJobThatWasKilled) {
  TemporaryDirectory const folder;
  put(folder / "progress.json", R"({"title": "Diagnosis", "steps": [], "done": false})");
  put(folder / "progress.json.12-0.tmp", "{");
  {
    ProgressFile const again(folder.path(), "Diagnosis");
    EXPECT_THAT(folder.files(), ElementsAre("progress.json"));
  }
  EXPECT_THAT(folder.files(), IsEmpty());
}

TEST(ProgressFile, TakesNoFolderThatAnotherJobFillsOrThatHoldsMore) {
  TemporaryDirectory const folder;
  {
    ProgressFile const running(folder.path(), "Diagnosis");
    EXPECT_THAT([&] { ProgressFile(folder.path(), "Study"); },
                ThrowsMessage<output::OutputError>(HasSubstr("another process is filling")));
  }
  put(folder / "progress.json", "{}");
  put(folder / "diagnosis.json", "{}");
  EXPECT_THAT([&] { ProgressFile(folder.path(), "Diagnosis"); },
              ThrowsMessage<output::OutputError>(HasSubstr("is not empty")));
  EXPECT_EQ(folder.files().size(), 2U);
  EXPECT_THAT([&] { ProgressFile(folder / "diagnosis.json", "Diagnosis"); },
              ThrowsMessage<output::OutputError>(HasSubstr("is not empty")));
}

TEST(ProgressFile, SaysWhenTheUserStoppedTheJob) {
  TemporaryDirectory const folder;
  std::optional<ProgressFile> going(std::in_place, folder.path(), "Diagnosis");
  EXPECT_THROW(told_if_stopped(going, [] { throw Interrupted("stopped"); }), Interrupted);
  going.reset();
  auto const text = contents(folder / "progress.json");
  EXPECT_THAT(text, HasSubstr(R"("what":"stopped")"));
  EXPECT_THAT(text, HasSubstr(R"("done":true)"));
  { ProgressFile const again(folder.path(), "Diagnosis"); }
  EXPECT_THAT(folder.files(), IsEmpty());
}

/// A file name in Latin-1 is a title that no JSON can hold.
TEST(ProgressFile, NoTitleStopsTheWork) {
  TemporaryDirectory const folder;
  ProgressFile going(folder.path(), "Study d\xfcse");
  EXPECT_NO_THROW(going.show("running", 0.5));
}

}  // namespace
}  // namespace thermotwin::twin
