#include "models/selection_variability.h"

#include <gtest/gtest.h>
#include <span>
#include <string_view>

#include "models/selection.h"
#include "tests/models/planted_noise.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What a method chooses from each batch by itself.
std::vector<std::vector<Index>> chosen_from_each(std::string_view method, std::vector<Batch> const& batches,
                                                 SelectionOptions const& options) {
  std::vector<std::vector<Index>> sets;
  for (auto const& batch : batches)
    sets.push_back(selection_method(method).select(std::span(&batch, 1), options).sensors);
  return sets;
}

TEST(SelectionVariability, IsTheShareOfSetsThatAreNotTheOneBefore) {
  std::vector<std::vector<Index>> const sets = {{0}, {0}, {2, 1}, {1, 2}, {0}, {1}};
  EXPECT_EQ(switch_share(sets), 3.0 / 5.0);
  EXPECT_EQ(switch_share(std::span(sets).first(2)), 0.0);
  EXPECT_EQ(switch_share(std::span(sets).first(1)), std::nullopt);
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
      EXPECT_EQ(switch_share(chosen_from_each(method.name, single_mode(), options)), 0.0) << method.name;
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
  SelectionOptions options;
  options.count = 2;
  EXPECT_GT(switch_share(chosen_from_each("grey_fuzzy", batches, options)), 0.3);
}

}  // namespace
}  // namespace thermotwin::models
