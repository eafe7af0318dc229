#include "twin/diagnosis/observed_noise.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/expected_noise.h"

namespace thermotwin::twin {
namespace {

/// The right machine, and one sensor that wanders by 6 % of what it goes through: only its noise is heard to be more.
TEST(ObservedNoise, IsThatOfTheChannelWhichWanders) {
  auto run = tests::measured(tests::v450(), tests::two_speeds());
  tests::add_noise(run, 0.03, 0.2e-6, 3);
  auto const hours = [&](Eigen::Index i) { return run.time[i] / 3600.0; };
  for (auto& channel : run.channels)
    if (channel.name == "T3") {
      double const range = channel.values.maxCoeff() - channel.values.minCoeff();
      for (Eigen::Index i = 0; i < channel.values.size(); ++i)
        channel.values[i] += 0.06 * range * std::sin(2.0 * std::numbers::pi * hours(i) / 2.5);
    }
  std::vector<BinnedRun> const data = {bin(run, 300.0)};
  Estimation const estimation = expected_estimation(tests::v450(), data);
  auto const& expected = estimation.noise();
  auto const heard = observed_noise(estimation, estimation.fit(estimation.prior_mean()).x, expected);
  for (std::size_t c = 0; c < heard.size(); ++c) {
    double const times = heard[c].slow_share / expected[c].slow_share;
    if (estimation.channels()[c] == "T3")
      EXPECT_GE(times, 4.0);
    else
      EXPECT_EQ(times, 1.0) << estimation.channels()[c];
    EXPECT_EQ(heard[c].fast, expected[c].fast) << estimation.channels()[c];
  }
}

}  // namespace
}  // namespace thermotwin::twin
