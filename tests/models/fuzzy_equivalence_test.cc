#include "models/fuzzy_equivalence.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/planted_noise.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;
using Classes = std::vector<std::vector<Index>>;

MatrixXd random_similarity(Index count, std::uint64_t seed) {
  Noise noise(seed);
  return correlation_similarity(noise.series(6 * count).reshaped(6, count));
}

/// Of all paths from i to j the one whose weakest step is the strongest (Floyd and Warshall).
MatrixXd widest_paths(MatrixXd r) {
  for (Index k = 0; k < r.rows(); ++k)
    for (Index i = 0; i < r.rows(); ++i)
      for (Index j = 0; j < r.rows(); ++j) r(i, j) = std::max(r(i, j), std::min(r(i, k), r(k, j)));
  return r;
}

TEST(FuzzyEquivalence, SimilarityIsTheCorrelationWithoutItsSign) {
  MatrixXd const x = (MatrixXd(4, 4) << 0, 0, 1, 7, 1, -2, 3, 7, 2, -4, 2, 7, 3, -6, 5, 7).finished();
  MatrixXd const r = correlation_similarity(x);
  EXPECT_NEAR(r(0, 1), 1, 1e-15);
  EXPECT_NEAR(r(0, 2), 5.5 / std::sqrt(5 * 8.75), 1e-15);
  EXPECT_EQ(r(0, 3), 0);  // never moves
  EXPECT_EQ(r(3, 3), 1);
}

TEST(FuzzyEquivalence, ClosureByHand) {
  MatrixXd const r =
      (MatrixXd(4, 4) << 1, 0.8, 0.2, 0.1, 0.8, 1, 0.6, 0.3, 0.2, 0.6, 1, 0.4, 0.1, 0.3, 0.4, 1).finished();
  MatrixXd const t =
      (MatrixXd(4, 4) << 1, 0.8, 0.6, 0.4, 0.8, 1, 0.6, 0.4, 0.6, 0.6, 1, 0.4, 0.4, 0.4, 0.4, 1).finished();
  EXPECT_EQ(transitive_closure(r), t);
  EXPECT_EQ(levels_of(t), (std::vector<double>{0.8, 0.6, 0.4}));
  EXPECT_EQ(classes_at(t, 0.8), (Classes{{0, 1}, {2}, {3}}));
  EXPECT_EQ(classes_at(t, 0.5), (Classes{{0, 1, 2}, {3}}));
  EXPECT_EQ(classes_at(t, 0.4 + 1e-14), (Classes{{0, 1, 2, 3}}));
}

TEST(FuzzyEquivalence, ClosureIsMaxMinTransitiveAndTheLeastAboveTheSimilarity) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    MatrixXd const r = random_similarity(9, seed), t = transitive_closure(r);
    EXPECT_TRUE((t.array() >= r.array()).all());
    for (Index i = 0; i < 9; ++i)
      for (Index j = 0; j < 9; ++j)
        for (Index k = 0; k < 9; ++k) EXPECT_GE(t(i, j), std::min(t(i, k), t(k, j)));
    EXPECT_EQ(t, widest_paths(r));
  }
}

TEST(FuzzyEquivalence, ClassesAreNestedInLambda) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    MatrixXd const t = transitive_closure(random_similarity(10, seed));
    auto const levels = levels_of(t);
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
      auto const fine = classes_at(t, levels[i]), coarse = classes_at(t, levels[i + 1]);
      EXPECT_GT(fine.size(), coarse.size());
      for (auto const& members : fine)
        EXPECT_TRUE(std::any_of(coarse.begin(), coarse.end(), [&](auto const& whole) {
          return std::includes(whole.begin(), whole.end(), members.begin(), members.end());
        }));
    }
  }
}

TEST(FuzzyEquivalence, NearestCountWhereTheLevelsJumpOverTheOneWanted) {
  MatrixXd t = MatrixXd::Constant(4, 4, 0.3);
  t.diagonal().setOnes();
  EXPECT_EQ(classes_nearest(t, 3).size(), 4U);  // only 4 and 1 exist
  EXPECT_EQ(classes_nearest(t, 2).size(), 1U);
  t(0, 1) = t(1, 0) = 0.9;
  EXPECT_EQ(classes_nearest(t, 3), (Classes{{0, 1}, {2}, {3}}));
  EXPECT_EQ(classes_nearest(t, 2).size(), 3U);  // 3 and 1 are as near: the finer
}

/// Sensors 1, 4, 5 read one state, 2, 3, 6 another; the sixth falls where the others rise.
Batch two_groups(std::uint64_t seed) {
  Noise noise(seed);
  VectorXd const one = thermal_state(80, 6, 10, noise), other = thermal_state(80, 20, 25, noise);
  MatrixXd rise(80, 6);
  rise << 5 * one, 5 * other, 4 * other, 4 * one, 5 * one, -4 * other;
  for (double& reading : rise.reshaped()) reading += 0.05 * noise();
  VectorXd const error = 4 * one + 6 * other + 0.1 * noise.series(80);
  return batch_of(rise, error);
}

TEST(FuzzyEquivalence, PlantedGroupsComeBackByFAndByCount) {
  int by_F = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Batch const batch = two_groups(seed);
    MatrixXd unit = batch.temperature_rise.rowwise() - batch.temperature_rise.colwise().mean();
    unit.col(5) *= -1;
    unit.colwise().normalize();
    MatrixXd const closure = transitive_closure(correlation_similarity(batch.temperature_rise));
    Classes const planted{{0, 3, 4}, {1, 2, 5}};
    EXPECT_EQ(classes_nearest(closure, 2), planted);
    if (classes_by_F(closure, unit.transpose()) == planted) ++by_F;
  }
  EXPECT_GE(by_F, 80);  // of six objects five classes leave F one degree of freedom: it errs where two nearly coincide
}

/// A second sensor that shows the same does not decide how many classes there are.
TEST(FuzzyEquivalence, IdenticalSensorsDoNotWinByADivisionByZero) {
  auto const classes = [](MatrixXd const& objects) {
    MatrixXd const columns = objects.transpose();
    return classes_by_F(transitive_closure(correlation_similarity(columns)), objects);
  };
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    MatrixXd objects(7, 80);
    Noise noise(seed);
    VectorXd const one = thermal_state(80, 6, 10, noise), other = thermal_state(80, 20, 25, noise);
    for (Index i = 0; i < 7; ++i) objects.row(i) = (i < 3 ? one : other) + (0.1 + 0.02 * double(i)) * noise.series(80);
    for (Index i = 0; i < 7; ++i) objects.row(i).array() -= objects.row(i).mean();
    objects.rowwise().normalize();
    objects.row(5) = objects.row(6) = objects.row(4);  // three times the same
    Classes const found = classes(objects);
    EXPECT_LT(found.size(), 5U) << "seed " << seed;
  }
}

/// Where all are the same as some other, the classes of these are what is left.
TEST(FuzzyEquivalence, PartsGroupsOfIdenticalSensors) {
  Noise noise(1);
  VectorXd const one = noise.series(30), other = noise.series(30);
  MatrixXd columns(30, 5);
  columns << one, other, one, other, one;
  EXPECT_EQ(classes_by_F(transitive_closure(correlation_similarity(columns)), columns.transpose()),
            (Classes{{0, 2, 4}, {1, 3}}));
}

TEST(FuzzyEquivalence, ChoosesTheHighestGradeOfEachClass) {
  Batch const batch = two_groups(5);
  auto const two = select_by_grey_fuzzy_clustering({&batch, 1}, {});
  ASSERT_EQ(two.sensors.size(), 2U);
  auto const of_first = [](Index sensor) { return sensor == 0 || sensor == 3 || sensor == 4; };
  EXPECT_NE(of_first(two.sensors[0]), of_first(two.sensors[1]));
  for (Index sensor = 0; sensor < 6; ++sensor)
    EXPECT_LE(two.score(sensor),
              two.score(of_first(sensor) == of_first(two.sensors[0]) ? two.sensors[0] : two.sensors[1]));
  EXPECT_THAT(two.remark, HasSubstr("2 classes by F"));
  for (int count = 1; count <= 6; ++count)
    EXPECT_EQ(select_by_grey_fuzzy_clustering({&batch, 1}, {.count = count}).sensors.size(),
              static_cast<std::size_t>(count));
}

TEST(FuzzyEquivalence, RefusesWhatIsNoSimilarity) {
  MatrixXd r = MatrixXd::Identity(3, 3);
  r(0, 1) = 0.5;
  EXPECT_THROW(transitive_closure(r), std::invalid_argument);
  r(1, 0) = 0.5;
  EXPECT_NO_THROW(transitive_closure(r));
  r(2, 2) = 0.9;
  EXPECT_THROW(transitive_closure(r), std::invalid_argument);
  EXPECT_THROW(transitive_closure(MatrixXd::Ones(2, 3)), std::invalid_argument);
  EXPECT_THROW(classes_by_F(MatrixXd::Ones(3, 3), MatrixXd::Ones(2, 5)), std::invalid_argument);
}

}  // namespace
}  // namespace thermotwin::models
