#include "twin/study/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/twin/study/small_study.h"
#include "twin/study/study_page.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;

TEST(Study, ClaimsAreDecidedByIntervals) {
  std::string const claims = R"(
[[claim]]
says = "two sensors fit no better than three"
combination = "all + linear"
than = "forward 2 + linear"
figure = "S"
[[claim]]
says = "nobody errs by more than a metre"
combination = "all + linear"
at_most = 1e6
[[claim]]
says = "nobody errs"
combination = "all + linear"
at_most = 0
[[claim]]
says = "there is such a figure"
combination = "all + linear"
figure = "verification.Mn"
at_most = 1
[[claim]]
says = "it is better than itself"
combination = "all + linear"
than = "all + linear"
[[claim]]
says = "it is no worse than itself"
combination = "all + linear"
than = "all + linear"
tolerance = 0
[[claim]]
says = "it is better than itself by three quarters"
combination = "all + linear"
than = "all + linear"
improvement = 75
)";
  auto const report = SmallStudy(head + world + claims).report();
  EXPECT_EQ(report.claims.at(1).answer, ClaimVerdict::Answer::holds);
  EXPECT_EQ(report.claims.at(2).answer, ClaimVerdict::Answer::fails);
  EXPECT_EQ(report.claims.at(3).answer, ClaimVerdict::Answer::refused);
  EXPECT_EQ(report.claims.at(4).answer, ClaimVerdict::Answer::fails);
  EXPECT_EQ(report.claims.at(5).answer, ClaimVerdict::Answer::holds);
  EXPECT_EQ(report.claims.at(6).answer, ClaimVerdict::Answer::fails);
  EXPECT_THAT(study_text(report), HasSubstr("  v450: \"nobody errs\" does not hold: cross.rmse of all + linear: "));
}

/// Errors of an own method and of two of the papers' (a method of theirs on sensors that one of theirs chose), in three
/// repetitions of two worlds, whose mean is the last three rows.
StudyReport of_two_worlds() {
  StudyReport report;
  report.description.worlds.resize(2);
  report.description.worlds[0].name = "lathe";
  report.description.worlds[1].name = "mill";
  report.units = {"um", "um"};
  auto const add = [](std::vector<Combination>& rows, std::string const& world, double scale) {
    auto const times = [&](double a, double b, double c) { return std::vector{scale * a, scale * b, scale * c}; };
    rows.push_back(
        {world, "all", "ridge", {{"cross.rmse", times(1, 2, 3)}, {"validation.rmse", times(3, 3, 3)}}, {}, {}, {}});
    rows.push_back({world,
                    "grey_fuzzy",
                    "linear",
                    {{"cross.rmse", times(2, 4, 6)}, {"validation.rmse", times(2, 2, 2)}},
                    {},
                    {},
                    {}});
    rows.push_back({world,
                    "grey_relational",
                    "linear",
                    {{"cross.rmse", times(5, 5, 5)}, {"validation.rmse", times(4, 4, 4)}},
                    {},
                    {},
                    {}});
  };
  add(report.rows, "lathe", 1.0);
  add(report.rows, "mill", 3.0);
  add(report.means, "mean of worlds", 2.0);
  return report;
}

/// 2, 1 and 9 against 1, 2 and 3: the line that names the means 4 and 2 gives their ratio, and not the mean 1.83 of the
/// repetitions' ratios; a claim goes by the same. Half-width: 4.303 √7/√3/2, a − 2 b being 0, −3 and 3.
TEST(StudyVerdict, GivesTheRatioOfTheMeansThatItNames) {
  StudyReport report;
  report.description.worlds.resize(1);
  report.units = {"um"};
  report.rows = {{"", "all", "ridge", {{"cross.rmse", {1.0, 2.0, 3.0}}}, {}, {}, {}},
                 {"", "grey_fuzzy", "linear", {{"cross.rmse", {2.0, 1.0, 9.0}}}, {}, {}, {}}};
  StudyClaim claim;
  claim.combination = "grey_fuzzy + linear";
  claim.than = "all + ridge";
  claim.share = 1.9;
  report.description.claims.push_back(claim);
  put_verdict(report);
  EXPECT_THAT(report.claims.front().words, HasSubstr("; 2.000 ± 3.726 of it, against 1.9"));
  EXPECT_THAT(report.verdict,
              testing::Contains(HasSubstr("grey_fuzzy + linear, 4.000 ± 10.828 um; the ratio to it is 0.500 ± ")));
}

StudyClaim share_of_papers(double share, std::string const& combination, std::string const& world) {
  StudyClaim claim;
  claim.combination = combination;
  claim.than = best_of_papers;
  claim.share = share;
  claim.world = world;
  return claim;
}

/// Of what a selection is worth, too; a figure that is not there has a nearest name.
TEST(StudyVerdict, JudgesAnyColumnOfTheTable) {
  auto report = of_two_worlds();
  report.selections.push_back({"mill", "grey_fuzzy", {{"regret", {0.2, 0.3, 0.4}}}, ""});
  StudyClaim claim;
  claim.combination = "grey_fuzzy + linear";
  claim.world = "mill";
  claim.at_most = 1.0;
  for (auto const* figure : {"selection.regret", "cros.rmse"}) {
    claim.figure = figure;
    report.description.claims.push_back(claim);
  }
  put_verdict(report);
  EXPECT_EQ(report.claims.at(0).answer, ClaimVerdict::Answer::holds);
  EXPECT_EQ(report.claims.at(0).world, "mill");
  EXPECT_EQ(report.claims.at(1).answer, ClaimVerdict::Answer::refused);
  EXPECT_EQ(report.claims.at(1).words,
            "there is no 'cros.rmse' of these combinations in 'mill'; did you mean 'cross.rmse'?");
}

/// Exactly half of the best paper method's in each repetition, though repetitions differ by three.
TEST(StudyVerdict, ComparesWithAShareOfTheBestOfThePapers) {
  using enum ClaimVerdict::Answer;
  auto report = of_two_worlds();
  for (double const share : {0.5, 0.49, 0.6})
    report.description.claims.push_back(share_of_papers(share, "all + ridge", "mean of worlds"));
  report.description.claims.push_back(share_of_papers(1.0, "chosen by cross-validation", "mill"));
  report.description.claims.push_back(share_of_papers(0.5, "grey_relational + linear", ""));
  put_verdict(report);
  EXPECT_EQ(report.claims.at(0).answer, holds);
  EXPECT_EQ(report.claims.at(1).answer, fails);
  EXPECT_EQ(report.claims.at(2).answer, holds);
  EXPECT_THAT(report.claims.at(0).words,
              HasSubstr("cross.rmse of all + ridge: 4.000 ± 4.968, of grey_fuzzy + linear (best of papers): 8.000 ± "
                        "9.937; 0.500 ± 0.000 of it, against 0.5"));
  EXPECT_THAT(report.claims.at(3).words, HasSubstr("cross.rmse of grey_fuzzy + linear: 12.000"));
  EXPECT_EQ(report.claims.at(3).answer, holds);
  EXPECT_EQ(report.claims.at(4).answer, undecided);  // 2.5, 1.25 and 0.83 of it
}

TEST(StudyVerdict, SaysWhereAClaimHasNothingToCompare) {
  auto report = of_two_worlds();
  std::erase_if(report.rows, [](auto const& row) { return row.selection != "all"; });
  report.rows.front().refused = "no reason";
  report.description.claims = {share_of_papers(0.5, "all + ridge", "mill"),
                               share_of_papers(0.5, "all + ridge", "lathe")};
  put_verdict(report);
  for (auto const& claim : report.claims) {
    EXPECT_EQ(claim.answer, ClaimVerdict::Answer::refused);
    EXPECT_THAT(claim.words, HasSubstr("there is no 'cross.rmse' of these combinations in '"));
  }
}

/// R², of which more is better, even where it is below zero.
TEST(StudyVerdict, KnowsOfWhichFiguresMoreIsBetter) {
  using enum ClaimVerdict::Answer;
  StudyReport report;
  report.description.worlds.resize(1);
  report.units = {"um"};
  auto const add = [&](std::string const& selection, double r_squared) {
    report.rows.push_back({"", selection, "linear", {{"cross.r_squared", {r_squared, r_squared}}}, {}, {}, {}});
  };
  add("all", 0.5);
  add("grey_fuzzy", 0.9);
  add("grey_relational", -1.0);
  auto const claim = [&](std::string const& combination, std::string const& than) -> StudyClaim& {
    auto& made = report.description.claims.emplace_back();
    made.figure = "cross.r_squared";
    made.combination = combination + " + linear";
    made.than = than == best_of_papers ? than : than + " + linear";
    return made;
  };
  claim("all", "grey_fuzzy");
  claim("grey_fuzzy", "all");
  claim("grey_fuzzy", "all").improvement = 90.0;
  claim("all", "grey_fuzzy").tolerance = 50.0;
  claim("grey_relational", "all");
  claim("all", "grey_relational").improvement = 140.0;
  claim("all", std::string(best_of_papers));
  put_verdict(report);
  std::vector<ClaimVerdict::Answer> answers;
  for (auto const& one : report.claims) answers.push_back(one.answer);
  EXPECT_THAT(answers, testing::ElementsAre(fails, holds, fails, holds, fails, holds, fails));
  EXPECT_THAT(report.claims.at(1).words, HasSubstr("of all + linear: 0.500 ± 0.000; 80.0 ± 0.0 % more"));
  EXPECT_THAT(report.claims.at(3).words, testing::EndsWith("-44.4 ± 0.0 % more, against 50 % less at most"));
  EXPECT_THAT(report.claims.at(6).words, HasSubstr("of grey_fuzzy + linear (best of papers): 0.900"));
}

/// One value has no interval: the sign decides, and the words say so.
TEST(StudyVerdict, SaysWhereThereIsButOneRepetition) {
  StudyReport report;
  report.description.worlds.resize(1);
  report.units = {"um"};
  report.rows = {{"", "all", "linear", {{"cross.rmse", {1.0}}, {"self.rmse", {1.0, 1.1}}}, {}, {}, {}}};
  StudyClaim claim;
  claim.combination = "all + linear";
  claim.at_most = 2.0;
  report.description.claims.push_back(claim);
  claim.figure = "self.rmse";
  report.description.claims.push_back(claim);
  put_verdict(report);
  EXPECT_EQ(report.claims.at(0).answer, ClaimVerdict::Answer::holds);
  EXPECT_THAT(report.claims.at(0).words, testing::EndsWith("1.000, against 2 (one repetition, no interval)"));
  EXPECT_THAT(report.claims.at(1).words, testing::Not(HasSubstr("no interval")));
}

/// Half a micrometre less in each repetition, though repetitions differ by eight.
TEST(StudyVerdict, ComparesCombinationsInTheSameRepetition) {
  StudyReport report;
  report.description.worlds.resize(1);
  report.units = {"um"};
  report.rows = {{"", "all", "linear", {{"cross.rmse", {1.0, 5.0, 9.0}}}, {}, {}, {}},
                 {"", "all", "ridge", {{"cross.rmse", {1.5, 5.5, 9.5}}}, {}, {}, {}}};
  StudyClaim claim;
  claim.combination = "all + linear";
  claim.than = "all + ridge";
  report.description.claims.push_back(claim);
  claim.improvement = 20.0;
  report.description.claims.push_back(claim);
  claim.improvement = {};
  std::swap(claim.combination, claim.than);
  claim.tolerance = 60.0;
  report.description.claims.push_back(claim);
  put_verdict(report);
  EXPECT_EQ(report.claims.at(0).answer, ClaimVerdict::Answer::holds);
  EXPECT_THAT(report.claims.at(0).words, HasSubstr("; 9.1 ± 0.0 % less"));
  EXPECT_EQ(report.claims.at(1).answer, ClaimVerdict::Answer::undecided);
  EXPECT_EQ(report.claims.at(2).answer, ClaimVerdict::Answer::undecided);
  EXPECT_THAT(report.claims.at(2).words, HasSubstr("-10.0 ± 0.0 % less, against 60 % more at most"));
}

}  // namespace
}  // namespace thermotwin::twin
