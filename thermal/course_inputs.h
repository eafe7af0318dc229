#pragma once

#include <limits>
#include <vector>

#include "thermal/network.h"
#include "thermal/operating_point.h"

namespace thermotwin::thermal {

/// A course, asked by the order of a network's channels, one piece between two jumps at a time. Holds scratch memory.
class CourseInputs {
 public:
  /// InputError, with the nearest name, for a channel of the network that the course does not give; also for a
  /// share that it gives with a unit.
  CourseInputs(Network const& network, Course const& course);

  /// Enters the piece that follows t and returns where it ends.
  double enter_piece(double t);
  /// As of the course.
  [[nodiscard]] double next_bend(double t) const { return course_->next_bend(t); }
  [[nodiscard]] double longest_step() const { return course_->longest_step(); }
  /// At the end of the piece: the limit from the left. Relays keep the state that they were given (0 at first), weights
  /// of moving averages stay 0.
  std::vector<double> const& at(double t);
  /// As at the time that was asked last.
  [[nodiscard]] std::vector<double> const& values() const { return values_; }
  double& state_of(Relay const& relay) { return values_[std::size_t(relay.state_channel)]; }

 private:
  Course const* course_;
  std::vector<double> raw_, values_;
  std::vector<std::size_t> source_;
  double start_ = 0.0, end_ = std::numeric_limits<double>::infinity();
  double known_ = std::numeric_limits<double>::quiet_NaN();  ///< the time that the values are of
};

}  // namespace thermotwin::thermal
