#pragma once

#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Losses of belts, gears, hydraulics and pumps, and the heat of cutting [W]. Source: physics.md §1.10, §1.11.

/// [1] Speed ratio below which a drive stands still.
inline constexpr double drive_standstill = 1e-6;

inline constexpr Validity belt_exponent{1.0, 1.5};
inline constexpr Validity belt_efficiency{0.95, 0.98};
inline constexpr Validity belt_pulley_share{0.3, 0.5};  ///< of the loss, to the spindle's pulley; rest: motor's, air

/// P = P_b |n/n_r|^p: a belt without load; P_b 20 to 80 W at 6000 rpm.
template <class S>
S belt_idle_loss(S const& reference, S const& speed_ratio, double exponent) {
  return reference * vanishing_power<S>(speed_ratio, exponent, drive_standstill);
}

/// P = (1 − η) P_transmitted: belt or gear stage under load.
template <class S>
S transmission_loss(S const& efficiency, S const& transmitted_power) {
  return (1.0 - efficiency) * transmitted_power;
}

inline constexpr Validity gear_efficiency{0.98, 0.99};  ///< per stage
inline constexpr Validity churning_exponent{1.7, 2.5};

/// P = P_ref |n/n_r|^p (ν/ν_r)^0.2: churning of gears in oil.
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
inline constexpr Validity accumulator_duty{0.05, 0.30};

/// q = P_el (η_hyd + σ): coolant pump; η_hyd hydraulic efficiency, σ share of the motor's loss that a submerged motor
/// leaves in the tank. The sum lies between 0.6 and 1.
template <class S>
S coolant_pump_heat(S const& electric_power, S const& hydraulic_efficiency, S const& submerged_share) {
  return electric_power * (hydraulic_efficiency + submerged_share);
}
inline constexpr Validity coolant_pump_share{0.6, 1.0};

/// P_c = k_c MRR: cutting power; specific cutting force k_c [Pa], removal rate [m³/s].
template <class S>
S cutting_power(S const& specific_force, S const& removal_rate) {
  return specific_force * removal_rate;
}

/// Who gets the heat of cutting: chip, tool (spindle nose), workpiece; the chip's share rises with cutting speed. Of
/// the chip's heat a fraction reaches bed or table.
struct CuttingHeatShares {
  double chip = 0.78;
  double tool = 0.06;
  double workpiece = 0.16;
};
inline constexpr Validity chip_share{0.70, 0.85};
inline constexpr Validity tool_share{0.03, 0.10};
inline constexpr Validity workpiece_share{0.10, 0.25};
inline constexpr Validity chips_on_bed_share{0.05, 0.30};  ///< β_chip, of the cutting power

}  // namespace thermotwin::thermal
