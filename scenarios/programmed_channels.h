#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenarios/experiment.h"

namespace thermotwin::scenarios {

/// The input channels through which alone a field of an experiment acts: {"ambient.temperature"} of "ambient.mean",
/// {"z.feed"} of "axes.0.cycles". Where recordings or input programmes replace all of them, the field changes nothing.
/// None for fields that act otherwise, such as the duration.
std::vector<std::string> programmed_channels(Experiment const& experiment, std::string_view field);

}  // namespace thermotwin::scenarios
