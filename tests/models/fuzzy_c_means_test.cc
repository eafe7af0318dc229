#include "models/fuzzy_c_means.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>

#include "models/shared_screen.h"
#include "models/time_characteristic.h"
#include "models/time_ranked_clusters.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

/// `clusters` heaps of five points in three dimensions, ten deviations apart at least.
Eigen::MatrixXd heaps(std::uint64_t seed, int clusters) {
  std::mt19937_64 generator(seed);
  Eigen::MatrixXd points(5 * clusters, 3);
  for (Eigen::Index k = 0; k < points.rows(); ++k) {
    auto const heap = double(k % clusters);
    points.row(k) << 10 * heap + normal(generator), 7 * heap * heap + normal(generator), normal(generator);
  }
  return points;
}

bool recovered(std::vector<Eigen::Index> const& labels, int clusters) {
  std::map<std::size_t, Eigen::Index> name;
  for (std::size_t k = 0; k < labels.size(); ++k)
    if (name.try_emplace(k % std::size_t(clusters), labels[k]).first->second != labels[k]) return false;
  std::vector<Eigen::Index> names;
  for (auto const& [heap, label] : name) names.push_back(label);
  std::sort(names.begin(), names.end());
  return std::unique(names.begin(), names.end()) == names.end();
}

TEST(FuzzyCMeans, NeverRaisesItsObjective) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    FuzzyOptions options;
    options.seed = seed;
    options.starts = 1;
    std::mt19937_64 generator(seed);
    Eigen::MatrixXd points(30, 4);
    for (auto& x : points.reshaped()) x = normal(generator);
    auto const descent = fuzzy_c_means(points, 4, options).descent;
    for (std::size_t i = 1; i < descent.size(); ++i) EXPECT_LE(descent[i], descent[i - 1] * (1 + 1e-12));
    EXPECT_LT(descent.back(), descent.front());
  }
}

TEST(FuzzyCMeans, SharesEveryPointOutWhole) {
  for (double exponent : {1.3, 2.0, 3.0}) {
    FuzzyOptions options;
    options.exponent = exponent;
    auto const membership = fuzzy_c_means(heaps(4, 3), 3, options).membership;
    EXPECT_LT((membership.colwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
    EXPECT_GE(membership.minCoeff(), 0);
  }
}

/// Centres are the weighted means of their points, memberships the inverse distances: both equations at once.
TEST(FuzzyCMeans, EndsWhereBothOfItsEquationsHold) {
  auto const points = heaps(6, 3);
  auto const clusters = fuzzy_c_means(points, 3);
  for (Eigen::Index i = 0; i < 3; ++i) {
    Eigen::RowVectorXd const weight = clusters.membership.row(i).array().square();
    EXPECT_LT((weight * points / weight.sum() - clusters.centres.row(i)).norm(), 1e-3);
    for (Eigen::Index k = 0; k < points.rows(); ++k) {
      double sum = 0;
      for (Eigen::Index j = 0; j < 3; ++j)
        sum += (points.row(k) - clusters.centres.row(i)).squaredNorm() /
               (points.row(k) - clusters.centres.row(j)).squaredNorm();
      EXPECT_NEAR(clusters.membership(i, k), 1 / sum, 1e-9);
    }
  }
}

TEST(FuzzyCMeans, RecoversPlantedClusters) {
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    int const planted = 2 + int(seed % 4);
    right += recovered(fuzzy_c_means(heaps(seed, planted), planted).labels(), planted);
  }
  EXPECT_GE(right, 190);
}

TEST(FuzzyCMeans, CountsPlantedClustersByXieAndBeni) {
  FuzzyOptions options;
  options.starts = 5;
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
    right += FuzzyPartitions(heaps(seed, 2 + int(seed % 3)), options).number() == 2 + int(seed % 3);
  EXPECT_GE(right, 57);
}

/// The best of ten starts does not depend on where they were.
TEST(FuzzyCMeans, IsStableOverItsStarts) {
  for (int planted : {3, 4, 5}) {
    FuzzyOptions options;
    options.starts = 10;
    auto const points = heaps(8, planted);
    double const reference = fuzzy_c_means(points, planted, options).objective();
    for (options.seed = 2; options.seed <= 50; ++options.seed)
      EXPECT_NEAR(fuzzy_c_means(points, planted, options).objective(), reference, 1e-4 * reference);
  }
}

TEST(FuzzyPartitions, FindEachNumberOfClustersOnce) {
  auto const points = heaps(2, 3);
  FuzzyPartitions partitions(points);
  auto const& three = partitions.clusters(3);
  EXPECT_EQ(three.membership, fuzzy_c_means(points, 3).membership);
  EXPECT_EQ(partitions.number(), 3);
  EXPECT_EQ(&partitions.clusters(3), &three);
  EXPECT_THROW((void)partitions.clusters(16), std::invalid_argument);
}

TEST(FuzzyCMeans, WithAsManyClustersAsPointsPutsEachInItsOwn) {
  auto const clusters = fuzzy_c_means(heaps(3, 3).topRows(4), 4);
  EXPECT_NEAR(clusters.objective(), 0, 1e-12);
  EXPECT_TRUE(recovered(clusters.labels(), 4));
}

TEST(FuzzyCMeans, OfOneClusterIsTheMean) {
  auto const points = heaps(3, 3);
  EXPECT_LT((fuzzy_c_means(points, 1).centres - points.colwise().mean()).norm(), 1e-12);
}

TEST(FuzzyCMeans, RefusesWhatItCannotDo) {
  auto const points = heaps(1, 2);
  EXPECT_THROW((void)fuzzy_c_means(points, 0), std::invalid_argument);
  EXPECT_THROW((void)fuzzy_c_means(points, 11), std::invalid_argument);
  FuzzyOptions options;
  options.exponent = 1;
  EXPECT_THROW((void)fuzzy_c_means(points, 2, options), std::invalid_argument);
  options = {};
  options.starts = 0;
  EXPECT_THROW((void)fuzzy_c_means(points, 2, options), std::invalid_argument);
  EXPECT_THROW((void)fuzzy_c_means(points * std::nan(""), 2), std::invalid_argument);
}

/// Three kinds of sensors: hot and fast, hot and slow, cool and fast; two or three of each.
Batch three_kinds(std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  Eigen::MatrixXd rise(240, 8);
  for (Eigen::Index j = 0; j < 8; ++j) {
    double const near = 1 + 0.05 * normal(generator);
    rise.col(j) = j % 3 == 0   ? warm_up(20 * near, 15, 240, 0.03, generator)
                  : j % 3 == 1 ? warm_up(20 * near, 120, 240, 0.03, generator)
                               : warm_up(4 * near, 15, 240, 0.03, generator);
  }
  return batch_of(rise, rise.col(0));
}

TEST(TimeRankedClusters, TakeOneOfEachKind) {
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SelectionOptions options;
    options.count = 3;
    options.seed = seed;
    std::vector<Eigen::Index> kinds;
    for (auto sensor : select_by_fuzzy_amplitude({{three_kinds(seed)}}, options).sensors) kinds.push_back(sensor % 3);
    std::sort(kinds.begin(), kinds.end());
    right += kinds == std::vector<Eigen::Index>{0, 1, 2};
  }
  EXPECT_GE(right, 38);
}

/// By shape, a cool fast sensor is like a hot fast one.
TEST(TimeRankedClusters, ByShapeTellFastFromSlow) {
  SelectionOptions options;
  options.count = 2;
  auto const chosen = select_by_fuzzy_shape({{three_kinds(1)}}, options).sensors;
  EXPECT_NE(chosen[0] % 3, 1);
  EXPECT_EQ(chosen[1] % 3, 1);
}

TEST(TimeRankedClusters, NeverLookAtTheError) {
  for (auto select : {select_by_fuzzy_amplitude, select_by_fuzzy_shape}) {
    auto batch = three_kinds(3);
    auto const before = select({{batch}}, {});
    std::mt19937_64 generator(9);
    for (auto& e : batch.error) e = 50 * normal(generator);
    EXPECT_EQ(select({{batch}}, {}).sensors, before.sensors);
    EXPECT_THAT(before.remark, testing::HasSubstr("Xie"));
  }
}

TEST(TimeRankedClusters, ChooseAsWithoutWhereClustersAreSharedAndClusterOnce) {
  auto const run = three_kinds(5), other = three_kinds(6);
  auto const shared = std::make_shared<SharedScreen>();
  for (auto const select :
       {select_by_time_at_maximum, select_by_first_maximum, select_by_fuzzy_amplitude, select_by_fuzzy_shape})
    for (std::optional<int> const count : {std::optional<int>(), std::optional(3)}) {
      auto const alone = select({&run, 1}, {.count = count}),
                 together = select({&run, 1}, {.count = count, .shared = shared});
      EXPECT_EQ(together.sensors, alone.sensors);
      EXPECT_EQ(together.remark, alone.remark);
    }
  // Asked about another run, it still has the clusters of the first.
  for (auto const scale : {ClusterScale::raw, ClusterScale::shape}) {
    auto const points = course_points(candidates({&run, 1}, {}), scale);
    EXPECT_EQ(shared->fuzzy(candidates({&other, 1}, {}), 1, scale).clusters(3).membership,
              fuzzy_c_means(points, 3).membership);
  }
}

TEST(TimeRankedClusters, HaveTheDistancesOfTheCourses) {
  auto const from = candidates({{three_kinds(4)}}, {});
  auto const points = course_points(from, ClusterScale::raw);
  for (Eigen::Index i = 0; i < 8; ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      EXPECT_NEAR((points.row(i) - points.row(j)).norm(),
                  (from.all.temperature_rise.col(i) - from.all.temperature_rise.col(j)).norm(), 1e-9);
}

/// Four sensors of which three read the same: three clusters cannot all be filled.
TEST(TimeRankedClusters, FillUpWhenSensorsReadTheSame) {
  auto batch = three_kinds(1);
  batch = with_sensors(batch, std::vector<Eigen::Index>{0, 1, 2, 3});
  batch.temperature_rise.col(1) = batch.temperature_rise.col(2) = batch.temperature_rise.col(3);
  SelectionOptions options;
  options.count = 3;
  auto const chosen = select_by_fuzzy_amplitude({{batch}}, options);
  EXPECT_EQ(chosen.sensors.size(), 3U);
  EXPECT_THAT(chosen.remark, testing::HasSubstr("clusters have a sensor"));
}

}  // namespace
}  // namespace thermotwin::models
