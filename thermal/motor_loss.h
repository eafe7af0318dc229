#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "thermal/dual.h"
#include "thermal/physical_constant.h"
#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Losses of spindle and servo motors (1.11): P = P_Cu + P_Fe + P_windage + P_friction + P_stray [W].
/// Gap windage: windage.h. Source: physics.md §1.7.

/// [1/K] of copper, about 20 °C.
inline constexpr double copper_temperature_coefficient = 0.0039;
inline constexpr Validity winding_temperature{253.15, 453.15, "temperature of a winding [K]"};

/// P = m R₂₀ [1 + 0.0039 (T_w − 20 °C)] I² [W]; m phases, R₂₀ per phase [Ω], T_w winding [K], I rms per phase [A].
template <class S>
S copper_loss(S const& phases, S const& resistance_20, S const& winding_temperature_K, S const& current) {
  within<S>(winding_temperature, winding_temperature_K);
  S const warm = 1.0 + copper_temperature_coefficient * (winding_temperature_K - reference_temperature);
  return phases * resistance_20 * warm * current * current;
}

/// I = T/k_T [A] of a permanent-magnet motor; torque T [N m], k_T [N m/A].
template <class S>
S permanent_magnet_current(S const& torque, S const& torque_constant) {
  return torque / torque_constant;
}

/// I = sqrt(I_μ² + (T/k_T)²) [A] of an induction motor; I_μ magnetising current [A], positive.
template <class S>
S induction_current(S const& magnetising_current, S const& torque, S const& torque_constant) {
  using std::sqrt;
  S const active = torque / torque_constant;
  return sqrt(S(magnetising_current * magnetising_current + active * active));
}

/// Bertotti's iron loss, P = k_h f B^n + k_e f² B² + k_ex (f B)^{1.5}, n = 1.6…2. Source: Bertotti 1988.
template <class S>
struct BertottiCoefficients {
  S hysteresis{0.0};           ///< k_h
  S eddy{0.0};                 ///< k_e
  S excess{0.0};               ///< k_ex
  S hysteresis_exponent{2.0};  ///< n
};

/// [W]; f electrical frequency [Hz] of either sign, B peak flux density [T], positive.
template <class S>
S bertotti_loss(BertottiCoefficients<S> const& k, S const& frequency, S const& flux_density) {
  using std::pow;
  constexpr double no_frequency = 1e-6;
  S const f = vanishing_power<S>(frequency, 1.0, no_frequency);
  return k.hysteresis * f * pow(flux_density, k.hysteresis_exponent) +
         k.eddy * frequency * frequency * flux_density * flux_density +
         k.excess * vanishing_power<S>(frequency, 1.5, no_frequency) * pow(flux_density, 1.5);
}

/// [1] Speed ratio below which a motor stands still.
inline constexpr double no_speed_ratio = 1e-6;

/// P = P_h r + P_e r² [W], r = n/n_r of either sign: iron loss **below base speed**, where voltage grows with speed.
template <class S>
S iron_loss(S const& hysteresis, S const& eddy, S const& speed_ratio) {
  return hysteresis * vanishing_power<S>(speed_ratio, 1.0, no_speed_ratio) + eddy * speed_ratio * speed_ratio;
}

/// As iron_loss up to the base speed r_b; above it the voltage is constant, so that the eddy part stays at P_e r_b² and
/// the hysteresis part falls as P_h r_b²/r. The two meet at r_b; the kink is rounded over 5 % of r_b.
/// Source: Modelica Standard Library, CoreLosses, P = P_ref (r_h ω_ref/ω + 1 − r_h)(V/V_ref)².
template <class S>
S iron_loss_with_field_weakening(S const& hysteresis, S const& eddy, S const& speed_ratio, double base_ratio) {
  S const r = vanishing_power<S>(speed_ratio, 1.0, no_speed_ratio);
  double const rest = 1e-2 * base_ratio;
  S const inverse = r / (r * r + rest * rest);
  S const weakened = base_ratio * base_ratio * (hysteresis * inverse + eddy);
  return blend<S>(iron_loss<S>(hysteresis, eddy, speed_ratio), weakened, r, base_ratio, 0.05 * base_ratio);
}

/// P = P_ref |ω/ω_ref|^{p+1} [W]: bearings and ventilation of a motor; p = 1…2. Source: Modelica,
/// Machines.Losses.Friction.
template <class S>
S motor_friction_loss(S const& reference, S const& speed_ratio, double torque_exponent) {
  return reference * vanishing_power<S>(speed_ratio, torque_exponent + 1.0, no_speed_ratio);
}

/// P = s P_gap = s/(1 − s) P_mech [W]: rotor loss of an induction motor, slip s, shaft power P_mech.
template <class S>
S rotor_slip_loss(S const& slip, S const& mechanical_power) {
  return slip / (1.0 - slip) * mechanical_power;
}

/// P = χ (P_Fe + P_Cu) [W]: extra loss by the converter's harmonics, χ 0.10 to 0.20.
template <class S>
S harmonics_loss(S const& share, S const& iron, S const& copper) {
  return share * (iron + copper);
}

/// Efficiency over speed and torque, bilinear between its points and constant beyond them.
class EfficiencyMap {
 public:
  /// `speeds` [rad/s] and `torques` [N m] rise, `efficiency` has 0 < η ≤ 1 for speeds × torques, row by row.
  /// Throws InputError when they do not.
  EfficiencyMap(std::vector<double> speeds, std::vector<double> torques, std::vector<double> efficiency);

  /// η(ω, T) [1].
  template <class S>
  [[nodiscard]] S at(S const& speed, S const& torque) const {
    std::size_t const i = cell(speeds_, value_of(speed));
    std::size_t const j = cell(torques_, value_of(torque));
    S const s = share(speeds_, i, speed);
    S const t = share(torques_, j, torque);
    return (1.0 - s) * ((1.0 - t) * value(i, j) + t * value(i, j + 1)) +
           s * ((1.0 - t) * value(i + 1, j) + t * value(i + 1, j + 1));
  }

 private:
  [[nodiscard]] static std::size_t cell(std::vector<double> const& grid, double x);
  [[nodiscard]] double value(std::size_t row, std::size_t column) const {
    return efficiency_[row * torques_.size() + column];
  }

  template <class S>
  [[nodiscard]] static S share(std::vector<double> const& grid, std::size_t i, S const& x) {
    S const s = (x - grid[i]) / (grid[i + 1] - grid[i]);
    if (s <= S(0.0)) return S(0.0);
    return s >= S(1.0) ? S(1.0) : s;
  }

  std::vector<double> speeds_;
  std::vector<double> torques_;
  std::vector<double> efficiency_;
};

/// P = P_mech (1/η − 1) + P₀ [W]; P₀ the loss at no load, which is what matters when air is cut.
template <class S>
S map_loss(S const& mechanical_power, S const& efficiency, S const& no_load_loss) {
  return mechanical_power * (1.0 / efficiency - 1.0) + no_load_loss;
}

}  // namespace thermotwin::thermal
