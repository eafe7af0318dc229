#pragma once

#include <string>

namespace thermotwin::twin {

/// What a model wants to be told.
struct ModelInput {
  std::string name;
  std::string unit;      ///< that its messages must have
  bool sensor = true;    ///< a thermometer, which is watched closely; else an input of the machine
  bool required = true;  ///< without it there is no estimate
};

}  // namespace thermotwin::twin
