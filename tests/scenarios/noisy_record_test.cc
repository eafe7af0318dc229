#include "scenarios/noisy_record.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace thermotwin::scenarios {
namespace {

using Values = std::vector<double>;

Values minutes(std::size_t count) {
  Values times(count);
  for (std::size_t i = 0; i < count; ++i) times[i] = 60.0 * double(i);
  return times;
}

TEST(NoisyRecord, ComesBackAsItIsWithoutNoise) {
  auto const times = minutes(1441);
  Values room(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) room[i] = 294.15 + 1.5 * std::sin(2.0 * M_PI * times[i] / 86400.0);
  EXPECT_EQ(without_noise(times, room), room);
  EXPECT_EQ(without_noise(times, Values(times.size(), 294.15)), Values(times.size(), 294.15));
  EXPECT_EQ(without_noise({0.0, 60.0}, {1.0, 2.0}), (Values{1.0, 2.0}));
}

/// What is left of the noise r of a random walk of steps q is r/√(1 + 4 r/q): the best that any smoother reaches far
/// from the ends (Wiener; the integral of q r/(q + r |1 − e^{iω}|²) over ω/2π).
class NoisyRecordOf : public testing::TestWithParam<double> {};

TEST_P(NoisyRecordOf, ARandomWalkLosesAsMuchNoiseAsCanBeLost) {
  constexpr double noise = 0.1;
  double const step = GetParam();
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  auto const times = minutes(20000);
  Values truth(times.size(), 294.15), record(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0) truth[i] = truth[i - 1] + step * normal(random);
    record[i] = truth[i] + noise * normal(random);
  }
  auto const smooth = without_noise(times, record);
  double square = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) square += std::pow(smooth[i] - truth[i], 2);
  double const ratio = std::pow(noise / step, 2);
  double const best = noise * noise / std::sqrt(1.0 + 4.0 * ratio);
  EXPECT_NEAR(square / double(times.size()) / best, 1.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Steps, NoisyRecordOf, testing::Values(0.002, 0.01, 0.05, 0.2));

/// A row that is an hour away says as little as one an hour before.
TEST(NoisyRecord, KnowsHowFarRowsAreApart) {
  Values times = minutes(2000), record(2000);
  for (std::size_t i = 1000; i < times.size(); ++i) times[i] += 1e6;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < times.size(); ++i) record[i] = (i < 1000 ? 290.0 : 300.0) + 0.1 * normal(random);
  auto const smooth = without_noise(times, record);
  EXPECT_NEAR(smooth[999], 290.0, 0.1);
  EXPECT_NEAR(smooth[1000], 300.0, 0.1);
}

}  // namespace
}  // namespace thermotwin::scenarios
