#pragma once

#include <cmath>

namespace thermotwin::thermal {

/// C-infinity stand-ins for functions with a kink, so that the integrator's error control and the sensitivities stay
/// valid across a change of regime (physics.md §0).

/// |x| as sqrt(x² + ε²).
template <class S>
S smooth_abs(S const& x, double epsilon) {
  using std::sqrt;
  return sqrt(x * x + epsilon * epsilon);
}

/// |x|^p as (x² + ε²)^{p/2}; for temperature differences ε = 0.01 K.
template <class S>
S smooth_power(S const& x, double exponent, double epsilon = 0.01) {
  using std::pow;
  return pow(S(x * x + epsilon * epsilon), 0.5 * exponent);
}

/// |x|^p that is exactly 0 at x = 0, as x² (x² + ε²)^{p/2 − 1}: what stands still makes no heat.
template <class S>
S vanishing_power(S const& x, double exponent, double epsilon) {
  using std::pow;
  return x * x * pow(S(x * x + epsilon * epsilon), 0.5 * exponent - 1.0);
}

/// max(a, b) as ½ (a + b + sqrt((a − b)² + ε²)); at most ε/2 above it, at a = b.
template <class S>
S smooth_max(S const& a, S const& b, double epsilon) {
  return 0.5 * (a + b + smooth_abs<S>(a - b, epsilon));
}

/// max(x, 0) as ½ (x + sqrt(x² + ε²)), positive everywhere; the form for x < 0 is the same without cancellation.
template <class S>
S smooth_positive(S const& x, double epsilon) {
  S const magnitude = smooth_abs<S>(x, epsilon);
  return x < S(0.0) ? 0.5 * epsilon * epsilon / (magnitude - x) : 0.5 * (x + magnitude);
}

/// Goes from 0 to 1 around `centre` within a few `width`: s = (1 + tanh((x − centre)/width))/2.
template <class S>
S smooth_step(S const& x, double centre, double width) {
  using std::tanh;
  return 0.5 * (1.0 + tanh((x - centre) / width));
}

/// `below` left of `centre`, `above` right of it, blended by smooth_step.
template <class S>
S blend(S const& below, S const& above, S const& x, double centre, double width) {
  S const s = smooth_step(x, centre, width);
  return below * (1.0 - s) + above * s;
}

/// Relative width of a change of regime: nine tenths of it happen within 15 % of the threshold.
inline constexpr double regime_width = 0.1;

/// `below` the threshold of a governing number (Re, Ra, Ta > 0), `above` it, blended over `regime_width` of it.
template <class S>
S change_of_regime(S const& below, S const& above, S const& number, double threshold) {
  return blend<S>(below, above, number, threshold, regime_width * threshold);
}

}  // namespace thermotwin::thermal
