#pragma once

#include <array>
#include <cmath>

namespace thermotwin::thermal {

/// A number and its partial derivatives to N independent variables: forward-mode differentiation.
///
/// Every heat-flow law is written once, as a template over its scalar. With `double` it gives watts; with `Dual<N>` it
/// gives watts and their exact derivatives, from which the Jacobian and the forward sensitivities are assembled.
/// Source: Griewank & Walther, Evaluating Derivatives, 2nd ed. 2008, ch. 3.
template <int N>
struct Dual {
  double value = 0.0;
  std::array<double, N> partial{};

  constexpr Dual() = default;
  constexpr Dual(double v) : value(v) {}  // NOLINT(google-explicit-constructor): constants mix with duals in formulas

  /// The independent variable number `index`.
  static constexpr Dual variable(double v, int index) {
    Dual d(v);
    d.partial[index] = 1.0;
    return d;
  }

  /// f(value) with chain rule: `slope` is f'(value).
  [[nodiscard]] constexpr Dual chain(double f, double slope) const {
    Dual d(f);
    for (int i = 0; i < N; ++i) d.partial[i] = slope * partial[i];
    return d;
  }

  constexpr Dual& operator+=(Dual const& b) { return *this = *this + b; }
  constexpr Dual& operator-=(Dual const& b) { return *this = *this - b; }
  constexpr Dual& operator*=(Dual const& b) { return *this = *this * b; }
  constexpr Dual& operator/=(Dual const& b) { return *this = *this / b; }

  friend constexpr Dual operator-(Dual const& a) { return a.chain(-a.value, -1.0); }
  friend constexpr Dual operator+(Dual const& a, Dual const& b) { return combine(a, b, a.value + b.value, 1.0, 1.0); }
  friend constexpr Dual operator-(Dual const& a, Dual const& b) { return combine(a, b, a.value - b.value, 1.0, -1.0); }
  friend constexpr Dual operator*(Dual const& a, Dual const& b) {
    return combine(a, b, a.value * b.value, b.value, a.value);
  }
  friend constexpr Dual operator/(Dual const& a, Dual const& b) {
    double const inverse = 1.0 / b.value;
    return combine(a, b, a.value * inverse, inverse, -a.value * inverse * inverse);
  }
  friend constexpr bool operator<(Dual const& a, Dual const& b) { return a.value < b.value; }
  friend constexpr bool operator>(Dual const& a, Dual const& b) { return a.value > b.value; }
  friend constexpr bool operator<=(Dual const& a, Dual const& b) { return a.value <= b.value; }
  friend constexpr bool operator>=(Dual const& a, Dual const& b) { return a.value >= b.value; }

 private:
  static constexpr Dual combine(Dual const& a, Dual const& b, double f, double slope_a, double slope_b) {
    Dual d(f);
    for (int i = 0; i < N; ++i) d.partial[i] = slope_a * a.partial[i] + slope_b * b.partial[i];
    return d;
  }
};

template <int N>
Dual<N> exp(Dual<N> const& x) {
  double const f = std::exp(x.value);
  return x.chain(f, f);
}
template <int N>
Dual<N> expm1(Dual<N> const& x) {
  return x.chain(std::expm1(x.value), std::exp(x.value));
}
template <int N>
Dual<N> log(Dual<N> const& x) {
  return x.chain(std::log(x.value), 1.0 / x.value);
}
template <int N>
Dual<N> log10(Dual<N> const& x) {
  return x.chain(std::log10(x.value), 1.0 / (x.value * 2.302585092994045684));
}
template <int N>
Dual<N> sqrt(Dual<N> const& x) {
  double const f = std::sqrt(x.value);
  return x.chain(f, 0.5 / f);
}
template <int N>
Dual<N> cbrt(Dual<N> const& x) {
  double const f = std::cbrt(x.value);
  return x.chain(f, 1.0 / (3.0 * f * f));
}
template <int N>
Dual<N> pow(Dual<N> const& x, double exponent) {
  double const f = std::pow(x.value, exponent);
  return x.chain(f, exponent * (x.value != 0.0 ? f / x.value : std::pow(x.value, exponent - 1.0)));
}
template <int N>
Dual<N> pow(Dual<N> const& x, Dual<N> const& exponent) {
  return exp(exponent * log(x));
}
template <int N>
Dual<N> tanh(Dual<N> const& x) {
  double const f = std::tanh(x.value);
  return x.chain(f, 1.0 - f * f);
}
template <int N>
Dual<N> sin(Dual<N> const& x) {
  return x.chain(std::sin(x.value), std::cos(x.value));
}
template <int N>
Dual<N> cos(Dual<N> const& x) {
  return x.chain(std::cos(x.value), -std::sin(x.value));
}
template <int N>
Dual<N> tan(Dual<N> const& x) {
  double const f = std::tan(x.value);
  return x.chain(f, 1.0 + f * f);
}
template <int N>
Dual<N> abs(Dual<N> const& x) {
  return x.chain(std::abs(x.value), x.value < 0.0 ? -1.0 : 1.0);
}

/// The plain number inside a scalar of any kind.
inline double value_of(double x) { return x; }
template <int N>
double value_of(Dual<N> const& x) {
  return x.value;
}

}  // namespace thermotwin::thermal
