#include "twin/compensation/sensor_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

constexpr double most_left = 0.25;  ///< of a jump, after a leap back

}  // namespace

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

/// A step that takes most of a jump back is a leap even where noise makes it smaller than one.
bool SensorWatch::leapt_back(Point const& before) {
  double const step = last_.value - before.value;
  double const quiet = reach(std::min(last_.time - before.time, settings_.stale_time));
  double const sum = jump_->left + step;
  bool const leaps = std::abs(step) > quiet || std::abs(sum) <= most_left * std::abs(jump_->left);
  if (leaps) jump_->left = sum;
  jump_->most = std::max(jump_->most, std::abs(jump_->left));
  return std::abs(jump_->left) <= (leaps ? quiet : most_left * jump_->most);
}

SensorFault SensorWatch::judge(double value, double time) {
  if (std::isnan(value)) return SensorFault::missing;
  if (value < settings_.lowest || value > settings_.highest) return SensorFault::out_of_range;
  Point const before = std::exchange(last_, {value, time});
  if (value != before.value || before.time == never) changed_ = time;
  if (!ever_read()) return SensorFault::none;
  double const off = value - believed_.value;
  bool const plausible = std::abs(off) <= reach(time - believed_.time);
  if (!jump_ && !plausible)
    jump_ = Jump{off, std::abs(off)};
  else if (jump_ && leapt_back(before) && plausible)
    jump_.reset();
  return jump_ ? SensorFault::jump : SensorFault::none;
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
