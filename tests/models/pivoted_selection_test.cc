#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/candidates.h"
#include "models/d_optimal.h"
#include "models/qr_pivot.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

Eigen::MatrixXd covariance_of(Batch const& data) {
  auto const readings = centred(data.temperature_rise);
  return readings.transpose() * readings / double(readings.rows() - 1);
}

SelectionOptions counting(int count) {
  SelectionOptions options;
  options.count = count;
  options.resolution = 0;
  return options;
}

TEST(PivotedSelection, WithOneSensorIsTheLargestVariance) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    auto const data = random_walks(seed, 80, 9);
    Eigen::Index largest = 0;
    double const variance = covariance_of(data).diagonal().maxCoeff(&largest);
    for (auto select : {select_by_qr_pivot, select_d_optimal}) {
      auto const chosen = select({{data}}, counting(1));
      EXPECT_THAT(chosen.sensors, testing::ElementsAre(largest));
      EXPECT_NEAR(chosen.score(largest), std::sqrt(variance), 1e-9);
    }
  }
}

/// Pivots are what a Schur complement leaves: deviations of the residuals of a regression on the sensors before.
TEST(QrPivot, TakesWhatTheOnesBeforeLeaveMostOf) {
  auto const data = random_walks(6, 80, 9);
  auto const chosen = select_by_qr_pivot({{data}}, counting(9));
  Eigen::MatrixXd left = covariance_of(data);
  for (auto sensor : chosen.sensors) {
    Eigen::Index largest = 0;
    EXPECT_NEAR(chosen.score(sensor), std::sqrt(left.diagonal().maxCoeff(&largest)), 1e-9);
    EXPECT_EQ(sensor, largest);
    Eigen::VectorXd const column = left.col(sensor);
    left -= column * column.transpose() / column(sensor);
  }
}

/// Better than the pivots it starts from, and nearly always the best of all sets.
TEST(DOptimal, IsAtLeastThePivotsAndNearlyAlwaysTheOptimum) {
  int optimal = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    auto const data = random_walks(seed, 40, 8);
    auto const covariance = covariance_of(data);
    auto const determinant = [&](std::vector<Eigen::Index> const& set) { return covariance(set, set).determinant(); };
    double const found = determinant(largest_determinant(covariance, 3));
    EXPECT_GE(found, determinant(select_by_qr_pivot({{data}}, counting(3)).sensors) * (1 - 1e-9));
    double best = 0;
    for (Eigen::Index a = 0; a < 8; ++a)
      for (Eigen::Index b = a + 1; b < 8; ++b)
        for (Eigen::Index c = b + 1; c < 8; ++c) best = std::max(best, determinant({a, b, c}));
    optimal += found > best * (1 - 1e-9);
    EXPECT_GT(found, 0.8 * best);
  }
  EXPECT_GE(optimal, 45);
}

/// Eight sensors of three sources, at 1 % of other noise: three are enough.
TEST(PivotedSelection, StopsWhenNothingIsLeft) {
  std::mt19937_64 generator(2);
  auto const sources = random_walks(9, 300, 3).temperature_rise;
  Eigen::MatrixXd rise(300, 8);
  for (Eigen::Index j = 0; j < 8; ++j) {
    rise.col(j) = sources.col(j % 3);
    for (auto& x : rise.col(j)) x += 0.02 * normal(generator);
  }
  for (auto select : {select_by_qr_pivot, select_d_optimal}) {
    std::vector<Eigen::Index> sources_seen;
    for (auto sensor : select({{batch_of(rise, rise.col(0))}}, {}).sensors) sources_seen.push_back(sensor % 3);
    EXPECT_THAT(sources_seen, testing::UnorderedElementsAre(0, 1, 2));
  }
}

/// Two sensors that read the same and one that hardly moves: only noise makes the third worth more than the double.
TEST(DOptimal, CountsTheRoundingOfReadings) {
  auto data = random_walks(3, 100, 3);
  data.temperature_rise.col(1) = data.temperature_rise.col(0);
  data.temperature_rise.col(2) *= 1e-3;
  auto options = counting(2);
  EXPECT_THAT(select_d_optimal({{data}}, options).sensors, testing::Contains(2));
  options.resolution = 0.1;
  auto const chosen = select_d_optimal({{data}}, options);
  EXPECT_NEAR(chosen.score(2), 0.1 / std::sqrt(12.0), 1e-2);
}

}  // namespace
}  // namespace thermotwin::models
