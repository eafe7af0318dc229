#pragma once

namespace thermotwin::twin {

struct ShiftLimits {
  double resolution = 1.0;  ///< of the controller [µm]
  double dead_band = 1.0;   ///< smaller changes of the target are not followed [µm]
  double slew = 1.0;        ///< [µm/s]
  double largest = 50.0;    ///< of either sign [µm]
};

/// The origin shift of one axis, in steps of the controller's resolution:
///
///   g ← resolution · round(target / resolution), if |target − g| ≥ dead band or target = 0
///   r ← r + clamp(g − r, ± slew · elapsed),   offset = resolution · round(r / resolution),   |offset| ≤ largest
///
/// So at rest |offset − target| is below the dead band, or half a step where that is more. Whatever the targets,
/// |offset| ≤ largest and |Δoffset| ≤ slew · elapsed + resolution. A target that is not finite is not followed. An offset
/// of 0 has no sign.
class AxisShift {
 public:
  /// InputError unless all limits are positive (the dead band may be 0) and `largest` is at least one step.
  explicit AxisShift(ShiftLimits const& limits);

  /// The offset [µm] after `elapsed` seconds on the way to `target` [µm].
  double move_to(double target, double elapsed);

  [[nodiscard]] double offset() const;
  [[nodiscard]] ShiftLimits const& limits() const { return limits_; }

 private:
  [[nodiscard]] double to_step(double shift) const;

  ShiftLimits limits_;
  double largest_;  ///< a whole number of steps
  double goal_ = 0.0, ramp_ = 0.0;
};

/// What is left of an offset when nothing supports it any more: all of it for `hold` seconds, then linearly less, none
/// after another `fade` seconds.
struct FadingHold {
  double hold = 600.0, fade = 600.0;  ///< [s]

  [[nodiscard]] double share(double age) const {
    if (age <= hold) return 1.0;
    return age >= hold + fade ? 0.0 : 1.0 - (age - hold) / fade;
  }
};

}  // namespace thermotwin::twin
