#include "scenarios/motion_limit.h"

#include "thermal/units.h"

namespace thermotwin::scenarios {
namespace {

constexpr double round_off = 1e-9;  // of a limit that is written in another unit

}  // namespace

std::string beyond_limit(std::string const& channel, double largest, MachineLimits const& machine, double most) {
  auto const beyond = [&](double limit, thermal::Dimension dimension, std::string const& maximum) -> std::string {
    if (limit <= 0.0 || largest <= most * limit * (1.0 + round_off)) return "";
    return "reaches " + thermal::format_quantity(largest, dimension) + ", and " + maximum + " is " +
           thermal::format_quantity(limit, dimension) + "; is its unit right?";
  };
  std::string const of_machine = "the machine's maximum";
  if (channel == "spindle.speed")
    return beyond(machine.max_spindle_speed, thermal::dimension::angular_speed, of_machine);
  for (AxisLimits const& axis : machine.axes) {
    if (channel == axis.name + ".feed") return beyond(axis.rapid_feed, thermal::dimension::speed, of_machine);
    if (channel == axis.name + ".duty") return beyond(1.0, thermal::dimension::dimensionless, "the most");
  }
  return "";
}

}  // namespace thermotwin::scenarios
