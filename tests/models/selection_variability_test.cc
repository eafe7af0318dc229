#include "models/selection_variability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/planted_noise.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// The column that the batch's name says.
Selection as_named(std::span<Batch const> batches, SelectionOptions const&) {
  return {{std::stoi(batches.front().name)}, VectorXd::Zero(3), {}};
}

std::vector<Batch> named(std::initializer_list<char const*> names) {
  std::vector<Batch> batches;
  for (auto const* name : names) {
    batches.push_back(batch_of(MatrixXd::Random(4, 3), VectorXd::Zero(4)));
    batches.back().name = name;
  }
  return batches;
}

TEST(SelectionVariability, CountsSwitchesSetsAndShares) {
  SelectionMethod const method{"as_named", "", "", as_named};
  auto const found = selection_variability(method, named({"0", "0", "2", "0", "1"}));
  EXPECT_EQ(found.selections.size(), 5U);
  EXPECT_DOUBLE_EQ(found.switch_frequency, 3.0 / 4);
  EXPECT_EQ(found.different_sets, 3);
  EXPECT_THAT(found.chosen_share, ElementsAre(testing::DoubleEq(0.6), 0.2, 0.2));
  EXPECT_EQ(selection_variability(method, named({"1"})).switch_frequency, 0);
}

Eigen::RowVectorXd const gains{{0.7, 0.9, 1.6, 2.8, 3.1, 4.6, 5.3}};

/// Six runs of a machine with one thermal mode: every sensor reads a multiple of one state, and so does the error.
std::vector<Batch> single_mode() {
  std::vector<Batch> batches;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Noise noise(seed);
    VectorXd const state = (1 + static_cast<double>(seed)) * thermal_state(70, 10, 12, noise);
    batches.push_back(batch_of(state * gains, 3.7 * state));
    batches.back().components = {"a", "a", "a", "b", "b", "c", "c"};
  }
  return batches;
}

TEST(SelectionVariability, NothingSwitchesWithoutNoiseWhereThereIsOneMode) {
  for (auto const& method : selection_methods())
    for (auto const count : {std::optional<int>{}, std::optional<int>{2}}) {
      SelectionOptions options;
      options.count = count;
      options.resolution = 0;
      options.mode_shapes = gains.transpose();
      auto const found = selection_variability(method, single_mode(), options);
      EXPECT_EQ(found.switch_frequency, 0) << method.name;
      EXPECT_EQ(found.different_sets, 1) << method.name;
      for (double const share : found.chosen_share) EXPECT_NEAR(share * (1 - share), 0, 1e-12) << method.name;
    }
}

// Two states, two like sensors each, and a duty that differs from run to run: paper 004's observation.
TEST(SelectionVariability, CollinearSensorsSwitchFromRunToRun) {
  std::vector<Batch> batches;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Noise noise(seed);
    VectorXd const one = thermal_state(80, 8, 10, noise), other = thermal_state(80, 15, 20, noise);
    MatrixXd rise(80, 4);
    rise << one, one, other, other;
    for (double& reading : rise.reshaped()) reading += 0.03 * noise();
    batches.push_back(batch_of(rise, one + other));
  }
  auto const found = selection_variability(selection_method("grey_fuzzy"), batches, {.count = 2});
  EXPECT_GT(found.switch_frequency, 0.3);
  EXPECT_NEAR(found.chosen_share.sum(), 2, 1e-12);
}

TEST(SelectionVariability, RefusesNoBatchesAndOthersSensors) {
  auto const& method = selection_method("grey_relational");
  EXPECT_THAT([&] { selection_variability(method, {}); }, ThrowsMessage<std::invalid_argument>(HasSubstr("no batch")));
  auto batches = named({"first", "second"});
  batches.back().sensors.front() = "other";
  EXPECT_THAT([&] { selection_variability(method, batches); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("batch 'second': its sensors")));
}

}  // namespace
}  // namespace thermotwin::models
