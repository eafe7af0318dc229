#pragma once

#include <optional>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

struct FaultySensor {
  std::string name;
  std::string what;  ///< it does, for people: "shows nothing in a run"
};

/// The one sensor that is dead, or whose readings change from one sample to the next and stay so, as no body's
/// temperature does; none where several do. One that hangs in the air may.
[[nodiscard]] std::optional<FaultySensor> faulty_sensor(Machine const& machine, std::vector<BinnedRun> const& runs);

}  // namespace thermotwin::twin
