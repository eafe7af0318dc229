#pragma once

#include <cmath>
#include <numbers>

#include "thermal/smooth.h"

namespace thermotwin::thermal {

/// Friction and kinematics of a ball-screw feed drive. Torques become heat by friction_heat (bearing_friction.h).
/// Source: physics.md §1.8 to §1.10, §2.11.

/// T_pre = 0.05 (tan β)^{−1/2} F_a0 l/(2π), tan β = l/(π d_n) (1.12) [N m]: drag torque of a preloaded nut.
/// F_a0 preload [N], l lead [m], d_n nominal diameter [m]. Source: catalogues of NSK, THK, HIWIN.
/// 40 × 10 mm, 1500 N: 0.42 N m. CAUTION: published "Q = 0.12 π n T" mixes units; heat is ωT.
template <class S>
S nut_preload_torque(S const& preload, S const& lead, S const& nominal_diameter) {
  using std::sqrt;
  S const tangent = lead / (std::numbers::pi * nominal_diameter);
  return 0.05 / sqrt(tangent) * preload * lead / (2.0 * std::numbers::pi);
}

/// [N] Axial loads below this count as none.
inline constexpr double no_axial_load = 1e-3;

/// T_ax = |F_ax| l/(2π) (1/η₁ − 1) (1.13) [N m], η₁ 0.88 to 0.95: loss under the axial load F_ax, accelerating force m
/// a included.
template <class S>
S nut_load_torque(S const& axial_load, S const& lead, S const& efficiency) {
  S const load = vanishing_power<S>(axial_load, 1.0, no_axial_load);
  return load * lead / (2.0 * std::numbers::pi) * (1.0 / efficiency - 1.0);
}

/// T(T, n) = T_ref [1 − φ + φ (νn/(ν_ref n_ref))^p]: torque of which the share φ is viscous.
/// `flow_ratio` is (ν/ν_ref)(n/n_ref), of either sign; at standstill the dry share 1 − φ is left.
template <class S>
S partly_viscous_torque(S const& reference, S const& viscous_share, S const& flow_ratio, double exponent) {
  return reference * (1.0 - viscous_share + viscous_share * smooth_power<S>(flow_ratio, exponent, 1e-8));
}

/// T_nut = T_pre [1 − φ_v + φ_v (νn/(ν₄₀ n_r))^{1/2}] + T_ax (1.14) [N m], φ_v 0.4 to 0.8.
template <class S>
S ball_nut_torque(S const& preload_torque, S const& viscous_share, S const& flow_ratio, S const& load_torque) {
  return partly_viscous_torque<S>(preload_torque, viscous_share, flow_ratio, 0.5) + load_torque;
}

/// M = M_b [0.3 + 0.7 (νn/(ν₄₀ n_r))^{2/3}] (1.15) [N m]: 60° thrust bearings of a screw; M_b catalogue drag torque,
/// 0.15 to 0.30 N m for a pair of 30 mm bore.
template <class S>
S screw_bearing_torque(S const& drag_torque, S const& flow_ratio) {
  return partly_viscous_torque<S>(drag_torque, S(0.7), flow_ratio, 2.0 / 3.0);
}

/// q = f ΔE [W]: heat of the balls' change of flank; f reversals per second [1/s], ΔE per reversal, 0.5 to 5 J.
template <class S>
S reversal_heat(S const& reversals_per_second, S const& energy) {
  return reversals_per_second * energy;
}

/// d_c = t_move/(t_move + t_dwell) [1], ramps included in t_move.
template <class S>
S duty(S const& moving_time, S const& dwell_time) {
  return moving_time / (moving_time + dwell_time);
}

/// mean |ω| = 2π v/l d_c [rad/s]: screw of lead l [m] at feed v [m/s].
template <class S>
S mean_screw_speed(S const& feed, S const& lead, S const& duty_cycle) {
  return 2.0 * std::numbers::pi * feed / lead * duty_cycle;
}

/// One stroke of a reciprocating axis: constant feed, acceleration, braking, dwell [s].
template <class S>
struct StrokeTimes {
  S feed;
  S acceleration;
  S braking;
  S dwell;
};

/// T_rms² = [T_f² t_c + (T_f + T_a)² t_a + (T_f − T_a)² t_b + T_h² t_d]/t (2.11) [N m]: torque for the copper loss;
/// T_f friction, T_a of the acceleration, T_h holding at dwell (a hanging axis).
template <class S>
S rms_torque(StrokeTimes<S> const& t, S const& friction, S const& acceleration, S const& holding) {
  using std::sqrt;
  S const speeding = friction + acceleration;
  S const braking = friction - acceleration;
  S const sum = friction * friction * t.feed + speeding * speeding * t.acceleration + braking * braking * t.braking +
                holding * holding * t.dwell;
  return sqrt(S(sum / (t.feed + t.acceleration + t.braking + t.dwell)));
}

/// [m/s] Velocities below this count as standstill.
inline constexpr double standstill_velocity = 1e-5;

/// Q = F |v| [W]; half of it goes to the rail, half to the carriage.
template <class S>
S sliding_heat(S const& force, S const& velocity) {
  return force * vanishing_power<S>(velocity, 1.0, standstill_velocity);
}

/// F = μ_r W + F_seal + c_v |v| [N]: rolling guide; μ_r 0.002 to 0.004, W load, F_seal 3 to 15 N a carriage, c_v
/// viscous drag [N s/m] at the oil's temperature.
template <class S>
S rolling_guide_force(S const& friction, S const& load, S const& seal_force, S const& viscous_drag, S const& velocity) {
  return friction * load + seal_force + viscous_drag * smooth_abs<S>(velocity, standstill_velocity);
}

/// Stribeck curve of a slideway: from μ_s at rest to μ_c, then rising with speed.
template <class S>
struct Stribeck {
  S static_friction;   ///< μ_s
  S kinetic_friction;  ///< μ_c; turcite 0.02 to 0.06
  S speed;             ///< v_s, where 63 % of the fall is done [m/s]
  S viscous;           ///< [s/m], slope of μ at high speed
};

/// μ(v) = μ_c + (μ_s − μ_c) e^{−(v/v_s)²} + k |v|, F = μ W [N].
template <class S>
S slideway_force(Stribeck<S> const& curve, S const& load, S const& velocity) {
  using std::exp;
  S const relative = velocity / curve.speed;
  S const mixed = (curve.static_friction - curve.kinetic_friction) * exp(S(-relative * relative));
  return load * (curve.kinetic_friction + mixed + curve.viscous * smooth_abs<S>(velocity, standstill_velocity));
}

}  // namespace thermotwin::thermal
