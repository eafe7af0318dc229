#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "models/selection.h"
#include "tests/models/planted_noise.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

auto refuses(auto const& inner) { return ThrowsMessage<std::invalid_argument>(inner); }

Batch five_sensors(std::uint64_t seed) {
  Noise noise(seed);
  MatrixXd rise(60, 5);
  for (Index i = 0; i < 5; ++i) rise.col(i) = static_cast<double>(3 + i) * thermal_state(60, 10, 12, noise);
  return batch_of(rise, 2 * rise.col(0) + rise.col(3) + 0.1 * noise.series(60));
}

SelectionOptions options_for_any() {
  SelectionOptions options{.count = 2};
  options.mode_shapes = MatrixXd::Identity(5, 2) + 0.1 * MatrixXd::Ones(5, 2);
  return options;
}

TEST(SelectionMethods, NamesAreUniqueAndFindTheirMethod) {
  std::set<std::string_view> seen;
  for (auto const& method : selection_methods()) {
    EXPECT_TRUE(seen.insert(method.name).second) << method.name;
    EXPECT_EQ(selection_method(method.name).select, method.select);
    EXPECT_FALSE(method.meaning.empty());
    EXPECT_FALSE(method.source.empty());
  }
  for (auto const* name :
       {"ordered_improved", "ordered_ratio", "ordered_slope", "grey_fuzzy", "grey_relational", "mutual_information"})
    EXPECT_EQ(seen.count(name), 1U) << name;
}

TEST(SelectionMethods, UnknownNameIsRefusedWithTheNearestAndAll) {
  EXPECT_THAT([] { selection_method("ordered_ratoi"); },
              refuses(AllOf(HasSubstr("no selection method 'ordered_ratoi'; did you mean 'ordered_ratio'? Known: "),
                            HasSubstr("grey_fuzzy"), HasSubstr("mutual_information"))));
  EXPECT_THAT([] { selection_method("tea"); },
              refuses(AllOf(HasSubstr("no selection method 'tea'; known: "), Not(HasSubstr("did you mean")))));
}

TEST(SelectionMethods, EachGivesAsManyAsAskedAndAScoreForEverySensor) {
  Batch const batch = five_sensors(1);
  for (auto const& method : selection_methods()) {
    auto const chosen = method.select({&batch, 1}, options_for_any());
    EXPECT_EQ(std::set<Index>(chosen.sensors.begin(), chosen.sensors.end()).size(), 2U) << method.name;
    EXPECT_EQ(chosen.score.size(), 5) << method.name;
    EXPECT_TRUE(chosen.score.allFinite()) << method.name;
  }
}

/// With a sensor's course for the error in place of two others', the methods that see it choose otherwise, or by other
/// scores.
TEST(SelectionMethods, EachSaysWhetherItSeesTheError) {
  Batch const batch = five_sensors(1);
  auto other = batch;
  other.error = batch.temperature_rise.col(4).reverse();
  for (auto const& method : selection_methods()) {
    auto const chosen = method.select({&batch, 1}, options_for_any()),
               again = method.select({&other, 1}, options_for_any());
    bool const same = chosen.sensors == again.sensors && chosen.score == again.score;
    EXPECT_EQ(same, !method.sees_error) << method.name;
  }
}

TEST(SelectionMethods, EachNamesASensorThatNeverMoves) {
  Batch batch = five_sensors(2);
  batch.temperature_rise.col(1).setZero();
  for (auto const& method : selection_methods()) {
    auto const chosen = method.select({&batch, 1}, options_for_any());
    EXPECT_EQ(std::count(chosen.sensors.begin(), chosen.sensors.end(), 1), 0) << method.name;
    EXPECT_THAT(chosen.remark, HasSubstr("T2")) << method.name;
  }
}

TEST(SelectionMethods, EachRefusesBadBatches) {
  Batch const good = five_sensors(3);
  Batch holed = good, renamed = good, still = good;
  holed.temperature_rise(7, 2) = std::nan("");
  renamed.name = "other machine";
  renamed.sensors[4] = "T9";
  still.temperature_rise.setZero();
  std::vector<Batch> const different{good, renamed};
  for (auto const& method : selection_methods()) {
    auto const chosen_from = [&](std::span<Batch const> batches) { method.select(batches, options_for_any()); };
    EXPECT_THAT(
        [&] {
          chosen_from({&holed, 1});
        },
        refuses(HasSubstr("sensor 'T3' has no number in row 8")))
        << method.name;
    EXPECT_THAT([&] { chosen_from(different); }, refuses(HasSubstr("batch 'other machine': its sensors")))
        << method.name;
    EXPECT_THAT([&] { chosen_from({&still, 1}); }, refuses(HasSubstr("sensor"))) << method.name;
    EXPECT_THAT([&] { chosen_from({}); }, refuses(HasSubstr("no batch"))) << method.name;
  }
}

}  // namespace
}  // namespace thermotwin::models
