#pragma once

#include <cstdlib>  // __GLIBC_PREREQ

/// Four numbers at a time: a scalar for formulas that are templates over theirs (law.h). Powers and roots are those of
/// the C library's vector functions, within four units of the last place; where the processor or the library lacks
/// them, THERMOTWIN_LANES is not defined and formulas take one element after another.
#if defined(__AVX2__) && defined(__GLIBC__)
#if __GLIBC_PREREQ(2, 35)
#define THERMOTWIN_LANES
#endif
#endif

#ifdef THERMOTWIN_LANES
#include <immintrin.h>

namespace thermotwin::thermal {

using LaneRegister = __m256d;

extern "C" {  // of libmvec, by the names that its vector ABI gives them
[[gnu::const]] LaneRegister thermotwin_pow(LaneRegister, LaneRegister) __asm__("_ZGVdN4vv_pow");
[[gnu::const]] LaneRegister thermotwin_cbrt(LaneRegister) __asm__("_ZGVdN4v_cbrt");
[[gnu::const]] LaneRegister thermotwin_tanh(LaneRegister) __asm__("_ZGVdN4v_tanh");
}

struct Lanes {
  static constexpr int count = 4;
  LaneRegister value;

  Lanes() : Lanes(0.0) {}
  Lanes(double x) : value{x, x, x, x} {}  // NOLINT(google-explicit-constructor): constants mix with lanes in formulas
  explicit Lanes(LaneRegister x) : value(x) {}

  friend Lanes operator-(Lanes const& a) { return Lanes(-a.value); }
  friend Lanes operator+(Lanes const& a, Lanes const& b) { return Lanes(a.value + b.value); }
  friend Lanes operator-(Lanes const& a, Lanes const& b) { return Lanes(a.value - b.value); }
  friend Lanes operator*(Lanes const& a, Lanes const& b) { return Lanes(a.value * b.value); }
  friend Lanes operator/(Lanes const& a, Lanes const& b) { return Lanes(a.value / b.value); }
};

/// Whether the compiler knows that all are one number.
inline bool is_constant(Lanes const& x) {
  double const a = x.value[0], b = x.value[1], c = x.value[2], d = x.value[3];
  return __builtin_constant_p(a == b && a == c && a == d) && a == b && a == c && a == d;
}

inline Lanes sqrt(Lanes const& x) { return Lanes(_mm256_sqrt_pd(x.value)); }
inline Lanes cbrt(Lanes const& x) {
  return is_constant(x) ? Lanes(__builtin_cbrt(x.value[0])) : Lanes(thermotwin_cbrt(x.value));
}
inline Lanes tanh(Lanes const& x) { return Lanes(thermotwin_tanh(x.value)); }

/// x^p, x > 0. Powers of sixths are roots, and of a constant (air's Prandtl number) there is one for the compiler.
inline Lanes pow(Lanes const& x, double exponent) {
  if (exponent == 1.0 / 6.0) return sqrt(cbrt(x));
  if (exponent == 2.0 / 3.0) return cbrt(x) * cbrt(x);
  if (is_constant(x)) return {__builtin_pow(x.value[0], exponent)};
  return Lanes(thermotwin_pow(x.value, Lanes(exponent).value));
}

}  // namespace thermotwin::thermal

#endif
