#pragma once

#include <limits>
#include <string_view>

namespace thermotwin::twin {

/// What can be wrong with a sensor.
enum class SensorFault {
  none,
  missing,       ///< it says so itself: no value, or a quality other than "good"
  stale,         ///< no message for `stale_time`
  stuck,         ///< the very same number for `stuck_time`
  jump,          ///< it leapt further than the body can; over when it leaps back
  out_of_range,  ///< below `lowest` or above `highest`
};

[[nodiscard]] std::string_view name_of(SensorFault fault);

struct WatchSettings {
  double stale_time = 60.0;                ///< [s]
  double stuck_time = 600.0;               ///< longer than a healthy reading stands still [s]
  double jump = 0.3;                       ///< that noise and resolution may make [K]
  double fastest = 0.02;                   ///< change of the body [K/s]
  double lowest = -20.0, highest = 120.0;  ///< [°C]

  /// For inputs of the machine, which may leap and stand still: missing and stale only.
  [[nodiscard]] static WatchSettings for_inputs(double stale_time) {
    constexpr double any = std::numeric_limits<double>::infinity();
    return {stale_time, any, any, 0.0, std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
  }
};

/// Watches one sensor. A reading is believed when it lies within [lowest, highest] and
///
///   |x − x₀| ≤ jump + fastest · (t − t₀),   (x₀, t₀) the last one believed.
///
/// A fault ends with the next reading that is believed; after a jump, which time would make plausible, only a leap back
/// ends it.
class SensorWatch {
 public:
  /// InputError unless the highest reading is above the lowest.
  explicit SensorWatch(WatchSettings const& settings);

  /// `value`: NaN when the sender says that it has none. False when the time is not later than that of the last
  /// reading, which then stands.
  bool take(double value, double time);

  [[nodiscard]] SensorFault fault(double now) const;
  /// Since when the sensor cannot be believed, as known `now`: it is stuck since its last change, stale since its last
  /// message.
  [[nodiscard]] double fault_since(double now) const;
  [[nodiscard]] bool ever_read() const { return believed_.time > never; }
  [[nodiscard]] double value() const { return believed_.value; }  ///< the last one believed
  [[nodiscard]] double last_time() const { return last_time_; }   ///< of the last message

 private:
  static constexpr double never = -std::numeric_limits<double>::infinity();
  struct Point {
    double value = 0.0, time = never;
  };
  [[nodiscard]] bool within_reach(double value, double time, Point const& from) const;
  [[nodiscard]] SensorFault judge(double value, double time);
  [[nodiscard]] bool stuck() const { return last_time_ - changed_ >= settings_.stuck_time; }

  WatchSettings settings_;
  SensorFault seen_ = SensorFault::none;  ///< of the last reading
  double since_ = never;                  ///< that fault
  Point believed_, last_;                 ///< last_: within the range, believed or not
  double last_time_ = never, changed_ = never;
};

}  // namespace thermotwin::twin
