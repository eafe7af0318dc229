#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "thermal/network.h"

namespace thermotwin::twin {

/// What a part of the machine asked of a correlation beyond the range that its source states.
struct Extrapolated {
  std::string part;
  thermal::Validity const* range = nullptr;
  double number = 0.0;  ///< farthest from the range
  double share = 0.0;   ///< of all heat that moved, what the part's elements moved meanwhile
};

/// "film.nose: Re of a rotating cylinder is 7.1e5, the law is stated for 0 to 4.3e5; 12 % of all heat moves so".
[[nodiscard]] std::string text_of(Extrapolated const& extrapolated);

/// Looks at a run now and then, and keeps what leaves the ranges of its correlations (thermal/validity.h).
class ExtrapolationWatch {
 public:
  /// Of a run that ends then [s].
  ExtrapolationWatch(thermal::Network const& network, double end) : network_(&network), end_(end) {}

  /// Every five minutes, and at the end.
  [[nodiscard]] bool is_due(double time) const { return time >= next_time_ || time >= end_; }

  /// At the temperatures and operating point of an Evaluation; times increase [s].
  void look(double time, double const* temperature, double const* input);

  /// Of a run that moved so much heat [J], the most first, what moved a hundredth or more of it.
  [[nodiscard]] std::vector<Extrapolated> found(double moved) const;

 private:
  struct Beyond {
    double number = 0.0, heat = 0.0;
  };
  thermal::Network const* network_;
  std::map<std::pair<int, thermal::Validity const*>, Beyond> beyond_;  ///< by part and range
  double end_, next_time_ = 0.0, last_time_ = 0.0;
  std::vector<thermal::Extrapolation> scratch_;
};

}  // namespace thermotwin::twin
