#include "models/time_characteristic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using testing::ElementsAre;

Eigen::MatrixXd golden() {
  Eigen::MatrixXd rows(4, 7);
  rows << 20, 21, 22, 23, 23, 23, 23,      //
      20, 20.5, 21, 21.5, 22, 22.5, 22.5,  //
      20, 22, 24, 24, 24, 24, 24,          //
      20, 24, 26, 28, 28, 28, 28;
  return rows.transpose();
}

std::vector<double> ranks(Eigen::MatrixXd const& readings, double resolution, TimeRank form) {
  auto const rank = time_characteristic(readings, resolution, form).rank;
  return {rank.begin(), rank.end()};
}

/// methods.md §4.2.
TEST(TimeCharacteristic, HasTheGoldenRanks) {
  for (auto form : {TimeRank::at_maximum, TimeRank::first_maximum}) {
    EXPECT_THAT(ranks(golden(), 0.5, form), ElementsAre(4, 2, 5, 4));
    EXPECT_THAT(order_of(time_characteristic(golden(), 0.5, form)), ElementsAre(2, 3, 0, 1));
  }
}

TEST(TimeCharacteristic, IsThatOfChangesAsOfTemperatures) {
  EXPECT_EQ(ranks((golden().array() - 20).matrix(), 0.5, TimeRank::at_maximum),
            ranks(golden(), 0.5, TimeRank::at_maximum));
}

TEST(TimeCharacteristic, IsTheSameInBothFormsOnMonotoneData) {
  std::mt19937_64 generator(3);
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::MatrixXd rise(120, 3);
    for (Eigen::Index j = 0; j < 3; ++j)
      rise.col(j) = warm_up(2 + 20 * uniform(generator), 2 + 60 * uniform(generator), 120, 0, generator);
    EXPECT_EQ(ranks(rise, 0.0625, TimeRank::at_maximum), ranks(rise, 0.0625, TimeRank::first_maximum));
  }
}

TEST(TimeCharacteristic, DiffersBetweenTheFormsOnceAMaximumIsLeft) {
  Eigen::MatrixXd rise(6, 1);
  rise << 0, 2, 3, 3, 1, 0;
  EXPECT_THAT(ranks(rise, 0.5, TimeRank::at_maximum), ElementsAre(2));
  EXPECT_THAT(ranks(rise, 0.5, TimeRank::first_maximum), ElementsAre(4));
}

/// A flange that cools ranks as its mirror image that warms; small positive readings among large negative ones count
/// nothing (Int(−3/1) would be −3).
TEST(TimeCharacteristic, OfACoolingPointIsThatOfItsMirrorImage) {
  Eigen::MatrixXd rise(6, 2);
  rise.col(0) << 0, -2, -3, -3, -3, -3;
  rise.col(1) << 0, 1, -3, -3, -3, -3;
  for (auto form : {TimeRank::at_maximum, TimeRank::first_maximum}) {
    EXPECT_THAT(ranks(rise, 0.5, form), ElementsAre(4, 4));
    EXPECT_EQ(ranks(-rise, 0.5, form), ranks(rise, 0.5, form));
  }
}

TEST(TimeCharacteristic, NeedsQuantisedReadings) {
  std::mt19937_64 generator(5);
  Eigen::MatrixXd const rise = warm_up(10, 5, 200, 0.01, generator);
  EXPECT_THAT(ranks(rise, 0, TimeRank::at_maximum), ElementsAre(1));
  EXPECT_GT(ranks(rise, 0.5, TimeRank::at_maximum).front(), 150);
}

TEST(TimeCharacteristic, OfASensorThatStandsStillIsZero) {
  EXPECT_THAT(ranks(Eigen::MatrixXd::Constant(5, 1, 3.0), 0.5, TimeRank::at_maximum), ElementsAre(0));
}

TEST(TimeCharacteristic, RefusesANegativeResolution) {
  EXPECT_THROW((void)time_characteristic(golden(), -1, TimeRank::at_maximum), std::invalid_argument);
}

/// Fast, slow, fast with small rise, cooling: rank before range, range only among equals.
Batch spindle(std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  Eigen::MatrixXd rise(240, 4);
  rise << warm_up(12, 90, 240, 0.02, generator), warm_up(8, 12, 240, 0.02, generator),
      warm_up(20, 45, 240, 0.02, generator), warm_up(-6, 20, 240, 0.02, generator);
  return batch_of(rise, 4 * rise.col(2));
}

TEST(TimeSelection, TakesTheEarliest) {
  SelectionOptions options;
  options.count = 3;
  options.resolution = 0.5;
  EXPECT_THAT(select_by_time_at_maximum({{spindle(1)}}, options).sensors, ElementsAre(1, 3, 2));
  EXPECT_THAT(select_by_first_maximum({{spindle(1)}}, options).sensors, ElementsAre(1, 3, 2));
}

TEST(TimeSelection, NeverLooksAtTheError) {
  for (auto select : {select_by_time_at_maximum, select_by_first_maximum}) {
    auto batch = spindle(2);
    auto const before = select({{batch}}, {});
    std::mt19937_64 generator(9);
    for (auto& e : batch.error) e = 50 * normal(generator);
    auto const after = select({{batch}}, {});
    EXPECT_EQ(before.sensors, after.sensors);
    EXPECT_EQ(before.score, after.score);
    EXPECT_EQ(before.remark, after.remark);
  }
}

TEST(TimeSelection, AddsUpOverRuns) {
  std::vector<Batch> const runs{spindle(1), spindle(2)};
  auto const one = time_characteristic(runs[0].temperature_rise, 0.5, TimeRank::at_maximum);
  auto const other = time_characteristic(runs[1].temperature_rise, 0.5, TimeRank::at_maximum);
  auto const both = time_characteristic(runs, 0.5, TimeRank::at_maximum);
  EXPECT_EQ(both.rank, one.rank + other.rank);
  EXPECT_EQ(both.range, one.range + other.range);
}

TEST(TimeSelection, SaysWhenOnlyTheRangeDecides) {
  auto batch = spindle(1);
  for (Eigen::Index j = 0; j < 4; ++j) batch.temperature_rise.col(j) = (1.0 + double(j)) * batch.time / 3600;
  SelectionOptions options;
  options.count = 2;
  options.resolution = 1e-6;
  auto const chosen = select_by_time_at_maximum({{batch}}, options);
  EXPECT_THAT(chosen.remark, testing::HasSubstr("only the range"));
  EXPECT_THAT(chosen.sensors, ElementsAre(3, 2));
}

}  // namespace
}  // namespace thermotwin::models
