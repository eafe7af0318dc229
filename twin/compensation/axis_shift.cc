#include "twin/compensation/axis_shift.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

constexpr double step_round_off = 1e-9;

void require(bool holds, char const* what, double value, char const* allowed) {
  if (!holds) throw thermal::InputError(fmt::format("{} of {:g}: it must be {}", what, value, allowed));
}

}  // namespace

AxisShift::AxisShift(ShiftLimits const& limits)
    : limits_(limits), largest_(limits.resolution * std::floor(limits.largest / limits.resolution + step_round_off)) {
  require(limits.resolution > 0 && std::isfinite(limits.resolution), "a resolution", limits.resolution, "positive");
  require(limits.dead_band >= 0, "a dead band", limits.dead_band, "0 or more");
  require(limits.slew > 0, "a slew limit", limits.slew, "positive");
  require(limits.largest >= limits.resolution && std::isfinite(limits.largest), "a largest offset", limits.largest,
          "at least one step of the resolution");
}

double AxisShift::move_to(double target, double elapsed) {
  if (std::isfinite(target)) {
    double const wanted = std::clamp(target, -largest_, largest_);
    if (std::abs(wanted - goal_) >= limits_.dead_band || wanted == 0.0) goal_ = to_step(wanted);
  }
  double const reach = limits_.slew * std::max(0.0, elapsed);
  ramp_ += std::clamp(goal_ - ramp_, -reach, reach);
  return offset();
}

double AxisShift::offset() const { return std::clamp(to_step(ramp_), -largest_, largest_); }

/// A sum with 0 is never -0.
double AxisShift::to_step(double shift) const {
  return limits_.resolution * std::round(shift / limits_.resolution) + 0.0;
}

}  // namespace thermotwin::twin
