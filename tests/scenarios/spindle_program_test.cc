#include "scenarios/spindle_program.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include "tests/scenarios/refusal.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {
namespace {

using tests::refusal;
using thermal::from_unit;

MachineLimits machine() { return {from_unit(6000, "rpm"), {}}; }

SpindleProgram spectrum(std::vector<SpeedBlock> const& blocks) { return {blocks, 1, {}}; }

TEST(SpindleSpeed, IsGivenOrAShareOfTheMaximum) {
  Signal const speed =
      spindle_speed(spectrum({{60.0, from_unit(4500, "rpm"), {}}, {60.0, {}, 0.25}, {60.0, {}, {}}}), machine(), 240.0);
  EXPECT_DOUBLE_EQ(speed.at(0.0), from_unit(4500, "rpm"));
  EXPECT_DOUBLE_EQ(speed.at(60.0), from_unit(1500, "rpm"));
  EXPECT_EQ(speed.at(120.0), 0.0);
  EXPECT_EQ(speed.at(200.0), 0.0);
}

TEST(SpindleSpeed, StopsAfterItsBlocks) {
  Signal const speed = spindle_speed(spectrum({{60.0, {}, 1.0}}), machine(), 120.0);
  EXPECT_EQ(speed.jumps(), (std::vector<double>{60.0}));
  EXPECT_EQ(speed.at(60.0), 0.0);
}

std::string refused(SpindleProgram const& program, MachineLimits const& limits = machine()) {
  return refusal([&] { spindle_speed(program, limits, 240.0); });
}

TEST(SpindleSpeed, RefusesWhatTheMachineCannotDo) {
  EXPECT_EQ(refused(spectrum({{60.0, {}, 0.5}, {60.0, from_unit(9000, "rpm"), {}}})),
            "spindle.blocks[1].speed: 9000 rpm is above the machine's maximum, 6000 rpm");
  EXPECT_EQ(refused(spectrum({{60.0, {}, 1.5}})), "spindle.blocks[0].of_maximum: 1.5 must be from 0 to 1");
  EXPECT_EQ(refused(spectrum({{60.0, {}, 0.5}}), MachineLimits{}),
            "spindle.blocks[0].speed: the machine has no spindle");
  EXPECT_EQ(refused(spectrum({{60.0, {}, {}}}), MachineLimits{}), "accepted");
}

TEST(SpindleSpeed, RefusesBlocksThatCannotBe) {
  EXPECT_EQ(refused(spectrum({{-5.0, {}, 0.5}})), "spindle.blocks[0].duration: -5 s must be above 0 s");
  EXPECT_EQ(refused(spectrum({{60.0, from_unit(-100, "rpm"), {}}})), "spindle.blocks[0].speed: -100 rpm is negative");
  EXPECT_EQ(refused(spectrum({{60.0, 10.0, 0.5}})),
            "spindle.blocks[0].speed: give either speed or of_maximum, not both");
  EXPECT_EQ(refused({{{60.0, {}, 0.5}}, 0, {}}), "spindle.cycles: 0 must be 1 or more");
}

TEST(SpindleSpeed, RefusesAnEmptySpectrum) {
  EXPECT_EQ(refused({}),
            "spindle: the spectrum is empty; write blocks, for example blocks = [{duration = \"30 min\", speed = "
            "\"2000 rpm\"}], or leave [spindle] out");
  EXPECT_EQ(refused({{{60.0, {}, 0.5}}, 1, RandomSpectrum{}}), "spindle: give either blocks or random, not both");
}

TEST(RandomSpectrum, FillsItsRunWithBlocksInRange) {
  for (int seed = 0; seed < 50; ++seed) {
    RandomSpectrum spectrum;
    spectrum.seed = seed;
    double total = 0.0;
    std::vector<SpeedBlock> const blocks = random_blocks(spectrum);
    for (SpeedBlock const& block : blocks) {
      total += block.duration;
      EXPECT_LE(block.duration, 1800.0);
      EXPECT_GE(*block.of_maximum, 0.0);
      EXPECT_LT(*block.of_maximum, 1.0);
    }
    EXPECT_EQ(total, 14400.0);
    EXPECT_TRUE(std::all_of(blocks.begin(), blocks.end() - 1, [](SpeedBlock const& b) { return b.duration >= 300.0; }));
  }
}

TEST(RandomSpectrum, DrawsEvenly) {
  RandomSpectrum spectrum;
  spectrum.run = 1e7;
  std::vector<SpeedBlock> const blocks = random_blocks(spectrum);
  double duration = 0.0;
  double share = 0.0;
  double square = 0.0;
  for (SpeedBlock const& block : blocks) {
    duration += block.duration;
    share += *block.of_maximum;
    square += *block.of_maximum * *block.of_maximum;
  }
  auto const n = static_cast<double>(blocks.size());
  EXPECT_NEAR(duration / n, 1050.0, 4.0 * 433.0 / std::sqrt(n));
  EXPECT_NEAR(share / n, 0.5, 4.0 * 0.289 / std::sqrt(n));
  EXPECT_NEAR(square / n, 1.0 / 3.0, 4.0 * 0.298 / std::sqrt(n));
}

std::uint64_t hash(std::vector<SpeedBlock> const& blocks) {
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a over the numbers' bits
  for (SpeedBlock const& block : blocks) {
    for (double const number : {block.duration, *block.of_maximum}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 1099511628211U;
    }
  }
  return hash;
}

TEST(RandomSpectrum, IsTheSameForTheSameSeedWithEveryCompiler) {
  RandomSpectrum spectrum;
  EXPECT_EQ(hash(random_blocks(spectrum)), 15111935494073022022U);
  spectrum.seed = 2;
  EXPECT_EQ(hash(random_blocks(spectrum)), 10211588183182379517U);
}

TEST(RandomSpectrum, RefusesRangesThatAreNone) {
  auto const refused_random = [](RandomSpectrum const& spectrum) { return refusal([&] { random_blocks(spectrum); }); };
  RandomSpectrum spectrum;
  spectrum.longest = 60.0;
  EXPECT_EQ(refused_random(spectrum), "spindle.random.longest: 1 min is below shortest, 5 min");
  spectrum = {};
  spectrum.shortest = 0.0;
  EXPECT_EQ(refused_random(spectrum), "spindle.random.shortest: 0 min must be 1 s or more");
  spectrum = {};
  spectrum.highest = 1.2;
  EXPECT_EQ(refused_random(spectrum), "spindle.random.highest: 1.2 must be from 0 to 1");
  spectrum = {};
  spectrum.lowest = -0.1;
  EXPECT_EQ(refused_random(spectrum), "spindle.random.lowest: -0.1 must be from 0 to 1");
  spectrum.lowest = 0.8;
  spectrum.highest = 0.2;
  EXPECT_EQ(refused_random(spectrum), "spindle.random.highest: 0.2 is below lowest, 0.8");
  spectrum = {};
  spectrum.run = 0.0;
  EXPECT_EQ(refused_random(spectrum), "spindle.random.run: 0 min must be above 0 s");
  spectrum = {};
  spectrum.seed = -1;
  EXPECT_EQ(refused_random(spectrum), "spindle.random.seed: -1 must be 0 or more");
}

}  // namespace
}  // namespace thermotwin::scenarios
