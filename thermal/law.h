#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string_view>

#include "thermal/dual.h"
#include "thermal/lanes.h"

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
};

/// Makes a Law out of a formula: a struct with the constants `name`, `ports`, `coefficients`, `inputs`, `conservative`
/// and a member `template <class S> static void flows(S const* T, S const* c, double const* u, S* q)`. One that has a
/// constant `in_lanes`, true, is dear and free of branches on S: elements with the same inputs are taken four at a
/// time.
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

  void add_heat_flows(ElementBatch const& batch, double const* temperature, double const* input,
                      double* heat) const override {
    for_elements(batch, temperature, input, [&](int e, std::array<double, P> const& q) {
      int const* port = batch.ports.data() + std::size_t(e) * P;
      for (int p = 0; p < P; ++p) heat[port[p]] += q[p];
    });
  }

  void heat_flows(ElementBatch const& batch, double const* temperature, double const* input,
                  double* flows) const override {
    for_elements(batch, temperature, input, [&](int e, std::array<double, P> const& q) {
      for (int p = 0; p < P; ++p) flows[std::size_t(e) * P + p] = q[p];
    });
  }

  /// Flat, as the evaluation in lanes.
  [[gnu::flatten]] void jacobian_blocks(ElementBatch const& batch, double const* temperature, double const* input,
                                        double* blocks) const override {
    for (int e = 0; e < batch.count; ++e) {
      int const* port = batch.ports.data() + std::size_t(e) * P;
      std::array<Dual<P>, P> T;
      for (int p = 0; p < P; ++p) T[p] = Dual<P>::variable(temperature[port[p]], p);
      std::array<Dual<P>, C + 1> c;
      for (int i = 0; i < C; ++i) c[i] = batch.coefficients[std::size_t(e) * C + i];
      auto const u = gather_inputs(batch, e, input);
      std::array<Dual<P>, P> q{};
      Formula::flows(T.data(), c.data(), u.data(), q.data());
      double* block = blocks + std::size_t(e) * P * P;
      for (int p = 0; p < P; ++p)
        for (int r = 0; r < P; ++r) block[p * P + r] = q[p].partial[r];
    }
  }

  void add_directional(ElementBatch const& batch, double const* temperature, double const* temperature_rate,
                       double const* coefficient_rate, double const* input, double* heat_rate) const override {
    for (int e = 0; e < batch.count; ++e) {
      int const* port = batch.ports.data() + std::size_t(e) * P;
      std::array<Dual<1>, P> T;
      for (int p = 0; p < P; ++p) {
        T[p].value = temperature[port[p]];
        T[p].partial[0] = temperature_rate[port[p]];
      }
      std::array<Dual<1>, C + 1> c;
      for (int i = 0; i < C; ++i) {
        c[i].value = batch.coefficients[std::size_t(e) * C + i];
        c[i].partial[0] = coefficient_rate[std::size_t(e) * C + i];
      }
      auto const u = gather_inputs(batch, e, input);
      std::array<Dual<1>, P> q{};
      Formula::flows(T.data(), c.data(), u.data(), q.data());
      for (int p = 0; p < P; ++p) heat_rate[port[p]] += q[p].partial[0];
    }
  }

 private:
  static std::array<double, U + 1> gather_inputs(ElementBatch const& batch, int e, double const* input) {
    std::array<double, U + 1> u{};
    for (int i = 0; i < U; ++i) u[i] = input[batch.inputs[std::size_t(e) * U + i]];
    return u;
  }

  static std::array<double, P> evaluate(ElementBatch const& batch, int e, double const* temperature,
                                        double const* input) {
    int const* port = batch.ports.data() + std::size_t(e) * P;
    std::array<double, P> T;
    for (int p = 0; p < P; ++p) T[p] = temperature[port[p]];
    auto const u = gather_inputs(batch, e, input);
    std::array<double, P> q{};
    Formula::flows(T.data(), batch.coefficients.data() + std::size_t(e) * C, u.data(), q.data());
    return q;
  }

#ifdef THERMOTWIN_LANES
  /// `four`: elements, of which the last may stand there several times. Flat, so that constants of the formula meet.
  [[gnu::flatten]] static std::array<Lanes, P> evaluate(ElementBatch const& batch,
                                                        std::array<int, Lanes::count> const& four,
                                                        double const* temperature, double const* input) {
    std::array<Lanes, P> T, q;
    std::array<Lanes, C + 1> c;
    for (int k = 0; k < Lanes::count; ++k) {
      for (int p = 0; p < P; ++p) T[p].value[k] = temperature[batch.ports[std::size_t(four[k]) * P + p]];
      for (int i = 0; i < C; ++i) c[i].value[k] = batch.coefficients[std::size_t(four[k]) * C + i];
    }
    auto const u = gather_inputs(batch, four[0], input);
    Formula::flows(T.data(), c.data(), u.data(), q.data());
    return q;
  }

  static bool alike(ElementBatch const& batch, int e, int other) {
    auto const inputs = batch.inputs.data();
    return std::equal(inputs + e * U, inputs + (e + 1) * U, inputs + other * U);
  }
#endif

  /// take(e, flows into the ports of element e), for every element of the batch.
  template <class Take>
  static void for_elements(ElementBatch const& batch, double const* temperature, double const* input, Take take) {
    int e = 0;
#ifdef THERMOTWIN_LANES
    if constexpr (requires { requires Formula::in_lanes; })
      while (e + 1 < batch.count) {
        std::array<int, Lanes::count> four;
        int taken = 0;
        for (int& one : four) {
          if (e + taken < batch.count && alike(batch, e, e + taken)) ++taken;
          one = e + taken - 1;
        }
        if (taken == 1) {
          take(e, evaluate(batch, e, temperature, input));
        } else {
          auto const q = evaluate(batch, four, temperature, input);
          for (int k = 0; k < taken; ++k) {
            std::array<double, P> own;
            for (int p = 0; p < P; ++p) own[p] = q[p].value[k];
            take(e + k, own);
          }
        }
        e += taken;
      }
#endif
    for (; e < batch.count; ++e) take(e, evaluate(batch, e, temperature, input));
  }
};

/// The one shared object of a formula's law.
template <class Formula>
std::shared_ptr<Law const> law_of() {
  static auto const law = std::make_shared<LawOf<Formula> const>();
  return law;
}

}  // namespace thermotwin::thermal
