#include "twin/instruments/random_stream.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace thermotwin::twin {
namespace {

constexpr int many = 200'000;

double correlation(RandomStream a, RandomStream b) {
  double sum = 0.0;
  for (int i = 0; i < many; ++i) sum += a.normal() * b.normal();
  return sum / many;
}

// Computed by an independent program from the formula in the header.
TEST(RandomStream, YieldsTheSameBitsEverywhere) {
  RandomStream stream(1, "T1/noise");
  for (double const expected : {0x1555bf70fc27f4p0, 0x1a07eb1dd0ae19p0, 0xd14f033fd57e8p0})
    EXPECT_EQ(stream.uniform() * 0x1p53, expected);
}

TEST(RandomStream, IsEven) {
  RandomStream stream(7, "even");
  std::vector<int> counts(64, 0);
  for (int i = 0; i < many; ++i) ++counts[static_cast<std::size_t>(64.0 * stream.uniform())];
  double chi_squared = 0.0;
  double const expected = many / 64.0;
  for (int const count : counts) chi_squared += (count - expected) * (count - expected) / expected;
  EXPECT_GT(chi_squared, 63.0 - 4.0 * std::sqrt(2.0 * 63.0));
  EXPECT_LT(chi_squared, 63.0 + 4.0 * std::sqrt(2.0 * 63.0));
}

TEST(RandomStream, HasTheMomentsOfANormalDistribution) {
  RandomStream stream(7, "normal");
  double mean = 0.0, square = 0.0, cube = 0.0, fourth = 0.0;
  for (int i = 0; i < many; ++i) {
    double const x = stream.normal();
    mean += x / many;
    square += x * x / many;
    cube += x * x * x / many;
    fourth += x * x * x * x / many;
  }
  double const error = 4.0 / std::sqrt(many);
  EXPECT_NEAR(mean, 0.0, error);
  EXPECT_NEAR(square, 1.0, error * std::sqrt(2.0));
  EXPECT_NEAR(cube, 0.0, error * std::sqrt(15.0));
  EXPECT_NEAR(fourth, 3.0, error * std::sqrt(96.0));
}

TEST(RandomStream, IsUncorrelatedAcrossNamesAndSeeds) {
  double const error = 4.0 / std::sqrt(many);
  EXPECT_NEAR(correlation({1, "T1"}, {1, "T2"}), 0.0, error);
  EXPECT_NEAR(correlation({1, "T1"}, {1, "T1/noise"}), 0.0, error);
  EXPECT_NEAR(correlation({1, "T1"}, {2, "T1"}), 0.0, error);
  EXPECT_NEAR(correlation({1, "T1"}, {1, "T1"}), 1.0, 2.0 * error);
}

TEST(RandomStream, KeepsWithinTheLimitOfAMaker) {
  RandomStream stream(3, "limit");
  double largest = 0.0, square = 0.0;
  for (int i = 0; i < many; ++i) {
    double const x = stream.within(0.5, 1.0);
    largest = std::max(largest, std::abs(x));
    square += x * x / many;
  }
  EXPECT_LE(largest, 1.0);
  EXPECT_GT(largest, 0.999);
  // Normal cut at two deviations: variance 1 − 2 · 2 φ(2)/(2 Φ(2) − 1) = 0.7737.
  EXPECT_NEAR(square, 0.25 * 0.7737, 0.002);
}

TEST(RandomStream, DrawsEvenlyInTheLogarithm) {
  RandomStream stream(3, "logarithm");
  double mean = 0.0;
  for (int i = 0; i < many; ++i) mean += std::log(stream.log_uniform(5.0, 15.0)) / many;
  EXPECT_NEAR(mean, 0.5 * std::log(5.0 * 15.0), 0.003);
  EXPECT_EQ(stream.log_uniform(2.0, 2.0), 2.0);
}

}  // namespace
}  // namespace thermotwin::twin
