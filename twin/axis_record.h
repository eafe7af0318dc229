#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "models/feed_axis.h"
#include "output/dataset.h"

namespace thermotwin::twin {

/// An error is a displacement channel, or "slope z": the slope of axis z's position error in the laser's passes.
inline constexpr std::string_view slope_prefix = "slope ";

/// The laser of that axis among those of a run. InputError that names the run.
[[nodiscard]] output::Positioning const& laser_of(std::vector<output::Positioning> const& lasers,
                                                  std::string const& axis, std::string const& run);

/// What a laser saw at its targets from `from` to `to` [m], mean of both directions, with the temperatures of the row
/// at or before each pass; `readings` need no error.
[[nodiscard]] models::AxisRecord axis_record(models::Batch const& readings, output::Positioning const& laser,
                                             double from = -std::numeric_limits<double>::infinity(),
                                             double to = std::numeric_limits<double>::infinity());

}  // namespace thermotwin::twin
