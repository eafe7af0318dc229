#include "twin/diagnosis/finding.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <vector>

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
TEST(Finding, OfAWeakFilmHasOne) { EXPECT_FALSE(half_of("draught", "head_front").at_least); }

Explanation explanation_of(std::vector<std::tuple<std::string, std::string, double>> const& findings,
                           double too_large = 1.0) {
  Explanation explanation;
  for (auto const& [effect, place, strength] : findings) {
    Finding finding = half_of(effect, place);
    finding.strength = strength;
    explanation.add(finding, too_large);
  }
  explanation.keep_the_likely();
  return explanation;
}

constexpr double scatter_of_40 = 1.0 + 0.02 * 0.02 * 40.0;  // of 2 ln, for no signature is known to better than 2 %

/// 1 : e^-1 : e^-2.5 : e^-4, or nearly so, which are 0.68, 0.25, 0.06 and 0.01 of all; and 1 : e^-3, the latter 5.0 %
/// of both.
TEST(Explanation, HoldsWhatIsMissingWithNineteenOfTwenty) {
  auto const three = explanation_of({{"heat", "bed", 40.0},
                                     {"draught", "head_front", 38.0},
                                     {"fan_cooling", "head_front", 32.0},
                                     {"flood_coolant", "head_front", 35.0}})
                         .alternatives;
  ASSERT_EQ(three.size(), 3);
  double const sum = 1.0 + std::exp(-1.0 / scatter_of_40) + std::exp(-2.5 / scatter_of_40);
  EXPECT_NEAR(three[0].weight, 1.0 / sum, 1e-12);
  EXPECT_EQ(three[2].hypothesis.effect->name, "flood_coolant");
  EXPECT_NEAR(three[2].weight, std::exp(-2.5 / scatter_of_40) / sum, 1e-12);
  auto const one = explanation_of({{"heat", "bed", 40.0}, {"draught", "head_front", 34.0}}).alternatives;
  ASSERT_EQ(one.size(), 1);
  EXPECT_EQ(one[0].weight, 1.0);
}

/// Where every 2 ln is twice too large, 6 of them are 3: 1 : e^-1.5, of which one alone holds 82 %.
TEST(Explanation, KeepsMoreNamesWhereEvidenceIsTooLarge) {
  auto const told = explanation_of({{"heat", "bed", 40.0}, {"draught", "head_front", 34.0}}, 2.0).alternatives;
  ASSERT_EQ(told.size(), 2);
  EXPECT_NEAR(told[1].weight, 1.0 / (1.0 + std::exp(1.5 / scatter_of_40)), 1e-12);
}

/// 285 W in a motor, taken for copper loss by 6 of 1818: at 1 + 0.02² 1818 times the scatter of noise that is 1 :
/// e^-1.7, and of 40 it would have been one name.
TEST(Explanation, HoldsNamesApartNoBetterThanTheirSignaturesAreKnown) {
  auto const told = explanation_of({{"heat", "bed", 1818.0}, {"draught", "head_front", 1812.0}}).alternatives;
  ASSERT_EQ(told.size(), 2);
  EXPECT_NEAR(told[1].weight, 1.0 / (1.0 + std::exp(3.0 / 1.7272)), 1e-12);
}

/// A name is as likely as all its places together: here e^-1.5 (2 of 11) became 2 e^-1.5 (4 of 13).
TEST(Explanation, OfANameCountsAllItsPlaces) {
  auto const told =
      explanation_of({{"heat", "bed", 40.0}, {"draught", "bed", 37.0}, {"draught", "head_front", 37.0}}).alternatives;
  ASSERT_EQ(told.size(), 2);
  EXPECT_EQ(told[1].hypothesis.body, "bed");
  EXPECT_NEAR(told[1].weight, 2.0 / (2.0 + std::exp(1.5 / scatter_of_40)), 1e-12);
}

TEST(Finding, IsNegligibleBelowItsErrorAndWhereTheBestHaveAsMuch) {
  EXPECT_TRUE(half_of("heat", "bed", 0.05).is_negligible());  // ± 0.06
  EXPECT_FALSE(half_of("heat", "bed", 0.10).is_negligible());
  EXPECT_TRUE(half_of("sensor_drift", "T1", 0.10).is_negligible());
  EXPECT_FALSE(half_of("sensor_drift", "T1", 0.20).is_negligible());
  EXPECT_TRUE(half_of("sensor_contact", "T1", 0.20).is_negligible());  // 6 % ± 2 %: good ones read up to 5 %
  EXPECT_FALSE(half_of("sensor_contact", "T1", 0.50).is_negligible());
}

}  // namespace
}  // namespace thermotwin::twin
