#include "scenarios/sampled.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace thermotwin::scenarios {
namespace {

/// A minute each, with noise in proportion to the value and noise that is always there.
struct Record {
  std::mt19937_64 random{4};
  SampledInput input{.name = "spindle.speed", .unit = "rad/s", .times = {}, .values = {}};

  void add(int samples, double value, double relative, double absolute) {
    std::normal_distribution<double> normal;
    for (int i = 0; i < samples; ++i) {
      input.times.push_back(60.0 * double(input.times.size()));
      input.values.push_back(value * (1.0 + relative * normal(random)) + absolute * normal(random));
    }
  }
};

/// What turns at a hundredth of the highest speed is not at rest: a motor that runs idle has its losses.
TEST(SampledInput, SlowMotionIsNoRest) {
  Record record;
  record.add(30, 500.0, 0.005, 0.0);
  record.add(30, 6.0, 0.005, 0.0);
  record.add(30, 300.0, 0.005, 0.0);
  auto const signal = driven_channel(record.input).signal;
  EXPECT_EQ(signal.jumps(), (std::vector{1800.0, 3600.0}));
  EXPECT_NEAR(signal.at(2700.0), 6.0, 0.02);
}

TEST(SampledInput, NoiseAboutZeroIsRest) {
  Record record;
  record.add(30, 500.0, 0.0, 2.0);
  record.add(30, 0.0, 0.0, 2.0);
  EXPECT_EQ(driven_channel(record.input).signal.at(2700.0), 0.0);
  for (double& value : record.input.values) value = std::abs(value);  // of an encoder without a sign
  EXPECT_EQ(driven_channel(record.input).signal.at(2700.0), 0.0);
}

/// An analogue signal is never quite zero.
TEST(SampledInput, NextToNothingIsRest) {
  Record record;
  record.add(30, 500.0, 0.005, 0.0);
  record.add(30, 0.5, 0.005, 0.0);
  EXPECT_EQ(driven_channel(record.input).signal.at(2700.0), 0.0);
}

}  // namespace
}  // namespace thermotwin::scenarios
