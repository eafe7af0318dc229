#include "models/class_count.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/ordered_clustering.h"
#include "tests/models/planted_noise.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::HasSubstr;

VectorXd golden_loss() {
  return OrderedPartitions(
             class_diameters((MatrixXd(11, 1) << 9.3, 1.8, 1.9, 1.7, 1.5, 1.3, 1.4, 2.0, 1.9, 2.3, 2.1).finished()))
      .loss();
}

TEST(ClassCount, GoldenSlopesAndRatios) {
  VectorXd const slopes = loss_slopes(golden_loss()), ratios = loss_ratios(golden_loss());
  EXPECT_NEAR(slopes(0), 51.27, 0.005);
  EXPECT_NEAR(slopes(1), 0.541, 0.0006);
  EXPECT_NEAR(slopes(2), 0.240, 0.0006);
  EXPECT_NEAR(slopes(3), 0.062, 0.0006);
  EXPECT_NEAR(ratios(1), 2.47, 0.006);
  EXPECT_NEAR(ratios(2), 2.88, 0.006);
  EXPECT_NEAR(ratios(3), 1.96, 0.006);
  EXPECT_NEAR(ratios(4), 1.44, 0.006);
}

TEST(ClassCount, BendsOfTheGoldenCourse) {
  EXPECT_THAT(bends(golden_loss()), ElementsAre(2, 3));
  EXPECT_THAT(bends(golden_loss(), 1e-3), ElementsAre(2, 3, 4));
  EXPECT_THAT(bends(golden_loss(), 1e-3, 2), ElementsAre(2, 3));
  EXPECT_THAT(bends(golden_loss(), 2.0), ElementsAre(2));  // none is that strong: the strongest
  EXPECT_THAT(bends(VectorXd::Zero(1)), ElementsAre(1));
  EXPECT_THAT(bends(Eigen::Vector2d(1, 0)), ElementsAre(2));
}

TEST(ClassCount, SlopeRuleTakesTheSmallestCandidateOfAConvexCourse) {
  for (double const decay : {1.2, 2.0, 5.0}) {
    VectorXd const loss = VectorXd::NullaryExpr(10, [&](Index i) { return std::pow(decay, -static_cast<double>(i)); });
    EXPECT_EQ(count_by_slope(loss, {3, 4, 5}), 3);
    EXPECT_EQ(count_by_slope(loss, {4, 6}), 4);
  }
  EXPECT_EQ(count_by_slope((VectorXd(5) << 10, 9, 8.5, 1, 0).finished(), {2, 3, 4}), 4);
}

TEST(ClassCount, RatioRulePutsFirstWhereOneMoreClassHelpedMost) {
  EXPECT_THAT(counts_by_ratio(golden_loss(), {3, 4, 5}), ElementsAre(4, 3, 5));
  EXPECT_THAT(counts_by_ratio((VectorXd(5) << 10, 6, 4, 0, 0).finished(), {2, 3, 4}), ElementsAre(4, 2, 3));
}

/// Trials on the first 1, 2, … of these regressors.
std::vector<ClassCountTrial> nested_trials(MatrixXd const& x, VectorXd const& y, int from) {
  std::vector<ClassCountTrial> trials;
  for (int k = from; k <= x.cols(); ++k) trials.push_back({k, {}, linear_regression(x.leftCols(k), y), {}});
  return trials;
}

TEST(ClassCount, ImprovedRuleFindsThePlantedNumberAndRejectsARedundantSensor) {
  int right = 0, redundant_rejected = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Noise noise(seed);
    MatrixXd x(60, 5);
    for (Index i = 0; i < 4; ++i) x.col(i) = 5 * thermal_state(60, 6 + 4 * static_cast<double>(i), 10, noise);
    VectorXd const y = 3 * x.col(0) - 2 * x.col(1) + 2 * x.col(2) + 1.5 * x.col(3) + 0.3 * noise.series(60);
    x.col(4) = x.col(0) + 0.1 * noise.series(60);  // reads what the first reads
    auto const trials = nested_trials(x, y, 3);
    auto const verdict = count_by_regression(trials);
    if (verdict.accepted && trials[*verdict.trial].k == 4) ++right;
    if (trials[*verdict.trial].k != 5) ++redundant_rejected;
  }
  EXPECT_GE(redundant_rejected, 180);
  EXPECT_GE(right, 160);
}

TEST(ClassCount, ImprovedRuleTakesTheSmallestNumberWhereNoFurtherClassHelps) {
  Noise noise(4);
  MatrixXd const x = noise.series(150).reshaped(50, 3);
  VectorXd const y = 2 * x.col(0) + 1e-3 * (x.col(1) + x.col(2)) + 1e-4 * noise.series(50);
  auto const trials = nested_trials(x, y, 1);  // p values of all tiny, R2 rises by less than the tolerance
  auto const verdict = count_by_regression(trials);

  EXPECT_TRUE(verdict.accepted);
  EXPECT_EQ(*verdict.trial, 0U);
  EXPECT_EQ(*count_by_regression(trials, {.r_squared_rise = 0}).trial, 2U);
}

TEST(ClassCount, WhereEveryNumberFailsATestTheWalkTakesNoNoticeAndSaysSo) {
  Noise noise(9);
  MatrixXd const x = noise.series(60).reshaped(20, 3);
  auto trials = nested_trials(x, noise.series(20), 2);
  auto const verdict = count_by_regression(trials);
  EXPECT_FALSE(verdict.accepted);
  EXPECT_EQ(*verdict.trial, 0U);
  EXPECT_THAT(verdict.reason, HasSubstr("p_F 0."));

  for (auto& trial : trials) trial.obstacle = "sensor 'T2' is a combination";
  EXPECT_FALSE(count_by_regression(trials).trial.has_value());
  EXPECT_THAT(count_by_regression(trials).reason, HasSubstr("k = 3: sensor 'T2' is a combination"));
}

}  // namespace
}  // namespace thermotwin::models
