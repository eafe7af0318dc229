#pragma once

#include <string>
#include <vector>

#include "twin/file/value.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// What a structural loop leaves out: a file lists the steps from the table to the tool, but castings also bend and
/// shift each other. So every displacement may follow the mean temperature of every solid by a share x of the solid's
/// free growth, x α L (T − T(0)), L its longest edge; a rotation by x α (T − T(0)).
/// Not where a step of the loop has the weight 0: that file knows of none what it does.
struct LoopGap {
  std::string name;  ///< "E_Y by bed"
  std::string displacement, body;
  double length = 0.0;              ///< that grows where x is 1 [m]; of a rotation over a base of 1 m
  std::vector<NodeWeights> growth;  ///< per displacement of the machine; empty but for one [m/K, rad/K]
};

[[nodiscard]] std::vector<LoopGap> loop_gaps(Machine const& machine);

/// How a file says what a displacement does beyond its loop: `displacement.E_Y` or `rotation.A`, and its list `beyond`,
/// `[{ of = "bed", length = "24 mm" }]`.
struct LoopBeyond {
  std::string channel, text;
};

/// What `x` of each of `gaps` makes, before the steps that the file has; none where it is 0.
[[nodiscard]] std::vector<LoopBeyond> loops_beyond(Value document, std::vector<LoopGap> const& gaps,
                                                   std::vector<double> const& x);

}  // namespace thermotwin::twin
