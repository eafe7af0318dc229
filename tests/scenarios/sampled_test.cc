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

SampledInput programme(std::vector<double> const& times, std::vector<double> const& values) {
  return {.name = "spindle.speed", .unit = "rad/s", .times = times, .values = values};
}

void expect_word_for_word(SampledInput const& input) {
  auto const signal = driven_channel(input).signal;
  for (std::size_t i = 0; i < input.times.size(); ++i) {
    EXPECT_DOUBLE_EQ(signal.at(input.times[i]), input.values[i]) << i;
    EXPECT_DOUBLE_EQ(signal.at(input.times[i] + 59.0), input.values[i]) << i;
  }
}

/// Written down where it changes: what neighbours differ by is no noise.
TEST(SampledInput, AListOfChangesIsTakenAtItsWord) {
  expect_word_for_word(programme({0, 600, 9840, 15360, 16560, 19660, 20740, 22100, 25100, 26340, 36640},
                                 {0, 235, 471, 235, 306, 0, 306, 94, 306, 165, 0}));
}

/// Rows at regular times stand between those of changes. Half of the steps are 6 or none, and yet 475 is not 500.
TEST(SampledInput, AListOfChangesMayRepeatItsRows) {
  std::vector<double> times, values;
  for (int cycle = 0; cycle < 20; ++cycle)
    for (double const value : {100.0, 100.0, 106.0, 106.0, 500.0, 500.0, 475.0}) {
      times.push_back(100.0 * double(times.size()));
      values.push_back(value);
    }
  expect_word_for_word(programme(times, values));
}

/// An override, written down as the controller ramps: two rows each, a minute apart. Steps of 4 to 10 % are no noise
/// then.
TEST(SampledInput, AListOfSmallChangesIsTakenAtItsWord) {
  std::vector<double> times = {0.0}, values = {0.0};
  for (double const speed : {280.0, 266.0, 252.0, 266.0, 280.0, 140.0, 0.0, 252.0, 266.0, 280.0, 294.0, 280.0, 0.0}) {
    times.insert(times.end(), {times.back() + 700.0, times.back() + 766.0});
    values.insert(values.end(), {0.5 * (values.back() + speed), speed});
  }
  expect_word_for_word(programme(times, values));
}

TEST(SampledInput, AStaircaseIsTakenAtItsWord) {
  std::vector<double> times, values;
  for (int i = 0; i < 25; ++i) {
    times.push_back(1200.0 * i);
    values.push_back(20.0 * i);
  }
  expect_word_for_word(programme(times, values));
}

/// Where a file states how its samples are joined, noise is no noise.
TEST(SampledInput, IsTakenAtItsWordWhereItIsStated) {
  Record record;
  record.add(60, 300.0, 0.0, 3.0);
  EXPECT_TRUE(driven_channel(record.input).signal.jumps().empty());
  record.input.interpolation = "step";
  expect_word_for_word(record.input);
  EXPECT_FALSE(held_changes(record.input)->averaged);
  EXPECT_EQ(held_changes(record.input)->count, 59);
  record.input.name = "ambient.temperature";
  record.input.unit = "K";
  record.input.interpolation = "linear";
  EXPECT_EQ(driven_channel(record.input).signal.values(), record.input.values);
}

/// A log in kelvin is a log of temperatures.
TEST(SampledInput, TemperaturesAreSmoothedWhateverTheirUnit) {
  Record record;
  record.add(120, 295.0, 0.0, 0.05);
  record.input.name = "ambient.temperature";
  record.input.unit = "K";
  Signal const kelvin = driven_channel(record.input).signal;
  record.input.absolute_temperature = true;
  Signal const celsius = driven_channel(record.input).signal;
  double rough = 0.0;
  for (std::size_t i = 0; i < record.input.times.size(); ++i) {
    EXPECT_EQ(kelvin.at(record.input.times[i]), celsius.at(record.input.times[i]));
    rough = std::max(rough, std::abs(kelvin.at(record.input.times[i]) - 295.0));
  }
  EXPECT_LT(rough, 0.05);
}

/// Of 3 % of the largest, as of a motor's load.
TEST(SampledInput, CoarseNoiseIsStillNoise) {
  Record record;
  record.add(60, 300.0, 0.0, 9.0);
  record.add(60, 100.0, 0.0, 9.0);
  auto const signal = driven_channel(record.input).signal;
  EXPECT_EQ(signal.jumps(), (std::vector{3600.0}));
  EXPECT_NEAR(signal.at(1800.0), 300.0, 5.0);
  EXPECT_NEAR(signal.at(5400.0), 100.0, 5.0);
}

/// As they are read: a list by its rows, a noisy record by its blocks, a temperature along straight lines.
TEST(SampledInput, IsToldToChangeAsItIsRead) {
  auto const list = held_changes(programme({0, 600, 9840, 15360, 16560, 19660}, {0, 235, 235, 471, 235, 306}));
  ASSERT_TRUE(list);
  EXPECT_EQ(list->count, 4);
  EXPECT_FALSE(list->averaged);
  Record record;
  record.add(60, 300.0, 0.0, 9.0);
  record.add(60, 100.0, 0.0, 9.0);
  auto const noisy = held_changes(record.input);
  ASSERT_TRUE(noisy);
  EXPECT_EQ(noisy->count, 1);
  EXPECT_TRUE(noisy->averaged);
  record.input.name = "ambient.temperature";
  record.input.unit = "K";
  EXPECT_FALSE(held_changes(record.input));
  EXPECT_FALSE(held_changes(programme({0, 600}, {std::nan(""), std::nan("")})));
}

}  // namespace
}  // namespace thermotwin::scenarios
