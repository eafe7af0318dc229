#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/program.h"

/// `thermotwin place` as its users meet it: what is asked for wrongly is told before any machine is drawn.
namespace thermotwin {
namespace {

using testing::HasSubstr;

std::string refused(std::string const& arguments) {
  return tests::answer(fmt::format("{} place v450 -k 2 {}", THERMOTWIN_PROGRAM, arguments), 2);
}

TEST(PlaceCommand, TakesEverySpectrumOnce) {
  EXPECT_THAT(refused("--trained --experiments golden_b_4000 golden_b_4000"),
              HasSubstr("--experiments: 'golden_b_4000' is given twice"));
  EXPECT_THAT(refused("--hold-out golden_b_2000 golden_b_4000 golden_b_2000"),
              HasSubstr("--hold-out: 'golden_b_2000' is given twice"));
}

TEST(PlaceCommand, SaysWhichSpectrumTheMachineCannotBePutThrough) {
  EXPECT_THAT(refused("--experiments golden_b_4000 feed_8000"), HasSubstr("thermotwin: 'feed_8000': "));
  EXPECT_THAT(refused("--hold-out feed_8000"), HasSubstr("the laser measures axis 'z'"));
}

TEST(PlaceCommand, TakesNoGapForAProposal) {
  for (auto const* gap : {"T1,,T2", "T1,", ",T1"})
    EXPECT_THAT(refused(fmt::format("--propose {}", gap)),
                HasSubstr(fmt::format("--propose '{}': names with commas between them are due", gap)));
}

}  // namespace
}  // namespace thermotwin
