#pragma once

#include <vector>

#include "scenarios/experiment.h"
#include "scenarios/machine_limits.h"
#include "scenarios/sampled.h"
#include "twin/diagnosis/measured_data.h"

namespace thermotwin::twin {

/// The gaps until `end`, the end of the run, that are longer than `longest` and than ten usual intervals of the
/// input: what is recorded only where it changes has none.
[[nodiscard]] std::vector<RecordGap> gaps_of(scenarios::SampledInput const& input, double longest, double end);

/// Adds what the machine may have been given instead in those gaps of its inputs, in the order of `experiment.driven`.
/// In each half of a gap, what stood still or was below half of its largest value in the record goes there, and what
/// was above rests. Only speeds, feeds, and shares and switches that change at all: what is held between rows; those of
/// one spindle or axis that have the same gap go together, and one that was recorded in it stays as it was. A
/// temperature, which goes straight across a gap, has none.
///
/// Rows within such a gap and for a quarter of an hour after it are left out: what they show depends on when within
/// its half the input changed.
void add_alternatives(MeasuredRun& run, std::vector<std::vector<RecordGap>> const& gaps,
                      scenarios::Experiment const& experiment, scenarios::MachineLimits const& limits);

/// Adds the machine's course where the air was recorded late, for a thermometer in still air takes minutes; where its
/// surfaces see walls that follow the air by six hours: with some 4 W/(m² K) of radiation beside 2 to 5 of convection
/// (physics.md 2.6) they exchange as much with these; and where the air around it has a cosine or a sine of a day, of
/// 1 K, beside that of the room's sensor. Of temperatures of the air that change at all.
void add_other_air(MeasuredRun& run, scenarios::Experiment const& experiment, scenarios::MachineLimits const& limits);

/// For people: one remark for each gap, which names the inputs that have it.
void remark_gaps(std::vector<std::vector<RecordGap>> const& gaps, scenarios::Experiment const& experiment,
                 std::vector<std::string>& remarks);

}  // namespace thermotwin::twin
