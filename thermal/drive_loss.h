#pragma once

#include "thermal/smooth.h"

namespace thermotwin::thermal {

/// Losses of belts, gears, hydraulics and pumps, and the heat of cutting [W]. Source: physics.md §1.10, §1.11.

/// [1] Speed ratio below which a drive stands still.
inline constexpr double drive_standstill = 1e-6;

/// P = P_b |n/n_r|^p: a belt without load; P_b 20 to 80 W at 6000 rpm, p 1 to 1.5. The spindle's pulley takes 0.3 to
/// 0.5 of it, the motor's and the air the rest.
template <class S>
S belt_idle_loss(S const& reference, S const& speed_ratio, double exponent) {
  return reference * vanishing_power<S>(speed_ratio, exponent, drive_standstill);
}

/// P = (1 − η) P_transmitted: belt (η 0.95 to 0.98) or gear stage (0.98 to 0.99) under load.
template <class S>
S transmission_loss(S const& efficiency, S const& transmitted_power) {
  return (1.0 - efficiency) * transmitted_power;
}

/// P = P_ref |n/n_r|^p (ν/ν_r)^0.2: churning of gears in oil, p 1.7 to 2.5.
template <class S>
S gear_churning_loss(S const& reference, S const& speed_ratio, double exponent, S const& viscosity_ratio) {
  using std::pow;
  return reference * vanishing_power<S>(speed_ratio, exponent, drive_standstill) * pow(viscosity_ratio, 0.2);
}

/// q = Δp V̇: throttled oil; Δp [Pa], V̇ [m³/s].
template <class S>
S throttling_heat(S const& pressure_drop, S const& volume_flow) {
  return pressure_drop * volume_flow;
}

/// q = d P_el: hydraulic unit, practically all into the oil; duty d = 1 while it runs, 0.05 to 0.3 with an accumulator.
template <class S>
S hydraulic_unit_heat(S const& electric_power, S const& duty) {
  return duty * electric_power;
}

/// q = P_el (η_hyd + σ): coolant pump; η_hyd hydraulic efficiency, σ share of the motor's loss that a submerged motor
/// leaves in the tank. The sum lies between 0.6 and 1.
template <class S>
S coolant_pump_heat(S const& electric_power, S const& hydraulic_efficiency, S const& submerged_share) {
  return electric_power * (hydraulic_efficiency + submerged_share);
}

/// P_c = k_c MRR: cutting power; specific cutting force k_c [Pa], removal rate [m³/s].
template <class S>
S cutting_power(S const& specific_force, S const& removal_rate) {
  return specific_force * removal_rate;
}

/// Who gets the heat of cutting: chip (0.70 to 0.85), tool (spindle nose, 0.03 to 0.10), workpiece (0.10 to 0.25); the
/// chip's share rises with cutting speed. Of the cutting power chips bring 0.05 to 0.30 to bed or table.
struct CuttingHeatShares {
  double chip = 0.78;
  double tool = 0.06;
  double workpiece = 0.16;
};

}  // namespace thermotwin::thermal
