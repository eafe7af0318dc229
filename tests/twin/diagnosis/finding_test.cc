#include "twin/diagnosis/finding.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

/// Of v450, as a fit says that half of its largest size is there, or so much, known to a twentieth of that size.
Finding half_of(std::string const& effect, std::string const& body, double of_largest = 0.5) {
  Value const document = read_toml(machine_file("v450"));
  Machine const machine = Machine::build(document);
  auto const all = hypotheses(document, machine);
  auto const one =
      std::find_if(all.begin(), all.end(), [&](auto const& h) { return h.effect->name == effect && h.body == body; });
  Finding finding{.hypothesis = *one};
  finding.take(of_largest, 0.05, machine.geometry);
  return finding;
}

TEST(Finding, HasAnInterval) {
  Finding const heat = half_of("heat", "bed");
  EXPECT_FALSE(heat.at_least);
  EXPECT_DOUBLE_EQ(heat.amplitude, 150.0);
  double const half = 1.96 * std::hypot(1.2 * 0.05, 0.1 * 0.5) * 300.0;
  EXPECT_NEAR(heat.low(), 150.0 - half, 1e-9);
  EXPECT_NEAR(heat.high(), 150.0 + half, 1e-9);
  EXPECT_EQ(heat.interval_text("W"), "± 46 W");
}

TEST(Finding, SaysWhereItStandsAtTheEndOfWhatIsPlausible) {
  EXPECT_EQ(half_of("heat", "bed", -1.25).interval_text("W"), "± 82 W, as much as is plausible here");
}

/// 1 kW/(m² K) on 300 mm of iron: a film that is as strong as what lies behind it.
TEST(Finding, OfAFilmThatALumpCannotShowHasNoUpperEnd) {
  Finding const flood = half_of("flood_coolant", "head_front");
  EXPECT_TRUE(flood.at_least);
  EXPECT_LT(flood.low(), 1000.0);
  EXPECT_DOUBLE_EQ(flood.high(), 2500.0);
  EXPECT_EQ(flood.interval_text("W/(m2 K)"), "or more, at least 690 W/(m2 K)");
}

/// 12 W/(m² K): of the room's size, to which a lump is one temperature.
/// 1 : e^-1 : e^-2.5 : e^-4, which are 0.68, 0.25, 0.06 and 0.01 of all.
TEST(Explanation, HoldsWhatIsMissingWithThirtyNineOfForty) {
  Explanation explanation;
  for (double const strength : {40.0, 38.0, 35.0, 32.0}) {
    explanation.alternatives.push_back(half_of("heat", "bed"));
    explanation.alternatives.back().strength = strength;
  }
  explanation.weigh();
  ASSERT_EQ(explanation.alternatives.size(), 3);
  double const sum = 1.0 + std::exp(-1.0) + std::exp(-2.5);
  EXPECT_NEAR(explanation.alternatives[0].weight, 1.0 / sum, 1e-12);
  EXPECT_NEAR(explanation.alternatives[2].weight, std::exp(-2.5) / sum, 1e-12);
  explanation.alternatives = {explanation.alternatives[0], explanation.alternatives[2]};
  explanation.alternatives[1].strength = 32.5;  // 2.3 %
  explanation.weigh();
  ASSERT_EQ(explanation.alternatives.size(), 1);
  EXPECT_EQ(explanation.alternatives[0].weight, 1.0);
}

TEST(Finding, OfAWeakFilmHasOne) { EXPECT_FALSE(half_of("draught", "head_front").at_least); }

}  // namespace
}  // namespace thermotwin::twin
