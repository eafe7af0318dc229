#pragma once

#include <string_view>

#include "thermal/physical_constant.h"
#include "thermal/smooth.h"

namespace thermotwin::thermal {

/// The laws that every network has. The laws of single effects stand with the effects.

/// Two-ended law: the flow into port 0 leaves port 1.
template <class S>
void exchange(S const& into_first, S* q) {
  q[0] = into_first;
  q[1] = -into_first;
}

/// q = G (T₁ − T₀). c = {G [W/K]}.
struct Conductance {
  static constexpr std::string_view name = "conductance";
  static constexpr int ports = 2, coefficients = 1, inputs = 0;
  static constexpr bool conservative = true, linear = true;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    exchange<S>(c[0] * (T[1] - T[0]), q);
  }
};

/// q = u G (T₁ − T₀): a conductance that a flag opens: air that blows, coolant that floods. c = {G [W/K]}, u = {flag}.
struct SwitchedConductance {
  static constexpr std::string_view name = "switched conductance";
  static constexpr int ports = 2, coefficients = 1, inputs = 1;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    exchange<S>(u[0] * c[0] * (T[1] - T[0]), q);
  }
};

/// Conduction with k = k₂₀ (1 + b (T − 20 °C)) through equal material on both sides: exact for steady one-dimensional
/// flow, since ∫k dT = k(½(T₀+T₁)) ΔT for a linear k (Kirchhoff transform). c = {G at 20 °C [W/K], b [1/K]}.
struct TemperatureDependentConductance {
  static constexpr std::string_view name = "temperature-dependent conductance";
  static constexpr int ports = 2, coefficients = 2, inputs = 0;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    exchange<S>(c[0] * (1.0 + c[1] * (0.5 * (T[0] + T[1]) - reference_temperature)) * (T[1] - T[0]), q);
  }
};

/// Heat carried by a fluid that moves from port 0 to port 1: q₁ = ṁc (T₀ − T_ref), q₀ = −q₁; the reference 20 °C
/// only shifts the level at which enthalpy is counted. c = {c_p [J/(kg K)]}, u = {ṁ [kg/s]}.
struct Advection {
  static constexpr std::string_view name = "advection";
  static constexpr int ports = 2, coefficients = 1, inputs = 1;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    exchange<S>(-(u[0] * c[0]) * (T[0] - reference_temperature), q);
  }
};

/// q = P: heat at a constant rate while a flag is up. c = {P [W]}, u = {flag 0…1}.
struct SwitchedHeat {
  static constexpr std::string_view name = "switched heat";
  static constexpr int ports = 1, coefficients = 1, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const*, S const* c, double const* u, S* q) {
    q[0] = c[0] * u[0];
  }
};

}  // namespace thermotwin::thermal
