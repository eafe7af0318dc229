#pragma once

#include <optional>
#include <vector>

#include "scenarios/field.h"
#include "scenarios/machine_limits.h"
#include "scenarios/signal.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {

/// One speed held for a while. Without `speed` and `of_maximum` the spindle stands still.
struct SpeedBlock {
  double duration = required;        ///< [s] > 0
  std::optional<double> speed;       ///< [rad/s], 0 to the machine's maximum
  std::optional<double> of_maximum;  ///< share of the machine's maximum, 0 to 1

  template <class Fields>
  static void fields(Fields& f) {
    f("duration", &SpeedBlock::duration, thermal::dimension::time, "how long the speed is held", {0.0, unbounded});
    f("speed", &SpeedBlock::speed, thermal::dimension::angular_speed, "spindle speed; without any speed: standstill",
      {0.0, unbounded});
    f("of_maximum", &SpeedBlock::of_maximum, thermal::dimension::dimensionless,
      "share of the machine's maximum speed, instead of speed", {0.0, 1.0});
  }
};

/// Speeds and their durations drawn evenly from a range; the same seed draws the same spectrum with every compiler.
struct RandomSpectrum {
  double run = 240 * 60.0;     ///< length of the spectrum [s]; afterwards standstill
  double shortest = 5 * 60.0;  ///< block [s]
  double longest = 30 * 60.0;  ///< block [s]
  double lowest = 0.0;         ///< share of the maximum speed
  double highest = 1.0;        ///< share of the maximum speed
  int seed = 1;                ///< >= 0

  template <class Fields>
  static void fields(Fields& f) {
    f("run", &RandomSpectrum::run, thermal::dimension::time, "length of the spectrum; afterwards standstill",
      {0.0, unbounded});
    f("shortest", &RandomSpectrum::shortest, thermal::dimension::time, "shortest block", {0.0, unbounded});
    f("longest", &RandomSpectrum::longest, thermal::dimension::time, "longest block", {0.0, unbounded});
    f("lowest", &RandomSpectrum::lowest, thermal::dimension::dimensionless, "lowest share of the maximum speed",
      {0.0, 1.0});
    f("highest", &RandomSpectrum::highest, thermal::dimension::dimensionless, "highest share of the maximum speed",
      {0.0, 1.0});
    f("seed", &RandomSpectrum::seed, "the same seed draws the same spectrum");
  }
};

/// The spindle's speed over time: blocks one after another, or a random spectrum; then standstill.
struct SpindleProgram {
  std::vector<SpeedBlock> blocks;
  int cycles = 1;  ///< how often the blocks are run through
  std::optional<RandomSpectrum> random;

  template <class Fields>
  static void fields(Fields& f) {
    f("blocks", &SpindleProgram::blocks, "speeds one after another; afterwards standstill");
    f("cycles", &SpindleProgram::cycles, "how often the blocks are run through");
    f("random", &SpindleProgram::random, "a random spectrum instead of blocks");
  }
};

/// Blocks of whole seconds and even shares of the maximum, from the raw bits of a 64-bit Mersenne twister (std's
/// distributions differ between libraries).
std::vector<SpeedBlock> random_blocks(RandomSpectrum const& spectrum);

/// Spindle speed [rad/s] from 0 to `duration` [s]. Throws InputError naming the block.
Signal spindle_speed(SpindleProgram const& program, MachineLimits const& machine, double duration);

}  // namespace thermotwin::scenarios
