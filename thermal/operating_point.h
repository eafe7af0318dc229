#pragma once

#include <span>
#include <string>
#include <vector>

namespace thermotwin::thermal {

/// One channel of the input, for example {"spindle.speed", "rad/s", "spindle speed"}. SI inside, whatever the file
/// said.
struct InputChannel {
  std::string name;         ///< unique, dotted: `spindle.speed`, `ambient.temperature`
  std::string unit;         ///< SI unit of the stored numbers: "rad/s", "K", "m/s", "1"
  std::string description;  ///< one line for people
};

/// The operating point is the value of every input channel at one instant; the course is the operating point over time.
///
/// A course may jump. Between two jumps it is continuous, and `evaluate` is only asked for times inside one piece, so
/// that the integrator never steps across a discontinuity (it stops there and starts anew).
class Course {
 public:
  Course() = default;
  Course(Course const&) = default;
  Course& operator=(Course const&) = default;
  virtual ~Course() = default;

  [[nodiscard]] virtual std::vector<InputChannel> const& channels() const = 0;

  /// Values of all channels at time t [s]. At a jump: the limit from the right.
  virtual void evaluate(double t, std::span<double> values) const = 0;

  /// First jump strictly after t, or +infinity.
  [[nodiscard]] virtual double next_jump(double t) const = 0;
};

}  // namespace thermotwin::thermal
