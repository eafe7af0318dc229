#pragma once

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "thermal/dual.h"

namespace thermotwin::thermal {

/// Derivative of a generic callable f(scalar) by dual numbers.
template <class F>
double slope_of(F const& f, double x) {
  return f(Dual<1>::variable(x, 0)).partial[0];
}

/// The dual derivative at x agrees with the central difference over ± `step`.
template <class F>
void expect_slope_is_difference(F const& f, double x, double step, double tolerance = 1e-6) {
  double const difference = (f(x + step) - f(x - step)) / (2.0 * step);
  double const scale = std::max(std::abs(difference), std::abs(f(x)) / std::max(std::abs(x), step) * 1e-3);
  EXPECT_NEAR(slope_of(f, x), difference, tolerance * scale) << "at " << x;
}

/// Largest change from one sample to the next: of the value, of the slope, and of the value beyond what the slopes
/// explain.
struct Roughness {
  double value = 0.0;
  double slope = 0.0;
  double unexplained = 0.0;
};

template <class F>
Roughness roughness(F const& f, double lower, double upper, int steps) {
  Roughness worst;
  double const h = (upper - lower) / steps;
  Dual<1> last = f(Dual<1>::variable(lower, 0));
  for (int i = 1; i <= steps; ++i) {
    Dual<1> const next = f(Dual<1>::variable(lower + i * h, 0));
    double const jump = next.value - last.value;
    double const explained = 0.5 * h * (next.partial[0] + last.partial[0]);
    worst.value = std::max(worst.value, std::abs(jump));
    worst.slope = std::max(worst.slope, std::abs(next.partial[0] - last.partial[0]));
    worst.unexplained = std::max(worst.unexplained, std::abs(jump - explained));
    last = next;
  }
  return worst;
}

/// f has neither a jump nor a kink in [lower, upper]: with eight times as many samples the largest change of value and
/// of slope from one to the next falls (a jump or a kink would keep its size), and the values are the integral of the
/// slopes.
template <class F>
void expect_continuous_with_slope(F const& f, double lower, double upper) {
  constexpr int steps = 2000;
  Roughness const coarse = roughness(f, lower, upper, steps);
  Roughness const fine = roughness(f, lower, upper, 8 * steps);
  double const rounding = 1e-13 * std::max(std::abs(f(lower)), std::abs(f(upper)));
  double const h = (upper - lower) / (8 * steps);
  EXPECT_TRUE(std::isfinite(coarse.value + coarse.slope));
  EXPECT_LE(fine.value, 0.4 * coarse.value + rounding) << "jump between " << lower << " and " << upper;
  EXPECT_LE(fine.slope, 0.4 * coarse.slope + rounding / h) << "kink between " << lower << " and " << upper;
  EXPECT_LE(fine.unexplained, h * fine.slope + rounding) << "slope is not the derivative";
}

/// The same around a threshold of a positive number, from half of it to its double.
template <class F>
void expect_smooth_switch(F const& f, double threshold) {
  expect_continuous_with_slope(f, 0.5 * threshold, 2.0 * threshold);
}

}  // namespace thermotwin::thermal
