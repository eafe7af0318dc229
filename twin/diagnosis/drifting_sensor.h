#pragma once

#include <optional>

#include "twin/diagnosis/estimation.h"
#include "twin/diagnosis/faulty_sensor.h"

namespace thermotwin::twin {

/// The sensor whose reading drifts away from what the others and the calibrated machine say of it, y = T + b t
/// (physics.md §7 no. 27); of several that seem to, the clearest.
///
/// Within a day a drift is less than what a model gets wrong while the machine is warm, and more than what it gets
/// wrong at rest. So the sensors' slow noise is taken to be that of the air around them and half of the heard share
/// (ChannelNoise::slow_share) of the way that a reading has gone from where it began (way_share), instead of that share
/// of its range throughout; on a long casting more of the way, for what is warm at one end is so for hours. With that
/// noise the numbers are fitted again, and every drift among `hypotheses` has its score T = b²/a. The largest must
/// reach a threshold amid the 12 to 20 that physics.md 8.6 expects with correlated errors, and more where the machine's
/// form is not quite right (birge_ratio.h). Where more than two reach the former, it is no sensor: a room that swings
/// pulls at all of them. Nor is it where an effect of the machine explains more: slow heat that is too little to be
/// named looks like a drift of the sensor next to it. One that hangs in the air is not asked, for the room's record may
/// be as wrong as it is.
[[nodiscard]] std::optional<FaultySensor> drifting_sensor(Estimation const& estimation, Fit const& calibrated,
                                                          std::vector<Hypothesis> const& hypotheses);

}  // namespace thermotwin::twin
