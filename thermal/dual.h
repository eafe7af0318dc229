#pragma once

#include <array>
#include <cmath>
#include <type_traits>

namespace thermotwin::thermal {

/// A number and its partial derivatives to N independent variables: forward-mode differentiation.
///
/// Every heat-flow law is written once, as a template over its scalar. With `double` it gives watts; with `Dual<N>` it
/// gives watts and their exact derivatives, from which the Jacobian and the forward sensitivities are assembled; with
/// `Dual<N, Lanes>` those of four elements at a time.
/// Source: Griewank & Walther, Evaluating Derivatives, 2nd ed. 2008, ch. 3.
template <int N, class V = double>
struct Dual {
  V value{};
  std::array<V, N> partial{};

  constexpr Dual() = default;
  // NOLINTBEGIN(google-explicit-constructor): constants mix with duals in formulas
  constexpr Dual(V v) : value(v) {}
  constexpr Dual(double v) requires(!std::is_same_v<V, double>) : value(v) {}
  // NOLINTEND(google-explicit-constructor)

  /// The independent variable number `index`.
  static constexpr Dual variable(V v, int index) {
    Dual d(v);
    d.partial[index] = 1.0;
    return d;
  }

  /// f(value) with chain rule: `slope` is f'(value).
  [[nodiscard]] constexpr Dual chain(V f, V slope) const {
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
    V const inverse = 1.0 / b.value;
    return combine(a, b, a.value * inverse, inverse, -a.value * inverse * inverse);
  }
  friend constexpr bool operator<(Dual const& a, Dual const& b) { return a.value < b.value; }
  friend constexpr bool operator>(Dual const& a, Dual const& b) { return a.value > b.value; }
  friend constexpr bool operator<=(Dual const& a, Dual const& b) { return a.value <= b.value; }
  friend constexpr bool operator>=(Dual const& a, Dual const& b) { return a.value >= b.value; }

 private:
  static constexpr Dual combine(Dual const& a, Dual const& b, V f, V slope_a, V slope_b) {
    Dual d(f);
    for (int i = 0; i < N; ++i) d.partial[i] = slope_a * a.partial[i] + slope_b * b.partial[i];
    return d;
  }
};

template <int N, class V>
Dual<N, V> exp(Dual<N, V> const& x) {
  using std::exp;
  V const f = exp(x.value);
  return x.chain(f, f);
}
template <int N, class V>
Dual<N, V> expm1(Dual<N, V> const& x) {
  using std::exp, std::expm1;
  return x.chain(expm1(x.value), exp(x.value));
}
template <int N, class V>
Dual<N, V> log(Dual<N, V> const& x) {
  using std::log;
  return x.chain(log(x.value), 1.0 / x.value);
}
template <int N, class V>
Dual<N, V> log10(Dual<N, V> const& x) {
  using std::log10;
  return x.chain(log10(x.value), 1.0 / (x.value * 2.302585092994045684));
}
template <int N, class V>
Dual<N, V> sqrt(Dual<N, V> const& x) {
  using std::sqrt;
  V const f = sqrt(x.value);
  return x.chain(f, 0.5 / f);
}
template <int N, class V>
Dual<N, V> cbrt(Dual<N, V> const& x) {
  using std::cbrt;
  V const f = cbrt(x.value);
  return x.chain(f, 1.0 / (3.0 * f * f));
}
template <int N>
Dual<N> pow(Dual<N> const& x, double exponent) {
  double const f = std::pow(x.value, exponent);
  return x.chain(f, exponent * (x.value != 0.0 ? f / x.value : std::pow(x.value, exponent - 1.0)));
}
/// x > 0, as of lanes.
template <int N, class V>
Dual<N, V> pow(Dual<N, V> const& x, double exponent) {
  V const f = pow(x.value, exponent);
  return x.chain(f, exponent * f / x.value);
}
template <int N, class V>
Dual<N, V> pow(Dual<N, V> const& x, Dual<N, V> const& exponent) {
  return exp(exponent * log(x));
}
template <int N, class V>
Dual<N, V> tanh(Dual<N, V> const& x) {
  using std::tanh;
  V const f = tanh(x.value);
  return x.chain(f, 1.0 - f * f);
}
template <int N, class V>
Dual<N, V> sin(Dual<N, V> const& x) {
  using std::sin, std::cos;
  return x.chain(sin(x.value), cos(x.value));
}
template <int N, class V>
Dual<N, V> cos(Dual<N, V> const& x) {
  using std::sin, std::cos;
  return x.chain(cos(x.value), -sin(x.value));
}
template <int N, class V>
Dual<N, V> tan(Dual<N, V> const& x) {
  using std::tan;
  V const f = tan(x.value);
  return x.chain(f, 1.0 + f * f);
}
template <int N>
Dual<N> abs(Dual<N> const& x) {
  return x.chain(std::abs(x.value), x.value < 0.0 ? -1.0 : 1.0);
}

/// The plain number inside a scalar of any kind.
inline double value_of(double x) { return x; }
template <int N, class V>
V value_of(Dual<N, V> const& x) {
  return x.value;
}

}  // namespace thermotwin::thermal
