#include "twin/compensation/sensor_watch.h"

#include <array>
#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"

namespace thermotwin::twin {

std::string_view name_of(SensorFault fault) {
  constexpr std::array<std::string_view, 6> names{"good", "missing", "stale", "stuck", "jumped", "out of range"};
  return names[std::size_t(fault)];
}

SensorWatch::SensorWatch(WatchSettings const& settings) : settings_(settings) {
  if (!(settings.lowest < settings.highest))
    throw thermal::InputError(
        fmt::format("a sensor may show {:g} degC at least and {:g} degC at most: the highest must be above the lowest; "
                    "write them as temperatures, for example \"120 degC\"",
                    settings.lowest, settings.highest));
}

bool SensorWatch::within_reach(double value, double time, Point const& from) const {
  return std::abs(value - from.value) <= settings_.jump + settings_.fastest * (time - from.time);
}

SensorFault SensorWatch::judge(double value, double time) {
  if (std::isnan(value)) return SensorFault::missing;
  if (value < settings_.lowest || value > settings_.highest) return SensorFault::out_of_range;
  bool const leapt = last_.time > never && !within_reach(value, time, last_);
  if (value != last_.value || last_.time == never) changed_ = time;
  last_ = {value, time};
  if (!ever_read()) return SensorFault::none;
  if (seen_ == SensorFault::jump && !leapt) return SensorFault::jump;
  return within_reach(value, time, believed_) ? SensorFault::none : SensorFault::jump;
}

bool SensorWatch::take(double value, double time) {
  if (time <= last_time_) return false;
  last_time_ = time;
  auto const fault = judge(value, time);
  if (fault != seen_) since_ = time;
  seen_ = fault;
  if (fault == SensorFault::none && (!stuck() || !ever_read())) believed_ = {value, time};
  return true;
}

SensorFault SensorWatch::fault(double now) const {
  if (!ever_read()) return SensorFault::missing;
  if (now - last_time_ > settings_.stale_time) return SensorFault::stale;
  if (seen_ != SensorFault::none) return seen_;
  return stuck() ? SensorFault::stuck : SensorFault::none;
}

double SensorWatch::fault_since(double now) const {
  switch (fault(now)) {
    case SensorFault::stale:
      return last_time_;
    case SensorFault::stuck:
      return changed_;
    default:
      return since_;
  }
}

}  // namespace thermotwin::twin
