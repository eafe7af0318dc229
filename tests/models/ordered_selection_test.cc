#include "models/ordered_selection.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "models/linear_regression.h"
#include "models/shared_screen.h"
#include "tests/models/planted_noise.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Index samples = 100;

/// Four components, each with a state of its own and at a level of its own, read by three sensors; the error follows
/// all.
Batch four_components(std::uint64_t seed) {
  Noise noise(seed);
  std::vector<double> const level{2, 9, 5, 15}, weight{4, -2, 3, 1.5};
  MatrixXd rise(samples, 12);
  VectorXd error = 0.3 * noise.series(samples);
  std::vector<std::string> components;
  for (Index c = 0; c < 4; ++c) {
    auto const i = static_cast<std::size_t>(c);
    VectorXd const state = level[i] * (0.7 + 0.3 * thermal_state(samples, 8, 12, noise).array());
    error += weight[i] * state;
    for (Index sensor = 3 * c; sensor < 3 * c + 3; ++sensor) {
      rise.col(sensor) = (1 + 0.02 * static_cast<double>(sensor % 3)) * state + 0.02 * noise.series(samples);
      components.push_back("component " + std::to_string(c));
    }
  }
  Batch batch = batch_of(rise, error);
  batch.components = components;
  return batch;
}

std::set<Index> components_of(std::vector<Index> const& sensors) {
  std::set<Index> found;
  for (Index const sensor : sensors) found.insert(sensor / 3);
  return found;
}

double cross_run_rmse(std::vector<Index> const& sensors, Batch const& training, Batch const& other) {
  auto const fit = linear_regression(training.temperature_rise(Eigen::all, sensors), training.error);
  VectorXd const predicted = (other.temperature_rise(Eigen::all, sensors) * fit.coefficients).array() + fit.intercept;
  return (other.error - predicted).norm() / std::sqrt(static_cast<double>(samples));
}

TEST(OrderedSelection, ImprovedRuleFindsFourAndPredictsBetterThanTheTraditionalOnes) {
  int right = 0, one_of_each = 0, better_than_slope = 0, no_worse_than_ratio = 0;
  constexpr int worlds = 50;
  for (std::uint64_t seed = 0; seed < worlds; ++seed) {
    Batch const run = four_components(seed), next = four_components(1000 + seed);
    auto const improved = select_by_ordered_clustering_improved({&run, 1}, {}).sensors;
    auto const slope = select_by_ordered_clustering_slope({&run, 1}, {}).sensors;
    auto const ratio = select_by_ordered_clustering_ratio({&run, 1}, {}).sensors;
    if (improved.size() == 4) ++right;
    if (improved.size() == 4 && components_of(improved).size() == 4) ++one_of_each;
    EXPECT_LE(slope.size(), improved.size());
    if (cross_run_rmse(improved, run, next) < cross_run_rmse(slope, run, next)) ++better_than_slope;
    if (cross_run_rmse(improved, run, next) <= cross_run_rmse(ratio, run, next)) ++no_worse_than_ratio;
  }
  EXPECT_GE(right, worlds * 80 / 100);
  EXPECT_GE(one_of_each, worlds * 80 / 100);
  EXPECT_GE(better_than_slope, worlds * 80 / 100);
  EXPECT_GE(no_worse_than_ratio, worlds * 80 / 100);
}

TEST(OrderedSelection, ACountIsKeptByEachRuleUpToAllSensors) {
  Batch const run = four_components(3);
  for (auto const select :
       {select_by_ordered_clustering_improved, select_by_ordered_clustering_ratio, select_by_ordered_clustering_slope})
    for (int count = 1; count <= 12; ++count) {
      auto const chosen = select({&run, 1}, {.count = count});
      EXPECT_EQ(std::set<Index>(chosen.sensors.begin(), chosen.sensors.end()).size(), static_cast<std::size_t>(count));
      EXPECT_TRUE(std::is_sorted(chosen.sensors.begin(), chosen.sensors.end(),
                                 [&](Index a, Index b) { return chosen.score(a) > chosen.score(b); }));
    }
}

TEST(OrderedSelection, MethodsThatShareAScreenChooseAsWithoutAndScreenOnce) {
  Batch const run = four_components(3);
  auto const shared = std::make_shared<SharedScreen>();
  for (auto const select : {select_by_mutual_information, select_by_ordered_clustering_improved,
                            select_by_ordered_clustering_ratio, select_by_ordered_clustering_slope})
    for (std::optional<int> const count : {std::optional<int>(), std::optional(3), std::optional(10)}) {
      auto const alone = select({&run, 1}, {.count = count}),
                 together = select({&run, 1}, {.count = count, .shared = shared});
      EXPECT_EQ(together.sensors, alone.sensors);
      EXPECT_EQ(together.score, alone.score);
      EXPECT_EQ(together.remark, alone.remark);
    }
  Batch const other = four_components(4);
  auto const first = candidates({&run, 1}, {}), second = candidates({&other, 1}, {});
  EXPECT_EQ(shared->screen(second, {}).information, screen_by_information(first, 1).information);
}

/// Of each class of the sensors so normalised the one of most information, whatever the rule; without a word, between
/// the sensors at each instant.
TEST(OrderedSelection, TheRulesPartWhatIsNormalisedAsAsked) {
  Batch run = random_walks(7, 80, 8);
  run.components = {"a", "b", "c", "d", "e", "f", "g", "h"};
  auto const order = ascending(run.temperature_rise);
  auto const expected = [&](Normalisation how, VectorXd const& information) {
    std::set<Index> sensors;
    auto const objects = normalised(run.temperature_rise(Eigen::all, order), how);
    for (auto const& places : OrderedPartitions(class_diameters(objects)).classes(3))
      sensors.insert(*std::max_element(order.begin() + places.front(), order.begin() + places.back() + 1,
                                       [&](Index a, Index b) { return information(a) < information(b); }));
    return sensors;
  };
  for (auto const select : {select_by_ordered_clustering_improved, select_by_ordered_clustering_ratio,
                            select_by_ordered_clustering_slope}) {
    std::set<std::set<Index>> different;
    for (auto const how : {Normalisation::across_sensors, Normalisation::over_time, Normalisation::z_score}) {
      auto const chosen = select({&run, 1}, {.count = 3, .normalisation = how});
      std::set<Index> const sensors(chosen.sensors.begin(), chosen.sensors.end());
      EXPECT_EQ(sensors, expected(how, chosen.score));
      different.insert(sensors);
    }
    EXPECT_GE(different.size(), 2U);
    EXPECT_EQ(select({&run, 1}, {.count = 3}).sensors,
              select({&run, 1}, {.count = 3, .normalisation = Normalisation::across_sensors}).sensors);
  }
}

TEST(OrderedSelection, RemarkHasTheFiguresThatDecided) {
  Batch const run = four_components(3);
  auto const remark = select_by_ordered_clustering_improved({&run, 1}, {}).remark;
  EXPECT_THAT(remark, HasSubstr("k = 4 by the improved rule among 2, 3, 4, N = 100"));
  EXPECT_THAT(remark, HasSubstr("HAC"));
}

TEST(OrderedSelection, SensorsOfOneStateLeaveOne) {
  VectorXd const state = VectorXd::NullaryExpr(40, [](Index i) { return 1 - std::exp(-static_cast<double>(i) / 9); });
  Batch const run = batch_of(state * Eigen::RowVector4d(1, 2, 3, 5), 4 * state);
  auto const chosen = select_by_ordered_clustering_improved({&run, 1}, {});
  EXPECT_EQ(chosen.sensors.size(), 1U);
  EXPECT_THAT(chosen.remark, HasSubstr("is a combination of the ones before"));
}

TEST(OrderedSelection, TooFewSamplesForARegressionAreRefused) {
  Noise noise(1);
  MatrixXd const rise = noise.series(4 * 6).reshaped(4, 6);
  Batch run = batch_of(rise, noise.series(4));
  run.components = {"a", "b", "c", "d", "e", "f"};
  run.temperature_rise.rowwise() += Eigen::RowVectorXd::LinSpaced(6, 0, 500);
  for (int i = 0; i < 6; ++i) run.temperature_rise.col(i).array() += 100.0 * (i / 2);
  auto const remark_or_refusal = [&] { select_by_ordered_clustering_improved({&run, 1}, {}); };
  run.time.conservativeResize(3);
  run.error.conservativeResize(3);
  run.temperature_rise.conservativeResize(3, 6);
  EXPECT_THAT(remark_or_refusal, ThrowsMessage<std::invalid_argument>(HasSubstr("3 samples")));
}

}  // namespace
}  // namespace thermotwin::models
