#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/correlation_grouping.h"
#include "models/d_optimal.h"
#include "models/exhaustive_selection.h"
#include "models/forward_selection.h"
#include "models/qr_pivot.h"
#include "models/time_characteristic.h"
#include "models/time_ranked_clusters.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using testing::UnorderedElementsAre;

SelectionOptions counting(int count) {
  SelectionOptions options;
  options.count = count;
  return options;
}

TEST(Forward, WithOneSensorIsExhaustiveWithOneSensor) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    auto const data = random_walks(seed, 80, 7);
    auto const forward = select_forward({{data}}, counting(1)), best = select_exhaustive({{data}}, counting(1));
    EXPECT_EQ(forward.sensors, best.sensors);
    EXPECT_EQ(forward.remark, best.remark);
  }
}

TEST(Forward, WithAllSensorsIsExhaustiveWithAllSensors) {
  auto const data = random_walks(2, 80, 5);
  EXPECT_THAT(select_forward({{data}}, counting(5)).sensors, UnorderedElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(select_exhaustive({{data}}, counting(5)).sensors, UnorderedElementsAre(0, 1, 2, 3, 4));
}

TEST(Forward, FindsTheTwoSensorsThatMakeTheErrorAndStops) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto const data = random_walks(seed, 200, 8);
    auto const free = select_forward({{data}}, {});
    EXPECT_THAT(free.sensors, testing::IsSupersetOf({1, 7}));
    EXPECT_LE(free.sensors.size(), 3U);
    EXPECT_THAT(select_exhaustive({{data}}, counting(2)).sensors, UnorderedElementsAre(1, 7));
    EXPECT_GT(free.score(1), free.score(3));
    EXPECT_GT(free.score(7), free.score(3));
  }
}

/// The best set is no worse than what any method finds, and than every set there is.
TEST(Exhaustive, IsTheBestThereIs) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    auto const data = random_walks(seed, 60, 7);
    SubsetValidation const validation({&data, 1});
    for (int count = 1; count <= 4; ++count) {
      double const best = best_subset(validation, count).rmse;
      for (auto select :
           {select_forward, select_by_correlation, select_by_qr_pivot, select_d_optimal, select_by_time_at_maximum,
            select_by_first_maximum, select_by_fuzzy_amplitude, select_by_fuzzy_shape, select_exhaustive}) {
        auto const chosen = select({{data}}, counting(count));
        EXPECT_EQ(int(chosen.sensors.size()), count);
        EXPECT_EQ(chosen.score.size(), 7);
        EXPECT_TRUE(chosen.score.allFinite());
        EXPECT_GE(validation.rmse(chosen.sensors), best * (1 - 1e-12));
      }
    }
  }
}

TEST(Exhaustive, MarginIsWhatASensorIsWorth) {
  auto const data = random_walks(4, 60, 5);
  SubsetValidation const validation({&data, 1});
  auto const best = best_subset(validation, 2);
  for (Eigen::Index sensor = 0; sensor < 5; ++sensor) {
    double with = 1e300, without = 1e300;
    for (Eigen::Index a = 0; a < 5; ++a)
      for (Eigen::Index b = a + 1; b < 5; ++b) {
        double& least = a == sensor || b == sensor ? with : without;
        least = std::min(least, validation.rmse(std::vector<Eigen::Index>{a, b}));
      }
    EXPECT_DOUBLE_EQ(best.margin(sensor), without - with);
    bool const member = std::find(best.sensors.begin(), best.sensors.end(), sensor) != best.sensors.end();
    EXPECT_EQ(best.margin(sensor) > 0, member);
  }
}

TEST(Exhaustive, GrowsAsLongAsItPays) {
  auto const data = random_walks(5, 300, 6);
  EXPECT_THAT(select_exhaustive({{data}}, {}).sensors, testing::IsSupersetOf({1, 5}));
  auto single = data;
  single.error = 3 * single.temperature_rise.col(2);
  EXPECT_THAT(select_exhaustive({{single}}, {}).sensors, testing::ElementsAre(2));
  EXPECT_THAT(select_forward({{single}}, {}).sensors, testing::ElementsAre(2));
}

TEST(Exhaustive, RefusesMoreThanTwentySites) {
  try {
    (void)select_exhaustive({{random_walks(1, 60, 21)}}, counting(1));
    FAIL();
  } catch (std::invalid_argument const& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("21 sensors are too many to try all sets; up to 20"));
  }
  EXPECT_EQ(select_exhaustive({{random_walks(1, 60, 20)}}, counting(1)).sensors.size(), 1U);
}

}  // namespace
}  // namespace thermotwin::models
