#include "scenarios/spindle_program.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "thermal/error.h"

namespace thermotwin::scenarios {
namespace {

using thermal::format_quantity;
using thermal::InputError;
namespace dimension = thermal::dimension;

double even(std::mt19937_64& bits, double low, double high) {
  double const share = static_cast<double>(bits() >> 11U) * 0x1.0p-53;
  return low + share * (high - low);
}

void check_share(double share, std::string const& place) {
  if (!(share >= 0.0 && share <= 1.0)) throw InputError(place + thermal::format_number(share) + " must be from 0 to 1");
}

void check(RandomSpectrum const& s) {
  std::string const place = "spindle.random.";
  if (!(s.run > 0.0))
    throw InputError(place + "run: " + format_quantity(s.run, dimension::time) + " must be above 0 s");
  if (s.shortest < 1.0) {
    throw InputError(place + "shortest: " + format_quantity(s.shortest, dimension::time) + " must be 1 s or more");
  }
  if (s.longest < s.shortest) {
    throw InputError(place + "longest: " + format_quantity(s.longest, dimension::time) + " is below shortest, " +
                     format_quantity(s.shortest, dimension::time));
  }
  check_share(s.lowest, place + "lowest: ");
  check_share(s.highest, place + "highest: ");
  if (s.highest < s.lowest) {
    throw InputError(place + "highest: " + thermal::format_number(s.highest) + " is below lowest, " +
                     thermal::format_number(s.lowest));
  }
  if (s.seed < 0) throw InputError(place + "seed: " + std::to_string(s.seed) + " must be 0 or more");
}

double speed_of(SpeedBlock const& block, MachineLimits const& machine, std::string const& place) {
  if (!(block.duration > 0.0)) {
    throw InputError(place + "duration: " + format_quantity(block.duration, dimension::time) + " must be above 0 s");
  }
  if (block.speed && block.of_maximum) throw InputError(place + "speed: give either speed or of_maximum, not both");
  double const share = block.of_maximum.value_or(0.0);
  check_share(share, place + "of_maximum: ");
  double const speed = block.speed.value_or(share * machine.max_spindle_speed);
  if (speed < 0.0)
    throw InputError(place + "speed: " + format_quantity(speed, dimension::angular_speed) + " is negative");
  if ((speed > 0.0 || share > 0.0) && machine.max_spindle_speed <= 0.0)
    throw InputError(place + "speed: the machine has no spindle");
  if (speed > machine.max_spindle_speed) {
    throw InputError(place + "speed: " + format_quantity(speed, dimension::angular_speed) +
                     " is above the machine's maximum, " +
                     format_quantity(machine.max_spindle_speed, dimension::angular_speed));
  }
  return speed;
}

}  // namespace

std::vector<SpeedBlock> random_blocks(RandomSpectrum const& spectrum) {
  check(spectrum);
  std::mt19937_64 bits(static_cast<std::uint64_t>(spectrum.seed));
  std::vector<SpeedBlock> blocks;
  for (double t = 0.0; t < spectrum.run; t += blocks.back().duration) {
    SpeedBlock block;
    block.duration = std::min(std::round(even(bits, spectrum.shortest, spectrum.longest)), spectrum.run - t);
    block.of_maximum = even(bits, spectrum.lowest, spectrum.highest);
    blocks.push_back(block);
  }
  return blocks;
}

Signal spindle_speed(SpindleProgram const& program, MachineLimits const& machine, double duration) {
  if (program.random && !program.blocks.empty()) throw InputError("spindle: give either blocks or random, not both");
  if (program.cycles < 1) throw InputError("spindle.cycles: " + std::to_string(program.cycles) + " must be 1 or more");
  std::vector<SpeedBlock> const speeds = program.random ? random_blocks(*program.random) : program.blocks;
  if (speeds.empty()) {
    throw InputError(
        "spindle: the spectrum is empty; write blocks, for example blocks = [{duration = \"30 min\", speed = "
        "\"2000 rpm\"}], or leave [spindle] out");
  }
  std::vector<Block> blocks;
  for (SpeedBlock const& block : speeds) {
    std::string const place = "spindle.blocks[" + std::to_string(blocks.size()) + "].";
    blocks.push_back({block.duration, speed_of(block, machine, place)});
  }
  return schedule(blocks, program.cycles, 0.0, duration);
}

}  // namespace thermotwin::scenarios
