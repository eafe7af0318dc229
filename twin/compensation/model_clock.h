#pragma once

#include <algorithm>

namespace thermotwin::twin {

/// The senders' time, told from our own w [s, steady]:
///
///   t(w) = c + speed · w,   c ← max(c, stamp − speed · w)
///
/// so that the message with the least delay sets it, and no accepted message comes from the future. All messages
/// together can push it ahead of the first one's by `tolerance` and a thousandth of the time that has passed, by which
/// it also falls back when they lag; one that would push further is refused.
class ModelClock {
 public:
  /// `speed`: seconds of the senders' time per second; above 1 where a recorded run is played faster.
  ModelClock(double speed, double tolerance) : speed_(speed), tolerance_(tolerance) {}

  /// A message with that time came at `wall`. False: it is refused.
  bool follow(double stamp, double wall) {
    double const now = speed_ * wall;
    if (!started_) {
      start_ = wall_ = wall;
      first_ = ahead_ = stamp - now;
      started_ = true;
    }
    if (stamp > now + first_ + tolerance_ + drift * (wall - start_) * speed_) return false;
    ahead_ = std::max(ahead_ - drift * (wall - wall_) * speed_, stamp - now);
    wall_ = wall;
    return true;
  }

  [[nodiscard]] bool started() const { return started_; }
  [[nodiscard]] double now(double wall) const { return ahead_ + speed_ * wall; }

 private:
  static constexpr double drift = 1e-3;
  double speed_, tolerance_;
  double start_ = 0.0, wall_ = 0.0;   ///< of the first message, and of the last [s]
  double first_ = 0.0, ahead_ = 0.0;  ///< c then and now
  bool started_ = false;
};

}  // namespace thermotwin::twin
