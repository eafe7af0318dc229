#include "twin/file/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "twin/file/value.h"

namespace thermotwin::twin {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using thermotwin::tests::refusal;
using thermotwin::tests::TemporaryDirectory;

TEST(TextFile, SaysWhyItCannotBeHad) {
  TemporaryDirectory const directory;
  EXPECT_THAT(refusal([&] { (void)text_of_file(directory / "none"); }), EndsWith("none: there is no such file"));
  EXPECT_THAT(refusal([&] { (void)text_of_file(directory.path()); }), EndsWith(": is a folder; a file is due"));
}

TEST(TextFile, IsTomlWithSomethingInIt) {
  TemporaryDirectory const directory;
  thermotwin::tests::put(directory / "empty.toml", "");
  thermotwin::tests::put(directory / "run.h5", "\x89HDF\r\n\x1a\n and more");
  EXPECT_EQ(text_of_file(directory / "empty.toml"), "");
  EXPECT_THAT(refusal([&] { (void)read_toml(directory / "empty.toml"); }), EndsWith("empty.toml: the file is empty"));
  EXPECT_THAT(refusal([&] { (void)read_toml(directory / "run.h5"); }), HasSubstr("run.h5: is a data set (HDF5)"));
  for (std::string const mark : {"\xFF\xFE", "\xFE\xFF"}) {
    thermotwin::tests::put(directory / "wide.toml", mark + "name = \"v450\"\n");
    EXPECT_THAT(refusal([&] { (void)read_toml(directory / "wide.toml"); }),
                EndsWith("wide.toml: is written in UTF-16; UTF-8 is due"));
  }
}

}  // namespace
}  // namespace thermotwin::twin
