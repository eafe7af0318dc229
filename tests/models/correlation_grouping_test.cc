#include "models/correlation_grouping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using testing::ElementsAre;

/// Worked by hand: {1,2} at 2, {3,4} at 3, then (4 + 6 + 5 + 7)/4.
TEST(AverageLinkage, JoinsAsByHand) {
  Eigen::MatrixXd distance(4, 4);
  distance << 0, 2, 4, 6, 2, 0, 5, 7, 4, 5, 0, 3, 6, 7, 3, 0;
  auto const merges = average_linkage(distance);
  ASSERT_EQ(merges.size(), 3U);
  EXPECT_EQ(merges[0].first, 0);
  EXPECT_EQ(merges[0].second, 1);
  EXPECT_DOUBLE_EQ(merges[0].distance, 2);
  EXPECT_EQ(merges[1].first, 2);
  EXPECT_DOUBLE_EQ(merges[1].distance, 3);
  EXPECT_DOUBLE_EQ(merges[2].distance, 5.5);
  EXPECT_THAT(groups_of(merges, 2), ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(groups_of(merges, 3), ElementsAre(0, 0, 1, 2));
  EXPECT_THAT(groups_of(merges, 4), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(groups_of(merges, 1), ElementsAre(0, 0, 0, 0));
}

/// The distance of every merge is the mean over all pairs between the two groups.
TEST(AverageLinkage, JoinsAtMeansOverAllPairs) {
  std::mt19937_64 generator(7);
  Eigen::MatrixXd distance = Eigen::MatrixXd::Zero(12, 12);
  for (Eigen::Index i = 0; i < 12; ++i)
    for (Eigen::Index j = 0; j < i; ++j) distance(i, j) = distance(j, i) = uniform(generator);
  auto const merges = average_linkage(distance);
  for (std::size_t m = 0; m < merges.size(); ++m) {
    auto const groups = groups_of(merges, Eigen::Index(12 - m));
    double sum = 0;
    int pairs = 0;
    for (std::size_t i = 0; i < 12; ++i)
      for (std::size_t j = 0; j < 12; ++j)
        if (groups[i] == groups[std::size_t(merges[m].first)] && groups[j] == groups[std::size_t(merges[m].second)]) {
          sum += distance(Eigen::Index(i), Eigen::Index(j));
          ++pairs;
        }
    EXPECT_NEAR(merges[m].distance, sum / pairs, 1e-12);
    EXPECT_GE(merges[m].distance, m > 0 ? merges[m - 1].distance : 0.0);
  }
}

/// Two families of sensors; the error is one member of the one, and a little of the other.
TEST(CorrelationGrouping, TakesFromEachGroupWhatFollowsTheError) {
  std::mt19937_64 generator(11);
  auto const walks = random_walks(5, 400, 2).temperature_rise;
  Eigen::MatrixXd rise(400, 6);
  for (Eigen::Index j = 0; j < 6; ++j)
    for (Eigen::Index t = 0; t < 400; ++t) rise(t, j) = walks(t, j % 2) * (j == 3 ? -2 : 1) + 0.05 * normal(generator);
  auto const data = batch_of(rise, rise.col(4) + 0.5 * rise.col(3));
  SelectionOptions options;
  options.count = 2;
  EXPECT_THAT(select_by_correlation({{data}}, options).sensors, testing::UnorderedElementsAre(4, 3));
  auto const free = select_by_correlation({{data}}, {});
  EXPECT_THAT(free.sensors, testing::UnorderedElementsAre(4, 3));
  EXPECT_THAT(free.remark, testing::HasSubstr("2 groups"));
}

}  // namespace
}  // namespace thermotwin::models
