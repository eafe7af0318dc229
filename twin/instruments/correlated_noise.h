#pragma once

#include <cmath>
#include <utility>

#include "twin/instruments/random_stream.h"

namespace thermotwin::twin {

/// First-order autoregressive noise at any times in ascending order: v ← ρ v + σ √(1 − ρ²) N(0, 1), ρ = e^{−Δt/τ}.
/// Stationary from the first value: standard deviation σ, autocorrelation e^{−lag/τ}.
class CorrelatedNoise {
 public:
  CorrelatedNoise(RandomStream stream, double deviation, double correlation_time)
      : stream_(std::move(stream)), deviation_(deviation), correlation_time_(correlation_time) {}

  double at(double t) {
    if (deviation_ == 0.0) return 0.0;
    double const rho = started_ ? std::exp(-(t - time_) / correlation_time_) : 0.0;
    value_ = rho * value_ + deviation_ * std::sqrt(1.0 - rho * rho) * stream_.normal();
    time_ = t;
    started_ = true;
    return value_;
  }

 private:
  RandomStream stream_;
  double deviation_;
  double correlation_time_;
  double value_ = 0.0;
  double time_ = 0.0;
  bool started_ = false;
};

}  // namespace thermotwin::twin
