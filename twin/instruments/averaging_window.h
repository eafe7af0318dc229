#pragma once

#include <deque>
#include <functional>
#include <limits>

namespace thermotwin::twin {

/// What an instrument averages: of the conversions, Δ apart up to a reading and made once each, those in (t − w, t],
///
///   y(t) = mean of x(t′) for t − w < t′ ≤ t,   at least that at t.
///
/// Before the first reading it has converted for as long as the window. What lies in the windows of several readings,
/// as where these are closer together than the window is long, goes into each of them with the same noise.
class AveragingWindow {
 public:
  /// w, Δ [s]. Throws InputError unless Δ is positive.
  AveragingWindow(double length, double interval);

  /// The reading at t [s], later than the one before; `convert` is asked for what is new, in order of time.
  double mean(double t, std::function<double(double)> const& convert);

 private:
  struct Conversion {
    double time, value;
  };

  double length_, interval_;
  double last_ = -std::numeric_limits<double>::infinity();  ///< time of the reading before
  std::deque<Conversion> kept_;
};

}  // namespace thermotwin::twin
