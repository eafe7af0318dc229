#pragma once

#include <span>
#include <vector>

#include "thermal/operating_point.h"
#include "twin/assembly.h"

namespace thermotwin::twin {

/// How a displacement follows the operating point at once: Σ c (u^p − u(0)^p) over its input terms [m, rad]. A channel
/// that the course lacks moves nothing.
class InputMotion {
 public:
  InputMotion() = default;
  InputMotion(std::vector<InputTerm> const& terms, thermal::Course const& course);

  /// From the values of the course's channels, then and at the start.
  [[nodiscard]] double operator()(std::span<double const> inputs, std::span<double const> at_start) const;

 private:
  struct Term {
    std::size_t channel = 0;
    double coefficient = 0.0, power = 1.0;
  };
  std::vector<Term> terms_;
};

}  // namespace thermotwin::twin
