#pragma once

#include <optional>

#include "twin/diagnosis/estimation.h"
#include "twin/diagnosis/faulty_sensor.h"

namespace thermotwin::twin {

/// The one sensor whose reading leaves the calibrated machine at one moment and stays off, y = T + s (t > t₀)
/// (physics.md §7 no. 27), where no sample shows it (faulty_sensor.h): one that lags takes minutes, and a gap may hide
/// it.
///
/// Of every moment between two rows, T = b²/a of the whitened step; with the noise that is heard, which has heard the
/// step as well. The largest of a sensor must reach `threshold` + 2 ln of the number of moments of all sensors, move it
/// by 0.3 K, and have four measured rows on either side; where another sensor's does so, too, it is the machine. One
/// that hangs in the air may jump.
[[nodiscard]] std::optional<FaultySensor> jumping_sensor(Machine const& machine, Estimation const& estimation,
                                                         Fit const& calibrated, double threshold);

}  // namespace thermotwin::twin
