#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "thermal/dual.h"
#include "thermal/lanes.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// The elements of one law inside a network, stored side by side: element e owns `ports[e·P … e·P + P)` and so on.
struct ElementBatch {
  int count = 0;
  std::span<int const> ports;            ///< index of each port in the temperature vector
  std::span<double const> coefficients;  ///< SI
  std::span<int const> inputs;           ///< index of each channel in the operating point
};

/// A heat-flow law: from the temperatures of its ports, its coefficients and the operating point to the heat flow [W]
/// into each port. One object serves all elements of a kind; it has no state.
///
/// Heat is positive INTO the port. A law is *conservative* when its flows add up to zero (conduction, convection,
/// radiation); the others supply or withdraw heat (friction, motors, evaporation).
class Law {
 public:
  Law() = default;
  Law(Law const&) = delete;
  Law& operator=(Law const&) = delete;
  virtual ~Law() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;
  [[nodiscard]] virtual int ports() const = 0;
  [[nodiscard]] virtual int coefficients() const = 0;
  [[nodiscard]] virtual int inputs() const = 0;
  [[nodiscard]] virtual bool conservative() const = 0;
  /// Whether the blocks of its Jacobian follow from the coefficients alone.
  [[nodiscard]] virtual bool linear() const = 0;

  /// heat[port] += flow, for every element of the batch.
  virtual void add_heat_flows(ElementBatch const& batch, double const* temperature, double const* input,
                              double* heat) const = 0;

  /// flows[e·P + p] = flow into port p of element e.
  virtual void heat_flows(ElementBatch const& batch, double const* temperature, double const* input,
                          double* flows) const = 0;

  /// blocks[e·P·P + p·P + r] = ∂(flow into port p)/∂(temperature of port r) of element e.
  virtual void jacobian_blocks(ElementBatch const& batch, double const* temperature, double const* input,
                               double* blocks) const = 0;

  /// heat_rate[port] += d(flow)/dθ for a direction θ in which temperatures change by `temperature_rate` and the
  /// coefficients of each element by `coefficient_rate`.
  virtual void add_directional(ElementBatch const& batch, double const* temperature, double const* temperature_rate,
                               double const* coefficient_rate, double const* input, double* heat_rate) const = 0;

  /// Appends what one element's correlations are asked beyond their ranges. Returns the largest flow of its ports [W].
  virtual double watch(ElementBatch const& batch, int element, double const* temperature, double const* input,
                       std::vector<Extrapolation>& beyond) const = 0;
};

/// Makes a Law out of a formula: a struct with the constants `name`, `ports`, `coefficients`, `inputs`, `conservative`
/// and a member `template <class S> static void flows(S const* T, S const* c, double const* u, S* q)`. One that has a
/// constant `in_lanes`, true, is dear and free of branches on S: elements with the same inputs are taken four at a
/// time. One that has a constant `linear`, true, is so in T, and asks no input.
template <class Formula>
class LawOf final : public Law {
  static constexpr int P = Formula::ports;
  static constexpr int C = Formula::coefficients;
  static constexpr int U = Formula::inputs;

 public:
  [[nodiscard]] std::string_view name() const override { return Formula::name; }
  [[nodiscard]] int ports() const override { return P; }
  [[nodiscard]] int coefficients() const override { return C; }
  [[nodiscard]] int inputs() const override { return U; }
  [[nodiscard]] bool conservative() const override { return Formula::conservative; }
  [[nodiscard]] bool linear() const override {
    return requires { requires Formula::linear; };
  }

  void add_heat_flows(ElementBatch const& batch, double const* temperature, double const* input,
                      double* heat) const override {
    for_elements(batch, [&](auto const& elements, int taken) {
      auto const q = flows(batch, elements, temperature, input);
      for (int k = 0; k < taken; ++k)
        for (int p = 0; p < P; ++p) heat[port(batch, elements[k], p)] += lane(q[p], k);
    });
  }

  void heat_flows(ElementBatch const& batch, double const* temperature, double const* input,
                  double* result) const override {
    for_elements(batch, [&](auto const& elements, int taken) {
      auto const q = flows(batch, elements, temperature, input);
      for (int k = 0; k < taken; ++k)
        for (int p = 0; p < P; ++p) result[std::size_t(elements[k]) * P + p] = lane(q[p], k);
    });
  }

  void jacobian_blocks(ElementBatch const& batch, double const* temperature, double const* input,
                       double* blocks) const override {
    for_elements(batch, [&](auto const& elements, int taken) {
      auto const slope = slopes(batch, elements, temperature, input);
      for (int k = 0; k < taken; ++k)
        for (int i = 0; i < P * P; ++i) blocks[std::size_t(elements[k]) * P * P + i] = lane(slope[i], k);
    });
  }

  void add_directional(ElementBatch const& batch, double const* temperature, double const* temperature_rate,
                       double const* coefficient_rate, double const* input, double* heat_rate) const override {
    for_elements(batch, [&](auto const& elements, int taken) {
      auto const rate = directional(batch, elements, temperature, temperature_rate, coefficient_rate, input);
      for (int k = 0; k < taken; ++k)
        for (int p = 0; p < P; ++p) heat_rate[port(batch, elements[k], p)] += lane(rate[p], k);
    });
  }

  double watch(ElementBatch const& batch, int element, double const* temperature, double const* input,
               std::vector<Extrapolation>& beyond) const override {
    Elements<1> const one{element};
    std::array<Watched, P> T, q{};
    std::array<Watched, C + 1> c;
    for (int p = 0; p < P; ++p) T[p] = temperature_at(batch, one, p, temperature);
    for (int i = 0; i < C; ++i) c[i] = coefficient(one, i, batch.coefficients.data());
    auto const u = inputs_of(batch, element, input);
    extrapolations = &beyond;
    Formula::flows(T.data(), c.data(), u.data(), q.data());
    extrapolations = nullptr;
    double largest = 0.0;
    for (auto const& flow : q) largest = std::max(largest, std::abs(flow.value));
    return largest;
  }

 private:
  /// Elements that are taken together; of several, the last may stand there more than once.
  template <std::size_t K>
  using Elements = std::array<int, K>;
#ifdef THERMOTWIN_LANES
  template <std::size_t K>
  using Number = std::conditional_t<K == 1, double, Lanes>;
  static void set_lane(Lanes& x, std::size_t k, double value) { x.value[k] = value; }
  static double lane(Lanes const& x, int k) { return x.value[k]; }
#else
  template <std::size_t K>
  using Number = double;
#endif
  static void set_lane(double& x, std::size_t, double value) { x = value; }
  static double lane(double x, int) { return x; }

  static int port(ElementBatch const& batch, int element, int p) {
    return batch.ports[std::size_t(element) * P + std::size_t(p)];
  }

  template <std::size_t K, class Value>
  static Number<K> gather(Elements<K> const& elements, Value value) {
    Number<K> x{};
    for (std::size_t k = 0; k < K; ++k) set_lane(x, k, value(elements[k]));
    return x;
  }
  template <std::size_t K>
  static Number<K> temperature_at(ElementBatch const& batch, Elements<K> const& elements, int p,
                                  double const* temperature) {
    return gather(elements, [&](int e) { return temperature[port(batch, e, p)]; });
  }
  template <std::size_t K>
  static Number<K> coefficient(Elements<K> const& elements, int i, double const* coefficients) {
    return gather(elements, [&](int e) { return coefficients[std::size_t(e) * C + std::size_t(i)]; });
  }
  /// The same of all elements that are taken together.
  static std::array<double, U + 1> inputs_of(ElementBatch const& batch, int e, double const* input) {
    std::array<double, U + 1> u{};
    for (int i = 0; i < U; ++i) u[i] = input[batch.inputs[std::size_t(e) * U + i]];
    return u;
  }

  // Flat, so that constants of the formula meet.

  template <std::size_t K>
  [[gnu::flatten]] static std::array<Number<K>, P> flows(ElementBatch const& batch, Elements<K> const& elements,
                                                         double const* temperature, double const* input) {
    std::array<Number<K>, P> T, q{};
    for (int p = 0; p < P; ++p) T[p] = temperature_at(batch, elements, p, temperature);
    auto const u = inputs_of(batch, elements[0], input);
    if constexpr (K == 1) {
      Formula::flows(T.data(), batch.coefficients.data() + std::size_t(elements[0]) * C, u.data(), q.data());
    } else {
      std::array<Number<K>, C + 1> c;
      for (int i = 0; i < C; ++i) c[i] = coefficient(elements, i, batch.coefficients.data());
      Formula::flows(T.data(), c.data(), u.data(), q.data());
    }
    return q;
  }

  /// p·P + r: of the flow into port p, by the temperature of port r.
  template <std::size_t K>
  [[gnu::flatten]] static std::array<Number<K>, P * P> slopes(ElementBatch const& batch, Elements<K> const& elements,
                                                              double const* temperature, double const* input) {
    using S = Dual<P, Number<K>>;
    std::array<S, P> T, q{};
    std::array<S, C + 1> c;
    for (int p = 0; p < P; ++p) T[p] = S::variable(temperature_at(batch, elements, p, temperature), p);
    for (int i = 0; i < C; ++i) c[i] = coefficient(elements, i, batch.coefficients.data());
    auto const u = inputs_of(batch, elements[0], input);
    Formula::flows(T.data(), c.data(), u.data(), q.data());
    std::array<Number<K>, P * P> result;
    for (int p = 0; p < P; ++p)
      for (int r = 0; r < P; ++r) result[p * P + r] = q[p].partial[r];
    return result;
  }

  template <std::size_t K>
  [[gnu::flatten]] static std::array<Number<K>, P> directional(ElementBatch const& batch, Elements<K> const& elements,
                                                               double const* temperature,
                                                               double const* temperature_rate,
                                                               double const* coefficient_rate, double const* input) {
    using S = Dual<1, Number<K>>;
    std::array<S, P> T, q{};
    std::array<S, C + 1> c;
    for (int p = 0; p < P; ++p) {
      T[p] = temperature_at(batch, elements, p, temperature);
      T[p].partial[0] = temperature_at(batch, elements, p, temperature_rate);
    }
    for (int i = 0; i < C; ++i) {
      c[i] = coefficient(elements, i, batch.coefficients.data());
      c[i].partial[0] = coefficient(elements, i, coefficient_rate);
    }
    auto const u = inputs_of(batch, elements[0], input);
    Formula::flows(T.data(), c.data(), u.data(), q.data());
    std::array<Number<K>, P> result;
    for (int p = 0; p < P; ++p) result[p] = q[p].partial[0];
    return result;
  }

  static bool alike(ElementBatch const& batch, int e, int other) {
    auto const inputs = batch.inputs.data();
    return std::equal(inputs + e * U, inputs + (e + 1) * U, inputs + other * U);
  }

  /// take(elements, how many of them), until all of the batch were taken.
  template <class Take>
  static void for_elements(ElementBatch const& batch, Take take) {
    int e = 0;
#ifdef THERMOTWIN_LANES
    if constexpr (requires { requires Formula::in_lanes; })
      while (e + 1 < batch.count) {
        Elements<Lanes::count> four;
        int taken = 0;
        for (int& one : four) {
          if (e + taken < batch.count && alike(batch, e, e + taken)) ++taken;
          one = e + taken - 1;
        }
        if (taken == 1)
          take(Elements<1>{e}, 1);
        else
          take(four, taken);
        e += taken;
      }
#endif
    for (; e < batch.count; ++e) take(Elements<1>{e}, 1);
  }
};

/// The one shared object of a formula's law.
template <class Formula>
std::shared_ptr<Law const> law_of() {
  static auto const law = std::make_shared<LawOf<Formula> const>();
  return law;
}

}  // namespace thermotwin::thermal
