#include "models/placement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>
#include <stdexcept>

#include "models/placement_bound.h"
#include "models/subsets.h"
#include "tests/models/random_placement.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Set = std::vector<Index>;

double by_definition(PlacementProblem const& problem, Set const& set) {
  Eigen::MatrixXd readings = problem.worlds[0].readings(set, set);
  readings.diagonal() += problem.noise(set);
  Eigen::MatrixXd const cross = problem.worlds[0].cross(set, Eigen::all);
  return problem.prior() - cross.cwiseProduct(readings.llt().solve(cross)).sum();
}

TEST(RemainingVariance, OfRankOneUpdatesIsThatOfTheDefinition) {
  auto const problem = random_placement(1, 20);
  Set set;
  for (Index const site : {3, 17, 0, 9, 12, 4}) {
    set.push_back(site);
    EXPECT_NEAR(remaining_variance(problem, set), by_definition(problem, set), 1e-9 * problem.prior());
  }
}

TEST(RemainingVariance, DropsByTheGainThatWasForetold) {
  auto const problem = random_placement(2, 15);
  RemainingVariance state(problem, 4);
  for (Index const site : {5, 1, 11, 8}) {
    double const foretold = state.value() - state.gains()[site];
    state.add(site);
    EXPECT_NEAR(state.value(), foretold, 1e-10 * problem.prior());
    EXPECT_EQ(state.gains()[site], -1.0);
  }
}

TEST(RemainingVariance, OfAnyOrderIsTheSame) {
  auto const problem = random_placement(3, 15);
  EXPECT_NEAR(remaining_variance(problem, Set{2, 9, 4, 13}), remaining_variance(problem, Set{13, 2, 4, 9}),
              1e-9 * problem.prior());
}

TEST(RemainingVariance, IsThePriorWithoutSensorsOrWithHopelessOnes) {
  auto problem = random_placement(4, 10);
  EXPECT_EQ(remaining_variance(problem, Set{}), problem.prior());
  problem.noise.setConstant(1e12);
  EXPECT_NEAR(remaining_variance(problem, Set{1, 2, 3}), problem.prior(), 1e-6 * problem.prior());
}

/// As many exact sensors as there are hidden modes leave only what the quantities have of their own.
TEST(RemainingVariance, OfExactSensorsIsWhatNoSensorSees) {
  auto const problem = random_placement(5, 20, 4, 3, 1e-10);
  EXPECT_NEAR(remaining_variance(problem, Set{0, 5, 10, 15}), 0.1, 1e-4);
}

TEST(ExhaustivePlacement, IsTheBestOfAllSets) {
  auto const problem = random_placement(7, 9);
  double best = problem.prior();
  Set set;
  for (unsigned bits = 0; bits < 512; ++bits) {
    set.clear();
    for (Index i = 0; i < 9; ++i)
      if (bits >> i & 1U) set.push_back(i);
    if (set.size() == 3) best = std::min(best, by_definition(problem, set));
  }
  EXPECT_NEAR(exhaustive_placement(problem, 3).variance, best, 1e-9 * problem.prior());
  EXPECT_EQ(number_of_sets(9, 3), 84.0);
}

/// All but two of 40: 780 sets, though there are 10¹² smaller ones.
TEST(ExhaustivePlacement, LooksAtNoSmallerSetsThanAreAskedFor) {
  auto const problem = random_placement(7, 40);
  Set every(40);
  std::iota(every.begin(), every.end(), Index(0));
  double best = problem.prior();
  for (Index a = 0; a < 40; ++a)
    for (Index b = a + 1; b < 40; ++b) {
      Set set = every;
      std::erase_if(set, [&](Index site) { return site == a || site == b; });
      best = std::min(best, by_definition(problem, set));
    }
  auto const found = exhaustive_placement(problem, 38);
  EXPECT_EQ(found.sensors.size(), 38U);
  EXPECT_NEAR(found.variance, best, 1e-9 * problem.prior());
}

TEST(Place, ReachesNinetyNinePercentOfTheOptimum) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    auto const problem = random_placement(seed, 24);
    for (Index const count : {1, 3, 5}) {
      double const best = exhaustive_placement(problem, count).variance;
      double const found = place(problem, count).variance;
      EXPECT_GE(found, best * (1.0 - 1e-9));
      EXPECT_LE(found, best / 0.99) << "seed " << seed << ", " << count << " sensors";
    }
  }
}

TEST(Place, KnowsLessWithFewerSensors) {
  auto const problem = random_placement(8, 40);
  double before = problem.prior();
  for (Index count = 1; count <= 8; ++count) {
    double const variance = place(problem, count).variance;
    EXPECT_LE(variance, before);
    before = variance;
  }
}

TEST(Place, DoesNotCareHowSitesAreNumbered) {
  auto const problem = random_placement(9, 30);
  Set order(30);
  std::iota(order.begin(), order.end(), 0);
  std::reverse(order.begin() + 3, order.end());
  PlacementProblem renumbered = problem;
  renumbered.worlds[0].readings = problem.worlds[0].readings(order, order);
  renumbered.worlds[0].cross = problem.worlds[0].cross(order, Eigen::all);
  Set sites;
  for (auto const site : place(renumbered, 5).sensors) sites.push_back(order[std::size_t(site)]);
  EXPECT_THAT(sites, testing::ElementsAreArray(place(problem, 5).sensors));
}

/// Of sites that show the same, the one with the least noise.
TEST(Place, PrefersTheBetterSensorOfTwoAtOnePlace) {
  auto problem = random_placement(10, 12);
  auto const best = place(problem, 1).sensors.front();
  Index const other = best == 0 ? 1 : 0;
  problem.worlds[0].readings.col(other) = problem.worlds[0].readings.col(best);
  problem.worlds[0].readings.row(other) = problem.worlds[0].readings.row(best);
  problem.worlds[0].readings(other, other) = problem.worlds[0].readings(best, best);
  problem.worlds[0].cross.row(other) = problem.worlds[0].cross.row(best);
  problem.noise[other] = 0.5 * problem.noise[best];
  EXPECT_EQ(place(problem, 1).sensors.front(), other);
}

TEST(Place, KeepsToTheBudget) {
  auto problem = random_placement(11, 16);
  problem.cost = Eigen::VectorXd::LinSpaced(16, 1.0, 4.0);
  problem.budget = 6.0;
  auto const chosen = place(problem, 4), best = exhaustive_placement(problem, 4);
  double cost = 0.0;
  for (auto const site : chosen.sensors) cost += problem.cost[site];
  EXPECT_LE(cost, 6.0);
  EXPECT_LE(chosen.variance, best.variance / 0.99);
  EXPECT_LE(placement_bound(problem, 4), best.variance);
}

TEST(Place, WithDeadSensorsIsRobust) {
  auto const problem = random_placement(12, 30);
  auto const plain = place(problem, 6), robust = place(problem, 6, 2);
  double const at_worst = worst_variance(problem, robust.sensors, 2);
  EXPECT_LE(at_worst, worst_variance(problem, plain.sensors, 2));
  EXPECT_GE(robust.variance, plain.variance * (1.0 - 1e-9));
  double worst = 0.0;
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = a + 1; b < 6; ++b) {
      Set rest;
      for (std::size_t i = 0; i < 6; ++i)
        if (i != a && i != b) rest.push_back(robust.sensors[i]);
      worst = std::max(worst, by_definition(problem, rest));
    }
  EXPECT_NEAR(at_worst, worst, 1e-9 * problem.prior());
}

/// 792 sets of 5 of 12 sites, of which any two may be dead: within 1 % of the least error of all.
TEST(Place, WithDeadSensorsReachesTheLeastOfAllSets) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    auto const problem = random_placement(seed, 12);
    double least = problem.prior();
    for_each_subset(12, 5, [&](Set const& set) { least = std::min(least, worst_variance(problem, set, 2)); });
    double const found = worst_variance(problem, place(problem, 5, 2).sensors, 2);
    EXPECT_GE(found, least * (1.0 - 1e-9));
    EXPECT_LE(std::sqrt(found), 1.01 * std::sqrt(least)) << "seed " << seed;
  }
}

TEST(Place, NamesSensorsByWhatTheyTell) {
  auto const problem = random_placement(13, 25);
  auto const chosen = place(problem, 5).sensors;
  double before = remaining_variance(problem, Set{chosen[0]});
  for (auto const site : chosen) EXPECT_GE(remaining_variance(problem, Set{site}), before - 1e-9);
}

TEST(Place, RefusesWhatCannotBe) {
  auto problem = random_placement(14, 5);
  EXPECT_THROW((void)place(problem, 0), std::invalid_argument);
  EXPECT_THROW((void)place(problem, 6), std::invalid_argument);
  EXPECT_THROW((void)place(problem, 2, 2), std::invalid_argument);
  problem.budget = 0.5;
  EXPECT_THROW((void)place(problem, 2), std::invalid_argument);
  problem.budget = 3.0;
  problem.noise[2] = 0.0;
  EXPECT_THROW((void)place(problem, 2), std::invalid_argument);
  problem.noise[2] = 1.0;
  problem.worlds.push_back(random_placement(14, 5, 12, 2).worlds[0]);
  EXPECT_THROW((void)place(problem, 2), std::invalid_argument);
  problem.worlds.clear();
  EXPECT_THROW((void)place(problem, 2), std::invalid_argument);
  problem.worlds = random_placement(14, 5).worlds;
  problem.noise.conservativeResize(4);
  EXPECT_THROW((void)place(problem, 2), std::invalid_argument);
}

/// Four worlds of the same sites: nobody knows which is the true one before the sensors are mounted.
PlacementProblem four_worlds(unsigned seed, Index sites) {
  auto problem = random_placement(seed, sites);
  for (unsigned other = 1; other < 4; ++other)
    problem.worlds.push_back(random_placement(seed + 100 * other, sites).worlds[0]);
  return problem;
}

PlacementProblem only(PlacementProblem problem, std::size_t world) {
  problem.worlds = {problem.worlds[world]};
  return problem;
}

TEST(Place, InSeveralWorldsMinimisesTheMean) {
  auto const problem = four_worlds(17, 20);
  Set const set = {2, 11, 5};
  double mean = 0.0;
  for (std::size_t w = 0; w < 4; ++w) mean += 0.25 * by_definition(only(problem, w), set);
  EXPECT_NEAR(remaining_variance(problem, set), mean, 1e-9 * problem.prior());
  for (Index const count : {2, 4}) {
    double const best = exhaustive_placement(problem, count).variance;
    EXPECT_LE(place(problem, count).variance, best / 0.99);
    EXPECT_LE(placement_bound(problem, count), best);
    EXPECT_LE(best, remaining_variance(problem, place(only(problem, 0), count).sensors) * (1.0 + 1e-9));
  }
}

/// The worlds' covariances taken together, as if nobody ever learnt which is the true one, leave more unknown.
TEST(RemainingVariance, IsLessWhereTheWorldWillBeKnown) {
  auto const known = four_worlds(18, 12);
  PlacementProblem unknown = only(known, 0);
  for (std::size_t w = 1; w < 4; ++w) {
    unknown.worlds[0].readings += known.worlds[w].readings;
    unknown.worlds[0].cross += known.worlds[w].cross;
    unknown.worlds[0].prior += known.worlds[w].prior;
  }
  unknown.worlds[0].readings /= 4.0;
  unknown.worlds[0].cross /= 4.0;
  unknown.worlds[0].prior /= 4.0;
  EXPECT_NEAR(unknown.prior(), known.prior(), 1e-9 * known.prior());
  for (Set const& set : {Set{3}, Set{1, 7}, Set{0, 4, 9, 11}})
    EXPECT_LT(remaining_variance(known, set), remaining_variance(unknown, set));
}

TEST(PlacementBound, IsNeverAboveTheOptimum) {
  for (unsigned seed = 0; seed < 20; ++seed)
    for (double const noise : {1e-4, 1e-2, 1.0, 100.0}) {
      auto const problem = random_placement(seed, 16, 10, 2, noise);
      for (Index const count : {1, 2, 4})
        EXPECT_LE(placement_bound(problem, count), exhaustive_placement(problem, count).variance * (1.0 + 1e-9))
            << "seed " << seed << ", noise " << noise << ", " << count << " sensors";
    }
}

TEST(PlacementBound, IsTheOptimumWhereSensorsSayLittleOrAllAreTaken) {
  auto const noisy = random_placement(15, 30, 12, 3, 1e5);
  EXPECT_NEAR(placement_bound(noisy, 4, 1e-9), place(noisy, 4).variance, 1e-4 * noisy.prior());
  auto const problem = random_placement(16, 8);
  EXPECT_NEAR(placement_bound(problem, 8), place(problem, 8).variance, 1e-6 * problem.prior());
}

}  // namespace
}  // namespace thermotwin::models
