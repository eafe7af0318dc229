#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace thermotwin::twin {

inline constexpr double never = -std::numeric_limits<double>::infinity();  ///< a time before all others [s]

/// The senders' time, learnt from the stamps t of their messages and our own w [s, steady] when those came. A stamp
/// leads our clock by m = t − speed · w, the more the less its message was delayed:
///
///   c_i ← max(c_i, min(m, m before))   of sender i,      b = median of c_i   (the lower of two)
///   t(w) = c + speed · w,              c ← max(c, m)     for every m ≤ b + tolerance
///
/// So messages may be as late as they will, the first ones too: those that come sooner set it right. A lead beyond the
/// tolerance is not believed until most senders have it, twice in a row; a stamp from the future alone moves nothing.
/// Where the senders' clocks go slower than ours, c falls by up to a thousandth of the time that passes.
class ModelClock {
 public:
  /// `speed`: seconds of the senders' time per second; above 1 where a recorded run is played faster.
  /// `tolerance`: by which the senders' clocks may differ [s].
  ModelClock(double speed, double tolerance, std::size_t senders);

  [[nodiscard]] double lead(double stamp, double wall) const { return stamp - speed_ * wall; }
  /// That sender's message has this lead.
  void hear(std::size_t sender, double lead);
  [[nodiscard]] bool heard(std::size_t sender) const;
  /// False before most senders have been heard.
  [[nodiscard]] bool believes(double lead) const { return lead <= most_have_ + tolerance_; }
  /// A lead that it believes, heard by `wall`.
  void follow(double lead, double wall);

  [[nodiscard]] bool started() const;
  [[nodiscard]] double now(double wall) const { return ahead_ + speed_ * wall; }

 private:
  struct Leads {
    double last, largest;
  };
  double speed_, tolerance_;
  std::vector<Leads> leads_;  ///< per sender
  double most_have_;          ///< b
  double ahead_;              ///< c
  double wall_ = 0.0;         ///< of what was followed last [s]
};

}  // namespace thermotwin::twin
