#include "models/distinguishing.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Set = std::vector<Index>;

/// Courses of m effects at n sites as a matrix per site, instants × effects.
Signatures random_signatures(unsigned seed, int sites, int effects) {
  std::mt19937_64 engine(seed);
  auto const even = [&] { return double(engine() >> 11) * 0x1p-53; };
  Signatures signatures;
  for (int i = 0; i < sites; ++i) {
    Eigen::MatrixXd const courses = Eigen::MatrixXd::NullaryExpr(3, effects, [&] { return even(); });
    signatures.gram.push_back(courses.transpose() * courses);
  }
  for (Index a = 0; a < effects; ++a)
    for (Index b = a + 1; b < effects; ++b) signatures.pairs.emplace_back(a, b);
  return signatures;
}

/// Effects that warm one site each are at right angles; those that warm the same two alike at 0, and 1:1 to 1:0 at 45°.
TEST(Distinguishing, KnowsTheAnglesOfPlainSignatures) {
  Signatures signatures;
  Eigen::MatrixXd const here = Eigen::RowVector3d(1, 0, 1), there = Eigen::RowVector3d(0, 2, 1);
  signatures.gram = {here.transpose() * here, there.transpose() * there};
  signatures.pairs = {{0, 1}, {0, 2}, {1, 2}};
  auto const both = angles(signatures, Set{0, 1});
  EXPECT_NEAR(both[0], std::numbers::pi / 2, 1e-9);
  EXPECT_NEAR(both[1], std::numbers::pi / 4, 1e-9);
  EXPECT_NEAR(both[2], std::numbers::pi / 4, 1e-9);
  EXPECT_NEAR(closest_pair(signatures, Set{0}).angle, 0.0, 1e-7);
}

/// And the exchanges come close to it.
TEST(Distinguishing, FindsTheWidestSmallestAngleOfAllSets) {
  int exact = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    auto const signatures = random_signatures(seed, 9, 6);
    double best = 0.0;
    for (Index a = 0; a < 9; ++a)
      for (Index b = a + 1; b < 9; ++b)
        for (Index c = b + 1; c < 9; ++c) best = std::max(best, closest_pair(signatures, Set{a, b, c}).angle);
    EXPECT_NEAR(closest_pair(signatures, widest_of_all_sets(signatures, 3)).angle, best, 1e-12) << "seed " << seed;
    double const found = closest_pair(signatures, place_to_distinguish(signatures, 3)).angle;
    EXPECT_LE(found, best * (1.0 + 1e-9));
    EXPECT_GE(found, 0.9 * best) << "seed " << seed;
    if (found > best * (1.0 - 1e-9)) ++exact;
  }
  EXPECT_GE(exact, 16);
}

TEST(Distinguishing, FindsTheWidestSmallestAngleThatTheBudgetBuys) {
  Prices prices;
  prices.cost = Eigen::VectorXd::NullaryExpr(9, [](Index i) { return 1.0 + double(i % 3); });
  prices.budget = 5.0;
  auto const cost = [&](Set const& set) {
    return std::accumulate(set.begin(), set.end(), 0.0, [&](double sum, Index i) { return sum + prices.cost_of(i); });
  };
  int exact = 0, dearer_without_budget = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    auto const signatures = random_signatures(seed, 9, 6);
    double best = 0.0;
    for (unsigned members = 1; members < 1U << 9U; ++members) {
      Set set;
      for (Index i = 0; i < 9; ++i)
        if ((members >> unsigned(i) & 1U) != 0) set.push_back(i);
      if (set.size() <= 3 && cost(set) <= prices.budget) best = std::max(best, closest_pair(signatures, set).angle);
    }
    auto const widest = widest_of_all_sets(signatures, 3, prices);
    EXPECT_LE(cost(widest), prices.budget) << "seed " << seed;
    EXPECT_NEAR(closest_pair(signatures, widest).angle, best, 1e-12) << "seed " << seed;
    auto const chosen = place_to_distinguish(signatures, 3, prices);
    double const found = closest_pair(signatures, chosen).angle;
    EXPECT_LE(cost(chosen), prices.budget) << "seed " << seed;
    EXPECT_GE(found, 0.9 * best) << "seed " << seed;
    if (found > best * (1.0 - 1e-9)) ++exact;
    if (cost(place_to_distinguish(signatures, 3)) > prices.budget) ++dearer_without_budget;
  }
  EXPECT_GE(exact, 16);
  EXPECT_GE(dearer_without_budget, 5);
}

TEST(Distinguishing, CountsTheSetsThatItLooksAt) {
  EXPECT_EQ(number_of_sets(9, 3, {}), 84.0);
  EXPECT_EQ(number_of_sets(9, 3, {{}, 2.0}), 84.0 + 36.0 + 9.0);
  EXPECT_GT(number_of_sets(200, 8, {}), 1e13);
}

TEST(Distinguishing, RefusesWhatCannotBe) {
  auto signatures = random_signatures(1, 4, 3);
  EXPECT_THROW((void)place_to_distinguish(signatures, 5), std::invalid_argument);
  EXPECT_THROW((void)widest_of_all_sets(signatures, 5), std::invalid_argument);
  EXPECT_THROW((void)place_to_distinguish(signatures, 2, {{}, 0.5}), std::invalid_argument);
  signatures.pairs.clear();
  EXPECT_THROW((void)place_to_distinguish(signatures, 2), std::invalid_argument);
  EXPECT_THROW((void)closest_pair(signatures, Set{0}), std::invalid_argument);
}

}  // namespace
}  // namespace thermotwin::models
