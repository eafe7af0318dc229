#include "models/selection_score.h"

#include <gtest/gtest.h>

#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

Eigen::VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<Eigen::VectorXd const>(values.begin(), Eigen::Index(values.size()));
}

/// By hand: ranks 1 2 3 4 5 against 2 1 4 3 5: 1 − 6·4/(5·24) = 0.8.
TEST(RankCorrelation, IsSpearmans) {
  EXPECT_NEAR(rank_correlation(vector({1, 2, 3, 4, 5}), vector({2, 1, 4, 3, 5})), 0.8, 1e-12);
  EXPECT_NEAR(rank_correlation(vector({1, 20, 300}), vector({-3, -2, 7})), 1, 1e-12);
  EXPECT_NEAR(rank_correlation(vector({1, 20, 300}), vector({3, 2, 1})), -1, 1e-12);
}

/// Ranks 1.5 1.5 3 against 1 2 3: √3/2.
TEST(RankCorrelation, SharesTheRanksOfEqualValues) {
  EXPECT_NEAR(rank_correlation(vector({5, 5, 1}), vector({9, 8, 7})), std::sqrt(3.0) / 2, 1e-12);
  EXPECT_EQ(rank_correlation(vector({5, 5, 5}), vector({9, 8, 7})), 0);
}

TEST(SelectionScore, CountsTheInformativePointsThatWereFound) {
  Selection const selection{{4, 0, 2}, vector({3, 0, 2, 0, 5}), ""};
  auto const result = score(selection, vector({1, 4, 0, 2, 9}));  // the best three: 5th, 2nd, 4th
  EXPECT_EQ(result.informative, 3);
  EXPECT_EQ(result.found, 1);
  EXPECT_EQ(score(selection, vector({1, 4, 0, 0, 9})).found, 2);
}

TEST(SelectionScore, CountsEqualPointsTogetherAndUselessOnesNever) {
  Selection const selection{{0, 3}, vector({2, 1, 0, 1}), ""};
  EXPECT_EQ(score(selection, vector({5, 3, 3, 3})).informative, 4);
  EXPECT_EQ(score(selection, vector({5, 3, 3, 3})).found, 2);
  EXPECT_EQ(score(selection, vector({5, 0, 0, 0})).informative, 1);
  EXPECT_EQ(score(selection, vector({0, 5, 0, 0})).found, 0);
}

TEST(SelectionScore, RefusesATruthThatDoesNotFit) {
  Selection const selection{{0}, vector({2, 1}), ""};
  EXPECT_THROW((void)score(selection, vector({1, 2, 3})), std::invalid_argument);
  EXPECT_THROW((void)score(selection, vector({1, std::nan("")})), std::invalid_argument);
}

TEST(Regret, IsZeroForTheOptimumAndNeverNegative) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    auto const data = random_walks(seed, 60, 6);
    SubsetValidation const validation({&data, 1});
    auto const optimum = best_subset(validation, 2);
    EXPECT_EQ(regret({optimum.sensors, optimum.margin, ""}, validation, optimum), 0);
    EXPECT_GT(regret({{0, 2}, optimum.margin, ""}, validation, optimum), 0);
    EXPECT_THROW((void)regret({{0}, optimum.margin, ""}, validation, optimum), std::invalid_argument);
  }
}

}  // namespace
}  // namespace thermotwin::models
