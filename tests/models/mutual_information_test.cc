#include "models/mutual_information.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/planted_noise.h"

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(MutualInformation, OfFourCellsIsWhatTheSumSays) {
  VectorXd const x = (VectorXd(8) << 0, 0, 0, 0, 1, 1, 1, 1).finished();
  VectorXd const y = (VectorXd(8) << 0, 0, 0, 1, 0, 1, 1, 1).finished();
  double const by_hand = 0.75 * std::log(1.5) - 0.25 * std::log(2.0);

  auto const plug_in = mutual_information(x, y, {.bins = 2, .bias = BiasCorrection::none});
  EXPECT_NEAR(plug_in.value, by_hand, 1e-14);
  EXPECT_NEAR(plug_in.normalised, by_hand / std::log(2.0), 1e-14);
  EXPECT_FALSE(plug_in.saturated);
  auto const miller_madow = mutual_information(x, y, {.bins = 2, .bias = BiasCorrection::miller_madow});
  EXPECT_NEAR(miller_madow.value, by_hand - 1.0 / 16, 1e-14);
  EXPECT_NEAR(miller_madow.plug_in, by_hand, 1e-14);
}

TEST(MutualInformation, BinsFollowTheRuleAsked) {
  VectorXd const x = VectorXd::LinSpaced(100, 0, 99), y = x.array().square();
  auto const bins = [&](BinCount count) { return mutual_information(x, y, {.count = count, .permutations = 0}); };

  EXPECT_EQ(bins(BinCount::sturges).bins_x, 8);
  EXPECT_EQ(bins(BinCount::square_root).bins_x, 10);
  EXPECT_EQ(bins(BinCount::cellucci).bins_x, 4);
  EXPECT_EQ(bins(BinCount::freedman_diaconis).bins_x, 5);  // 99 / (2 · 49.5 · 100^(−1/3)) = 4.64
  EXPECT_EQ(bins(BinCount::freedman_diaconis).bins_y, 5);  // 9801 / (2 · (74.25² − 24.75²) / 4.64) = 4.64
  EXPECT_EQ(mutual_information(x.head(8), y.head(8)).bins_x, 2);
}

// Warning 1 of methods.md §3.2: ranks of monotone records are the same, whatever the sensor.
TEST(MutualInformation, EqualFrequencyBinsAreBlindToMonotoneRecordsAndSaySo) {
  VectorXd const t = VectorXd::LinSpaced(60, 0, 59);
  VectorXd const error = 1 - (-t.array() / 20).exp(), slow = t.array().square(), falling = -t.array().sqrt();
  MutualInformationOptions const ranks{.edges = BinEdges::equal_frequency, .bins = 5, .bias = BiasCorrection::none};
  for (auto const& sensor : {slow, falling, error}) {
    auto const found = mutual_information(sensor, error, ranks);
    EXPECT_NEAR(found.plug_in, std::log(5.0), 1e-12);
    EXPECT_TRUE(found.saturated);
  }
  MutualInformationOptions const widths{.bins = 5, .bias = BiasCorrection::none};
  EXPECT_FALSE(mutual_information(slow, error, widths).saturated);
  EXPECT_LT(mutual_information(slow, error, widths).value, mutual_information(error, error, widths).value - 0.2);
}

// Warning 2 of methods.md §3.2: what independent data seem to tell.
TEST(MutualInformation, PlugInOfIndependentDataIsFarFromZeroAndTheShuffleNullTakesItAway) {
  struct Case {
    Index samples;
    int bins;
    double plug_in;
  };
  for (auto const [samples, bins, plug_in] : {Case{11, 3, 0.27}, {11, 5, 0.92}, {11, 8, 1.66}, {150, 5, 0.055}}) {
    double counted = 0, corrected = 0;
    constexpr int repeats = 200;
    for (std::uint64_t seed = 0; seed < repeats; ++seed) {
      Noise noise(seed);
      VectorXd const x = noise.series(samples), y = noise.series(samples);
      auto const found = mutual_information(x, y, {.edges = BinEdges::equal_frequency, .bins = bins, .seed = seed});
      counted += found.plug_in / repeats;
      corrected += found.value / repeats;
    }
    EXPECT_NEAR(counted, plug_in, 0.03);
    EXPECT_NEAR(corrected, 0, 0.02);
  }
}

TEST(MutualInformation, IndependentSensorIsNotSignificantInNineOfTenWorlds) {
  VectorXd const error = 1 - (-VectorXd::LinSpaced(80, 0, 79).array() / 25).exp();
  int not_significant = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    if (mutual_information(Noise(seed).series(80), error, {.seed = seed}).p_value > 0.05) ++not_significant;
  EXPECT_GE(not_significant, 180);
  EXPECT_LT(not_significant, 200);  // five in a hundred are, by the meaning of p
}

TEST(MutualInformation, BlocksKeepThePValueHonestUnderAutocorrelation) {
  int by_samples = 0, by_blocks = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Noise noise(seed);
    VectorXd const x = autoregressive(200, 0.9, noise), y = autoregressive(200, 0.9, noise);
    if (mutual_information(x, y, {.seed = seed}).p_value > 0.05) ++by_samples;
    if (mutual_information(x, y, {.block = 20, .seed = seed}).p_value > 0.05) ++by_blocks;
  }
  EXPECT_LT(by_samples, 70);
  EXPECT_GE(by_blocks, 90);
}

TEST(MutualInformation, DependentSensorIsSignificantByBlocksToo) {
  Noise noise(3);
  VectorXd const y = autoregressive(200, 0.9, noise), x = y + noise.series(200);
  EXPECT_LE(mutual_information(x, y, {.block = 20}).p_value, 0.01);
}

TEST(MutualInformation, SameSeedSameNumbers) {
  Noise noise(1);
  VectorXd const x = noise.series(50), y = x + noise.series(50);
  EXPECT_EQ(mutual_information(x, y, {.seed = 7}).value, mutual_information(x, y, {.seed = 7}).value);
  EXPECT_NE(mutual_information(x, y, {.seed = 7}).value, mutual_information(x, y, {.seed = 8}).value);
}

TEST(MutualInformation, NearestNeighboursFindTheGaussianClosedForm) {
  for (double const correlation : {0.0, 0.5, 0.9}) {
    double mean = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Noise noise(seed);
      VectorXd const x = noise.series(400);
      VectorXd const y = correlation * x + std::sqrt(1 - correlation * correlation) * noise.series(400);
      mean += nearest_neighbour_information(x, y) / 20;
    }
    EXPECT_NEAR(mean, -0.5 * std::log(1 - correlation * correlation), 0.04);
  }
}

TEST(MutualInformation, NearestNeighboursTakeReadingsInSteps) {
  Noise noise(5);
  VectorXd const x = noise.series(400), y = x + 0.5 * noise.series(400);
  VectorXd const steps = (x.array() * 4).round() / 4;
  double const information = nearest_neighbour_information(steps, y);
  EXPECT_NEAR(information, nearest_neighbour_information(x, y), 0.1);
  EXPECT_NEAR(nearest_neighbour_information(1000 * steps, 0.001 * y), information, 1e-6);
}

TEST(MutualInformation, WhatNeverMovesTellsNothing) {
  VectorXd const still = VectorXd::Constant(20, 0.3), y = VectorXd::LinSpaced(20, 0, 1);
  EXPECT_EQ(mutual_information(still, y).value, 0);
  EXPECT_EQ(mutual_information(still, y).p_value, 1);
  EXPECT_EQ(nearest_neighbour_information(still, y), 0);
}

TEST(MutualInformation, RefusesWhatItCannotAnswer) {
  VectorXd const x = VectorXd::LinSpaced(20, 0, 1);
  VectorXd holed = x;
  holed(4) = std::nan("");
  auto const says = [](char const* text) { return ThrowsMessage<std::invalid_argument>(HasSubstr(text)); };
  EXPECT_THAT([&] { mutual_information(x, x.head(19)); }, says("20 and 19 samples"));
  EXPECT_THAT([&] { mutual_information(x.head(3), x.head(3)); }, says("3 samples: at least 4"));
  EXPECT_THAT([&] { mutual_information(holed, x); }, says("no number"));
  EXPECT_THAT([&] { mutual_information(x, x, {.bins = 1}); }, says("1 bins: at least 2"));
  EXPECT_THAT([&] { mutual_information(x, x, {.block = 0}); }, says("blocks of 0 samples: at least 1"));
  EXPECT_THAT([&] { nearest_neighbour_information(x, x, 20); }, says("20 neighbours among 20 samples"));
}

}  // namespace
}  // namespace thermotwin::models
