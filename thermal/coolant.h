#pragma once

#include "thermal/smooth.h"

namespace thermotwin::thermal {

/// Coolant and oil circuits: tank, chiller, hose. Source: physics.md §2.12.

/// q = ρcV̇ (T_ret − T_t) + P_pump − UA (T_t − T_a) − G_b (T_t − T_b) − q_ev − q_ch (2.11) [W] into the tank.
template <class S>
struct TankBalance {
  S capacity_rate;        ///< ρcV̇ of the return [W/K]
  S pump_heat;            ///< that the pump leaves in the fluid [W]
  S ambient_conductance;  ///< UA of walls and surface [W/K]
  S bed_conductance;      ///< G_b to the machine's bed [W/K]
};

/// [W]; temperatures of tank, return, ambient and bed [K], heat taken by evaporation and by the chiller [W].
template <class S>
S tank_heat(TankBalance<S> const& b, S const& tank, S const& returned, S const& ambient, S const& bed,
            S const& evaporation, S const& chiller) {
  return b.capacity_rate * (returned - tank) + b.pump_heat - b.ambient_conductance * (tank - ambient) -
         b.bed_conductance * (tank - bed) - evaporation - chiller;
}

/// Relay chiller, Δ 0.2 to 2 K, compressors off for 1 to 3 min at least: on above T_set + Δ/2, off below T_set − Δ/2;
/// these are the roots the integrator looks for. The value is positive when a relay in this state must switch.
template <class S>
S relay_switch(bool is_on, S const& temperature, S const& set_point, S const& hysteresis) {
  return is_on ? set_point - 0.5 * hysteresis - temperature : temperature - set_point - 0.5 * hysteresis;
}

/// t = CΔ [1/Q_l + 1/(Q_max − Q_l)] [s]: period of a relay chiller under the constant load Q_l, 0 < Q_l < Q_max [W];
/// C capacity of the fluid it holds [J/K].
template <class S>
S relay_period(S const& capacity, S const& hysteresis, S const& load, S const& cooling_power) {
  return capacity * hysteresis * (1.0 / load + 1.0 / (cooling_power - load));
}

/// Δ + Q_max t_d/C [K]: swing of the temperature, peak to peak, when the relay acts t_d late: it overshoots by Q_l
/// t_d/C above and by (Q_max − Q_l) t_d/C below.
template <class S>
S relay_swing(S const& capacity, S const& hysteresis, S const& delay, S const& cooling_power) {
  return hysteresis + cooling_power * delay / capacity;
}

/// q = sat(K_p e + K_i ∫e dt), 0 ≤ q ≤ Q_max [W]: inverter chiller, e = T − T_set [K]. The corners are rounded over 1 %
/// of Q_max, so that it is differentiable: the chiller to choose when sensitivities are needed.
template <class S>
S inverter_chiller_heat(S const& error, S const& error_integral, S const& proportional_gain, S const& integral_gain,
                        double cooling_power) {
  double const corner = 0.01 * cooling_power;
  S const demand = proportional_gain * error + integral_gain * error_integral;
  return smooth_positive<S>(demand, corner) - smooth_positive<S>(demand - cooling_power, corner);
}

/// t = V/V̇ [s]: transport delay of a hose or pipe of volume V [m³].
template <class S>
S transport_delay(S const& volume, S const& volume_flow) {
  return volume / volume_flow;
}

}  // namespace thermotwin::thermal
