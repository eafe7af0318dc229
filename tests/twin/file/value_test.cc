#include "twin/file/value.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenarios/refusal.h"

namespace thermotwin::twin {
namespace {

using thermotwin::tests::refusal;

/// Messages call the first block "blocks[0]"; a parameter's path has it as "blocks.0".
TEST(Value, OffersThePathOfATableWithoutName) {
  auto const said = [](std::string const& path) {
    Value document = parse_toml("[spindle]\nblocks = [{ duration = \"1 h\" }]\n", "day.toml");
    return refusal([&] { set_parameter(document, path, "900 rpm", "experiment."); });
  };
  EXPECT_EQ(said("spindle.blocks.0.speed"), "accepted");
  EXPECT_EQ(said("spindle.blocks[0].speed"),
            "parameter 'experiment.spindle.blocks[0].speed': there is no 'blocks[0]'; did you mean "
            "'experiment.spindle.blocks.0.speed'?");
  EXPECT_EQ(said("spindle.block[0].speed"),
            "parameter 'experiment.spindle.block[0].speed': there is no 'block[0]'; known: 'blocks'");
}

TEST(Value, IsReadFromUtf8Alone) {
  EXPECT_THAT(refusal([] { static_cast<void>(parse_toml("name = \"Fr\xe4se\"\n", "a/mine.toml")); }),
              testing::MatchesRegex("a/mine.toml:1:[0-9]+: is not written in UTF-8; convert the file, from Latin-1 for "
                                    "example: iconv -f latin1 -t utf8 mine.toml > utf8.toml"));
}

TEST(Value, ATextNeedsStraightQuotes) {
  for (std::string const text : {"T3", "front", "\u201cT3\u201d"})
    EXPECT_THAT(
        refusal([&] { static_cast<void>(parse_toml("name = " + text + "\n", "mine.toml")); }),
        testing::MatchesRegex("mine.toml:1:[0-9]+: .*; a text needs straight quotes, for example \"bed\"; a flag "
                              "is true or false"));
}

}  // namespace
}  // namespace thermotwin::twin
