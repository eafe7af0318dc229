#pragma once

#include "twin/diagnosis/measured_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// A channel of the data in a machine, and what lies between that machine and the channel's number: what the file
/// states of the instrument, and what parts add to it (Machine::reading_terms).
struct ChannelReading {
  Sensor const* sensor = nullptr;
  Displacement const* displacement = nullptr;  ///< neither: the machine does not have it
  double lag = 0.0;                            ///< [s]
  double air_share = 0.0;                      ///< of the way from the body's temperature to the air's
  double offset = 0.0;                         ///< [K]
  double drift = 0.0;                          ///< [K/s, m/s]
  double per_air = 0.0;                        ///< [m/K]
};

[[nodiscard]] ChannelReading reading_of(Machine const& machine, MeasuredChannel const& channel);

}  // namespace thermotwin::twin
