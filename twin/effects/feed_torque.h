#pragma once

#include <vector>

#include "thermal/feed_drive.h"
#include "thermal/lubricant.h"

/// The friction torques of a feed drive, shared by the parts that turn them into heat and the motor that supplies them.
namespace thermotwin::twin {

/// νn/(ν₄₀ n_r) from oil constants A, B, temperature T [K], speed ω and reference speed ω_r.
template <class S>
S flow_ratio(S const& scale, S const& temperature_constant, S const& temperature, double speed, S const& reference) {
  S const now = thermal::vogel_cameron_viscosity<S>(scale, temperature_constant, temperature);
  S const at_40 = thermal::vogel_cameron_viscosity<S>(scale, temperature_constant, S(313.15));
  return now / at_40 * speed / reference;
}

/// T_nut of (1.14). c = {T_pre, T_ax, φ, A, B, ω_r}.
struct NutTorque {
  static constexpr int coefficients = 6;
  template <class S>
  static S at(S const& nut, S const& screw, S const* c, double speed) {
    return thermal::ball_nut_torque<S>(c[0], c[2], flow_ratio<S>(c[3], c[4], 0.5 * (nut + screw), speed, c[5]), c[1]);
  }
  static std::vector<double> coefficients_of(double preload, double lead, double diameter, double axial_load,
                                             double efficiency, double viscous_share, thermal::Vogel const& oil,
                                             double reference_speed) {
    return {thermal::nut_preload_torque<double>(preload, lead, diameter),
            thermal::nut_load_torque<double>(axial_load, lead, efficiency),
            viscous_share,
            oil.scale,
            oil.temperature,
            reference_speed};
  }
};

/// M of (1.15). c = {M_b, A, B, ω_r}.
struct SupportTorque {
  static constexpr int coefficients = 4;
  template <class S>
  static S at(S const& temperature, S const* c, double speed) {
    return thermal::screw_bearing_torque<S>(c[0], flow_ratio<S>(c[1], c[2], temperature, speed, c[3]));
  }
};

}  // namespace thermotwin::twin
