#include "models/mode_sensors.h"

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using testing::ElementsAre;
using testing::SizeIs;
using testing::UnorderedElementsAre;

/// Three modes seen by six sensors in pairs, the first of a pair twice as strongly; the third mode does not move the
/// error.
Eigen::MatrixXd shapes() {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(6, 3);
  for (Eigen::Index mode = 0; mode < 3; ++mode) {
    result(2 * mode, mode) = 2;
    result(2 * mode + 1, mode) = 1;
  }
  return result;
}

Batch readings() {
  std::mt19937_64 generator(4);
  Eigen::MatrixXd amplitude = random_walks(12, 500, 3).temperature_rise;
  for (Eigen::Index mode = 0; mode < 3; ++mode)
    amplitude.col(mode) = (amplitude.col(mode).array() - amplitude.col(mode).mean()).matrix().normalized() * 50;
  Eigen::MatrixXd rise = amplitude * shapes().transpose();
  for (auto& x : rise.reshaped()) x += 0.01 * normal(generator);
  return batch_of(rise, 3 * amplitude.col(0) + 5 * amplitude.col(1));
}

SelectionOptions options(std::optional<int> count) {
  SelectionOptions result;
  result.count = count;
  result.mode_shapes = shapes();
  return result;
}

double correlation(Eigen::VectorXd const& a, Eigen::VectorXd const& b) {
  Eigen::VectorXd const x = a.array() - a.mean(), y = b.array() - b.mean();
  return x.normalized().dot(y.normalized());
}

TEST(ModeSensors, TellWhatMovesTheError) {
  EXPECT_THAT(select_for_modes({{readings()}}, options({})).sensors, SizeIs(3));
  EXPECT_THAT(select_for_modes({{readings()}}, options(1)).sensors, ElementsAre(2));
  EXPECT_THAT(select_for_modes({{readings()}}, options(2)).sensors, UnorderedElementsAre(0, 2));
}

/// A strong mode that goes with the error because it goes with another one adds nothing to what that one's sensor
/// tells.
TEST(ModeSensors, HaveNoUseForAModeThatOnlyGoesWithTheError) {
  auto const batch = readings();
  Eigen::MatrixXd rise = batch.temperature_rise;
  rise.rightCols(2) += 20 * rise.leftCols(2);
  auto const data = batch_of(rise, batch.error);
  EXPECT_GT(std::abs(correlation(rise.col(4), data.error)), 0.3);
  EXPECT_THAT(select_for_modes({{data}}, options(2)).sensors, UnorderedElementsAre(0, 2));
}

/// Where the modes tell as much as the sensors do, what is left of the error's variance is that of a regression on the
/// readings whose coefficients are held by their rounding; of all sets, no other leaves less.
TEST(ModeSensors, LeaveTheLeastOfAllSets) {
  std::mt19937_64 generator(8);
  SelectionOptions any;
  any.resolution = 0.5;
  any.count = 3;
  any.mode_shapes = Eigen::MatrixXd::NullaryExpr(7, 7, [&] { return normal(generator); });
  Eigen::MatrixXd const rise = random_walks(6, 200, 7).temperature_rise * any.mode_shapes.transpose();
  auto const batch = batch_of(rise, random_walks(9, 200, 2).temperature_rise.col(0) + rise.rowwise().sum());
  Eigen::MatrixXd x = rise.rowwise() - rise.colwise().mean();
  Eigen::VectorXd const y = batch.error.array() - batch.error.mean();
  auto const left = [&](std::vector<Eigen::Index> const& set) {
    Eigen::MatrixXd const of = x(Eigen::all, set);
    Eigen::MatrixXd const S = of.transpose() * of / 199.0 + 0.25 / 12.0 * Eigen::MatrixXd::Identity(3, 3);
    Eigen::VectorXd const s = of.transpose() * y / 199.0;
    return y.squaredNorm() / 199.0 - s.dot(S.ldlt().solve(s));
  };
  auto const chosen = select_for_modes({{batch}}, any);
  for (Eigen::Index a = 0; a < 7; ++a)
    for (Eigen::Index b = a + 1; b < 7; ++b)
      for (Eigen::Index c = b + 1; c < 7; ++c) EXPECT_GE(left({a, b, c}), left(chosen.sensors) * (1 - 1e-9));
  for (Eigen::Index j = 0; j < 7; ++j)
    EXPECT_NEAR(chosen.score(j), std::pow(x.col(j).dot(y) / 199.0, 2) / (x.col(j).squaredNorm() / 199.0 + 0.25 / 12.0),
                1e-9 * y.squaredNorm());
}

TEST(ModeSensors, BeginWithWhatTellsMostWhenMoreAreAskedForThanThereAreModes) {
  auto const chosen = select_for_modes({{readings()}}, options(5)).sensors;
  EXPECT_EQ(chosen[0], 2);
  EXPECT_EQ(chosen[1], 0);
  EXPECT_EQ(std::set<Eigen::Index>(chosen.begin(), chosen.end()).size(), 5U);
}

TEST(ModeSensors, WithoutAnErrorFollowTheReadings) {
  auto data = readings();
  data.error.setZero();
  EXPECT_THAT(select_for_modes({{data}}, options({})).sensors, UnorderedElementsAre(0, 2, 4));
}

/// Six places tell six modes apart, of the ten that a network has. A second and a third sensor at some of them change
/// neither what the others see of the modes nor the choice.
TEST(ModeSensors, DoNotMindSecondSensorsAtTheSamePlaces) {
  std::mt19937_64 generator(3);
  Eigen::MatrixXd const modes = Eigen::MatrixXd::NullaryExpr(6, 10, [&] { return normal(generator); });
  Eigen::MatrixXd const amplitude = random_walks(5, 300, 10).temperature_rise;
  auto const batch = batch_of(amplitude * modes.transpose(), 4 * amplitude.col(1) - 2 * amplitude.col(4));
  std::vector<Eigen::Index> const places{0, 1, 2, 3, 4, 5, 1, 3, 3, 0};
  auto const doubled = batch_of(batch.temperature_rise(Eigen::all, places), batch.error);
  SelectionOptions six, ten;
  six.mode_shapes = modes;
  ten.mode_shapes = modes(places, Eigen::all);
  for (auto const count : {std::optional<int>{}, std::optional(3)}) {
    six.count = ten.count = count;
    auto const once = select_for_modes({{batch}}, six), twice = select_for_modes({{doubled}}, ten);
    EXPECT_EQ(twice.sensors, once.sensors);
    EXPECT_LT((twice.score.head(6) - once.score).cwiseAbs().maxCoeff(), 1e-9 * once.score.maxCoeff());
    EXPECT_EQ(twice.remark, once.remark);
  }
}

/// A fourth mode that looks like the first at every sensor takes nothing of its amplitude.
TEST(ModeSensors, GiveOneAmplitudeToModesThatLookAlike) {
  auto alike = options({});
  auto const known = select_for_modes({{readings()}}, alike);
  alike.mode_shapes.conservativeResize(Eigen::NoChange, 4);
  alike.mode_shapes.col(3) = -0.3 * alike.mode_shapes.col(0);
  alike.mode_shapes(1, 3) *= 1.0001;
  auto const chosen = select_for_modes({{readings()}}, alike);
  EXPECT_EQ(chosen.sensors, known.sensors);
  EXPECT_LT((chosen.score - known.score).cwiseAbs().maxCoeff(), 1e-3 * known.score.maxCoeff());
}

TEST(ModeSensors, LeaveAModeBelowTheRoundingAlone) {
  auto data = readings();
  data.temperature_rise.rightCols(2) *= 1e-4;
  auto const chosen = select_for_modes({{data}}, options({}));
  EXPECT_THAT(chosen.sensors, UnorderedElementsAre(0, 2));
  EXPECT_THAT(chosen.remark, testing::HasSubstr("2 of 3 thermal modes"));
}

TEST(ModeSensors, RefuseShapesThatDoNotFit) {
  for (auto const& wrong : {Eigen::MatrixXd{}, Eigen::MatrixXd{shapes().topRows(5)}}) {
    SelectionOptions bad;
    bad.mode_shapes = wrong;
    try {
      (void)select_for_modes({{readings()}}, bad);
      ADD_FAILURE();
    } catch (std::invalid_argument const& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("a row for each of the 6 sensors"));
    }
  }
  auto bad = options({});
  bad.mode_shapes.setZero();
  EXPECT_THROW((void)select_for_modes({{readings()}}, bad), std::invalid_argument);
  bad.mode_shapes(1, 1) = std::nan("");
  EXPECT_THROW((void)select_for_modes({{readings()}}, bad), std::invalid_argument);
}

}  // namespace
}  // namespace thermotwin::models
