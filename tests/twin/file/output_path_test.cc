#include "twin/file/output_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using thermotwin::tests::refusal;
using thermotwin::tests::TemporaryDirectory;

TEST(OutputPath, IsInAFolderThatIsThere) {
  TemporaryDirectory const directory;
  auto const said = [](std::filesystem::path const& output) {
    return refusal([&] { refuse_to_overwrite(output, {}, {}); });
  };
  auto const lost = directory / "nodir/x.toml";
  EXPECT_THAT(said(lost), HasSubstr("cannot write '" + lost.string() + "': there is no folder '" +
                                    (directory / "nodir").string() + "'"));
  EXPECT_THAT(said(directory.path()), HasSubstr("it is a folder; a file is due"));
  EXPECT_EQ(said(directory / "x.toml"), "accepted");
  EXPECT_EQ(said("x.toml"), "accepted");
  EXPECT_EQ(said(""), "accepted");
}

TEST(OutputPath, TakesThePlaceOfATableOfItsKindOnly) {
  TemporaryDirectory const directory;
  auto const table = directory / "table.csv";
  auto const said = [&] {
    return refusal(
        [&] { refuse_to_replace_other_table(table, "table of play", [](auto const& line) { return line == "a,b"; }); });
  };
  EXPECT_EQ(said(), "accepted");
  for (std::string const own : {"", "a,b\n1,2\n"}) {
    thermotwin::tests::put(table, own);
    EXPECT_EQ(said(), "accepted") << own;
  }
  thermotwin::tests::put(table, "T1;T2\n1,5;2,5\n");
  EXPECT_EQ(said(), table.string() + ": is no table of play, whose place one does not take; name another output");
}

TEST(OutputPath, MayBeInAFolderThatTheCommandMakes) {
  auto const said = [](std::filesystem::path const& made) {
    return refusal([&] { refuse_to_overwrite("nodir/x.png", {}, {}, made); });
  };
  for (auto const* made : {"nodir", "nodir/", "./nodir", "nodir/fields"}) EXPECT_EQ(said(made), "accepted") << made;
  for (auto const* made : {"", "other", "nodir2"}) EXPECT_THAT(said(made), HasSubstr("there is no folder")) << made;
}

}  // namespace
}  // namespace thermotwin::twin
