#pragma once

#include <string>
#include <vector>

#include "twin/machine.h"

namespace thermotwin::twin {

/// What a structural loop leaves out: a file lists the steps from the table to the tool, but castings also bend and
/// shift each other. So every displacement may follow the mean temperature of every solid by a share x of the solid's
/// free growth, x α L (T − T(0)), L its longest edge; a rotation by x α (T − T(0)).
/// Not where a step of the loop has the weight 0: that file knows of none what it does.
struct LoopGap {
  std::string name;                 ///< "E_Y by bed"
  std::vector<NodeWeights> growth;  ///< per displacement of the machine; empty but for one [m/K, rad/K]
};

[[nodiscard]] std::vector<LoopGap> loop_gaps(Machine const& machine);

}  // namespace thermotwin::twin
