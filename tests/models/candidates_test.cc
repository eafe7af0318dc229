#include "models/candidates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/correlation_grouping.h"
#include "models/d_optimal.h"
#include "models/exhaustive_selection.h"
#include "models/forward_selection.h"
#include "models/mode_sensors.h"
#include "models/qr_pivot.h"
#include "models/time_characteristic.h"
#include "models/time_ranked_clusters.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Select = Selection (*)(std::span<Batch const>, SelectionOptions const&);

class EverySelection : public testing::TestWithParam<Select> {
 protected:
  static SelectionOptions options(std::optional<int> count) {
    SelectionOptions result;
    result.count = count;
    result.mode_shapes = random_walks(8, 6, 2).temperature_rise;
    return result;
  }

  static void refuses(std::vector<Batch> const& batches, std::optional<int> count, char const* why) {
    try {
      (void)GetParam()(batches, options(count));
      ADD_FAILURE() << "accepted: " << why;
    } catch (std::invalid_argument const& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, EverySelection,
                         testing::Values(select_by_time_at_maximum, select_by_first_maximum, select_by_fuzzy_amplitude,
                                         select_by_fuzzy_shape, select_by_correlation, select_for_modes,
                                         select_by_qr_pivot, select_d_optimal, select_forward, select_exhaustive));

TEST_P(EverySelection, ReturnsExactlyAsManyDifferentSensorsAsAskedFor) {
  auto const data = random_walks(3, 60, 6);
  for (int count = 1; count <= 6; ++count) {
    auto chosen = GetParam()({{data}}, options(count)).sensors;
    EXPECT_EQ(int(chosen.size()), count);
    std::sort(chosen.begin(), chosen.end());
    EXPECT_EQ(std::unique(chosen.begin(), chosen.end()), chosen.end());
    EXPECT_GE(chosen.front(), 0);
    EXPECT_LT(chosen.back(), 6);
  }
}

TEST_P(EverySelection, HasARuleOfItsOwnAndRepeatsItself) {
  std::vector<Batch> const data{random_walks(3, 60, 6), random_walks(4, 50, 6)};
  auto const chosen = GetParam()(data, options({})), again = GetParam()(data, options({}));
  EXPECT_GE(chosen.sensors.size(), 1U);
  EXPECT_EQ(chosen.sensors, again.sensors);
  EXPECT_EQ(chosen.score, again.score);
  EXPECT_NE(chosen.remark, "");
}

TEST_P(EverySelection, LeavesOutWhatStandsStillAndSaysSo) {
  auto data = random_walks(3, 60, 6);
  data.temperature_rise.col(1).setConstant(4.5);
  auto const chosen = GetParam()({{data}}, options(5));
  EXPECT_EQ(chosen.sensors.size(), 5U);
  EXPECT_THAT(chosen.sensors, testing::Not(testing::Contains(1)));
  EXPECT_THAT(chosen.remark, testing::HasSubstr("left out, for the readings stand still: T2"));
  EXPECT_EQ(chosen.score.size(), 6);
  EXPECT_EQ(chosen.score(1), chosen.score.minCoeff());
  refuses({data}, 6, "6 sensors are asked for; 1 to 5 can be chosen; left out");
}

TEST_P(EverySelection, RefusesBadInput) {
  auto const good = random_walks(3, 60, 6);
  refuses({}, 1, "no batch");
  refuses({good}, 0, "0 sensors are asked for; 1 to 6");
  refuses({good}, 7, "7 sensors are asked for; 1 to 6");

  auto bad = good;
  bad.temperature_rise(17, 2) = std::nan("");
  refuses({bad}, 1, "sensor 'T3' has no number in row 18");
  bad = good;
  bad.sensors[2] = "T9";
  refuses({good, bad}, 1, "are not those of batch");
  bad = good;
  bad.temperature_rise.setConstant(2);
  refuses({bad}, 1, "no sensor's readings move");
  refuses({with_sensors(good, {})}, 1, "no sensor's readings move");
  bad = batch_of(good.temperature_rise.topRows(1), good.error.head(1));
  refuses({bad}, 1, "one instant");
}

TEST(ErrorThatStandsStill, IsRefusedWhereItIsLookedAt) {
  auto data = random_walks(3, 60, 6);
  data.error.setConstant(2.5);
  for (Select select : {select_by_correlation, select_forward, select_exhaustive}) try {
      (void)select({{data}}, {});
      ADD_FAILURE();
    } catch (std::invalid_argument const& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("the error is 2.5 µm throughout"));
    }
}

}  // namespace
}  // namespace thermotwin::models
