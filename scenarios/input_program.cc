#include "scenarios/input_program.h"

#include "thermal/error.h"

namespace thermotwin::scenarios {

using thermal::InputError;

namespace {

thermal::Quantity value_of(ValueBlock const& block, std::string const& place) {
  try {
    return thermal::parse_quantity(block.value);
  } catch (InputError const& error) {
    throw InputError(place + "value: " + error.what());
  }
}

}  // namespace

DrivenChannel driven_channel(InputProgram const& program, double duration) {
  if (program.channel.empty()) throw InputError("channel: the name of an input channel is due");
  if (program.blocks.empty()) throw InputError("blocks: they are empty; write at least one");
  std::string const place = "blocks";
  thermal::Dimension const dimension = value_of(program.blocks.front(), place + "[0].").dimension;
  std::vector<Block> blocks;
  bool absolute_temperature = false;
  for (ValueBlock const& block : program.blocks) {
    std::string const here = place + "[" + std::to_string(blocks.size()) + "].";
    thermal::Quantity const value = value_of(block, here);
    if (value.dimension != dimension) {
      throw InputError(here + "value: '" + block.value + "' is a " + thermal::name_of(value.dimension) +
                       ", the first block's value a " + thermal::name_of(dimension));
    }
    if (!(block.duration > 0.0)) {
      throw InputError(here + "duration: " + thermal::format_quantity(block.duration, thermal::dimension::time) +
                       " must be above 0 s");
    }
    blocks.push_back({block.duration, value.value});
    absolute_temperature = absolute_temperature || value.absolute_temperature;
  }
  double const last = blocks.back().value;
  return {{program.channel, thermal::unit_of(dimension), "programme"},
          schedule(blocks, 1, last, duration),
          absolute_temperature};
}

}  // namespace thermotwin::scenarios
