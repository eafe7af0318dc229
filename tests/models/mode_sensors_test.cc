#include "models/mode_sensors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using testing::ElementsAre;
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

TEST(Participation, FindsAmplitudesAndWhatTheyDo) {
  auto const data = readings();
  auto const share = participation(shapes(), data.temperature_rise, data.error);
  double const deviation = 50 / std::sqrt(499.0) * std::sqrt(5.0);
  for (Eigen::Index mode = 0; mode < 3; ++mode) EXPECT_NEAR(share.deviation(mode), deviation, 0.01 * deviation);
  EXPECT_GT(share.correlation(1), share.correlation(0));
  auto const scaled =
      participation(shapes() * Eigen::Vector3d(7, -0.1, 3).asDiagonal(), data.temperature_rise, data.error);
  EXPECT_LT((scaled.deviation - share.deviation).norm(), 1e-9);
  EXPECT_LT((scaled.correlation.cwiseAbs() - share.correlation.cwiseAbs()).norm(), 1e-9);
}

TEST(ModeSensors, SeeEachModeWhereItIsStrongest) {
  EXPECT_THAT(select_for_modes({{readings()}}, options({})).sensors, UnorderedElementsAre(0, 2, 4));
  EXPECT_THAT(select_for_modes({{readings()}}, options(1)).sensors, ElementsAre(2));
  EXPECT_THAT(select_for_modes({{readings()}}, options(2)).sensors, UnorderedElementsAre(0, 2));
}

TEST(ModeSensors, SeeModesTwiceWhenMoreAreAskedFor) {
  auto const chosen = select_for_modes({{readings()}}, options(5)).sensors;
  EXPECT_THAT(std::vector(chosen.begin(), chosen.begin() + 3), UnorderedElementsAre(0, 2, 4));
  EXPECT_EQ(chosen[3], 3);
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
