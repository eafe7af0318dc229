#pragma once

#include <vector>

#include "scenarios/experiment.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// Between what a reduced model shall hold. Speeds and feeds: from rest to the machine's limits; coolant: on and off.
struct ReducedRange {
  double coldest_air = 283.15;  ///< [K]
  double warmest_air = 308.15;  ///< [K]
  double stratification = 1.0;  ///< from 0 to this [K/m]
};

/// Experiments that go through the range: random spectra with short and long blocks, full speed, rest, air that is
/// cold, warm, drifts, swings with the day and with the air conditioning, and falls when a door opens.
[[nodiscard]] std::vector<scenarios::Experiment> training_experiments(Machine const& machine,
                                                                      ReducedRange const& range);

}  // namespace thermotwin::twin
