#pragma once

#include <string>
#include <vector>

#include "twin/file/value.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// How a sensor on a lump, a bar or a cylinder may see something else than the node that its file names: along the bar,
/// whose length it was measured on by hand,
///
///   T + x · 6 mm · dT/dz,
///
/// and nearer to a joint by there, or farther from it, since a node has one temperature and its surroundings have not,
///
///   T + x · 0.1 (T_other − T),   T_other: of the body on the joint's other side.
struct SensorPlace {
  std::string name;  ///< "T3 along cartridge", "T15 near tank"
  std::string sensor;
  NodeWeights change;  ///< of its weights where x is 1; Σ = 0
};

[[nodiscard]] std::vector<SensorPlace> sensor_places(Value const& document, Machine const& machine);

}  // namespace thermotwin::twin
