#include "scenarios/switching.h"

#include "thermal/error.h"

namespace thermotwin::scenarios {

Signal switching(std::vector<SwitchBlock> const& blocks, bool afterwards, double duration, std::string const& name) {
  std::vector<Block> states;
  for (SwitchBlock const& block : blocks) {
    if (!(block.duration > 0.0)) {
      throw thermal::InputError(name + ".blocks[" + std::to_string(states.size()) +
                                "].duration: " + thermal::format_quantity(block.duration, thermal::dimension::time) +
                                " must be above 0 s");
    }
    states.push_back({block.duration, block.on ? 1.0 : 0.0});
  }
  return schedule(states, 1, afterwards ? 1.0 : 0.0, duration);
}

}  // namespace thermotwin::scenarios
