#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
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
/// that the integrator never steps across a discontinuity (it stops there and starts anew). It asks for the course at
/// the ends of its steps, and once all is steady these are long: so it is told where channels bend, and how long a step
/// may be, or what comes and goes within one would never be seen.
class Course {
 public:
  Course() = default;
  Course(Course const&) = default;
  Course& operator=(Course const&) = default;
  virtual ~Course() = default;

  [[nodiscard]] virtual std::vector<InputChannel> const& channels() const = 0;

  /// Place among the channels; −1: none has that name.
  [[nodiscard]] int index_of(std::string_view name) const {
    auto const& all = channels();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].name == name) return int(i);
    return -1;
  }

  /// Values of all channels at time t [s]. At a jump: the limit from the right.
  virtual void evaluate(double t, std::span<double> values) const = 0;

  /// First jump strictly after t, or +infinity.
  [[nodiscard]] virtual double next_jump(double t) const = 0;

  /// First time strictly after t at which a channel bends: a step ends there. +infinity: none does any more.
  [[nodiscard]] virtual double next_bend([[maybe_unused]] double t) const {
    return std::numeric_limits<double>::infinity();
  }

  /// The longest step that follows channels which swing or decay by a formula [s].
  [[nodiscard]] virtual double longest_step() const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace thermotwin::thermal
