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
  std::string body;
  std::string toward;          ///< the joint's place on the other body; empty: along this one
  NodeWeights change;          ///< of its weights where x is 1; Σ = 0
  bool can_be_written = true;  ///< along a bar, only a position can be another one, no stretch
};

[[nodiscard]] std::vector<SensorPlace> sensor_places(Value const& document, Machine const& machine);

/// How a file says where a sensor was seen to sit: `at = ["bed", "tank"]`, `shares = [0.94, 0.06]`.
struct PlacedSensor {
  std::string name;
  std::vector<std::string> at;
  std::vector<double> shares;  ///< empty: equal
};

/// The sensors that are not where the document has them: x of each of `places`, 0 where it is as it was. A position
/// stays on its bar.
[[nodiscard]] std::vector<PlacedSensor> placed_sensors(Value const& document, std::vector<SensorPlace> const& places,
                                                       std::vector<double> const& x);

/// In its `[[temperature_sensor]]`.
void put(Value& table, PlacedSensor const& sensor);

}  // namespace thermotwin::twin
