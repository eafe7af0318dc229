#pragma once

#include <limits>
#include <optional>
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
/// A fault ends with the next reading that is believed. Not so a jump, which time would make plausible: it lasts, over
/// readings that are missing or out of range too, until the sensor leaps back. Its leaps are added up: changes from one
/// reading to the next beyond jump + fastest · min(Δt, stale_time); what it does in between may be its body's doing.
/// The jump is over when a leap brings their sum below that bound, or to at most a quarter of the largest that it was,
/// and the next reading stays there: an unplugged sensor does not see how far the body goes meanwhile, and a loose
/// contact does not stay.
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
  struct Jump {
    double left = 0.0, most = 0.0;  ///< sum of the leaps; its largest amount [K]
  };
  [[nodiscard]] double reach(double elapsed) const { return settings_.jump + settings_.fastest * elapsed; }
  [[nodiscard]] SensorFault judge(double value, double time);
  [[nodiscard]] bool leapt_back(Point const& before);
  [[nodiscard]] bool stuck() const { return last_time_ - changed_ >= settings_.stuck_time; }

  WatchSettings settings_;
  SensorFault seen_ = SensorFault::none;  ///< of the last reading
  double since_ = never;                  ///< that fault
  std::optional<Jump> jump_;              ///< that has not ended, whatever fault was seen last
  Point believed_, last_;                 ///< last_: within the range, believed or not
  double last_time_ = never, changed_ = never;
};

}  // namespace thermotwin::twin
