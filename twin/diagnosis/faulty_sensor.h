#pragma once

#include <optional>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

struct FaultySensor {
  std::string name;
  bool dead = false;  ///< shows nothing in a run; otherwise its readings jump about as those of no body do
};

/// The one sensor that is dead or jumps about; none where several do. One that hangs in the air may jump.
[[nodiscard]] std::optional<FaultySensor> faulty_sensor(Machine const& machine, std::vector<BinnedRun> const& runs);

}  // namespace thermotwin::twin
