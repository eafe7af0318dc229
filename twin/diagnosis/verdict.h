#pragma once

#include "twin/diagnosis/diagnosis.h"

namespace thermotwin::twin {

/// What is to be said of what was found. `heat_left`: heat of free course is evident beside it. None known, too, where
/// all names of one thing stand in for what is missing: the fit would have it larger than is plausible, or a sensor
/// goes on to err more than others when its fault is known.
[[nodiscard]] Diagnosis::Verdict verdict_on(Diagnosis const& diagnosis, bool heat_left);

/// All that was found is at sensors.
[[nodiscard]] bool only_sensors(Diagnosis const& diagnosis);

}  // namespace thermotwin::twin
