#pragma once

#include <cmath>

#include "thermal/ball_bearing.h"
#include "thermal/preload.h"

namespace thermotwin::thermal {

/// How bearings and speed change what a shaft's growth does to the tool. Lengths grow with α∫θ dx; these are the rest.
/// Source: physics.md §3.2, §3.7, §1.4.

/// ε_z = −ν ρ ω² (a² + b²)/(2E) (3.7): a freely rotating ring or shaft gets shorter as it gets wider. Exact mean over
/// the section for no axial force. Ø70/22, 0.25 m long at 12 000 rpm: −3.0 µm.
template <class S>
S centrifugal_strain(RotatingRing const& shaft, S const& angular_speed) {
  double const radii = shaft.bore_radius * shaft.bore_radius + shaft.outer_radius * shaft.outer_radius;
  double const inertia = shaft.density * radii / (2.0 * shaft.youngs_modulus);
  return -shaft.poisson_ratio * inertia * angular_speed * angular_speed;
}

/// A shaft held along its axis by bearings at both ends of a span in a housing.
///
///   F = Δ/(1/k_f + 1/k_r + L/(E A)_s + L/(E A)_h),  Δ = ∫(α_s θ_s − α_h θ_h) dz,  u_f = F/k_f
///
/// F pressure in the shaft; u_f by how much it pushes the front bearing outwards. Linear: both bearings stay loaded.
struct HeldShaft {
  double front_stiffness = 0.0;     ///< k_f, along the axis, with its seat [N/m]
  double rear_stiffness = 0.0;      ///< k_r [N/m]
  double shaft_compliance = 0.0;    ///< L/(E A)_s [m/N]
  double housing_compliance = 0.0;  ///< L/(E A)_h [m/N]

  [[nodiscard]] double force_per_elongation() const {
    return 1.0 / (1.0 / front_stiffness + 1.0 / rear_stiffness + shaft_compliance + housing_compliance);
  }
  /// u_f/Δ, 0…1.
  [[nodiscard]] double front_share() const { return force_per_elongation() / front_stiffness; }
};

/// By how much a spring-preloaded angular contact bearing lets its inner ring yield along the axis, against the thrust
/// that preloads it, when rings and balls warm by θ_i, θ_o and their mean:
///
///   Δ = [cos α (r_i θ_i − r_o θ_o) + D_b ½(θ_i + θ_o)] α_b/sin α   (3.2), (1.7).
///
/// α_b expansion [1/K]. A narrow angle turns a radial mismatch into 1/tan α as much.
template <class S>
S spring_preload_shift(BallBearing const& b, double expansion, S const& inner, S const& outer) {
  return normal_approach<S>(b, PairArrangement::back_to_back, S(expansion),
                            {inner, outer, 0.5 * (inner + outer), S(0.0), S(0.0), S(0.0)}) /
         std::sin(b.contact_angle);
}

/// The same, when the balls are thrown outwards at ω: the contact angle opens at the inner race and closes at the outer
/// one. Equilibrium of a ball,
///
///   Q_i sin α_i = Q_o sin α_o = F_a/z,  Q_i cos α_i + F_c = Q_o cos α_o,  F_c = ½ m_b d_m ω_c²,
///   l_i cos α_i + l_o cos α_o = const,  Δ = const' − (l_i sin α_i + l_o sin α_o),  l = (f − ½) D_b + δ(Q),
///
/// ω_c = ½ ω (1 − D_b cos α/d_m) of the cage; δ(Q) half of contact_deflection. Rigid rings. Grows with ω⁴ while the
/// angles part little, with less than ω² when the balls lie flat. F_a [N] constant preload of
/// the bearing, density of the balls [kg/m³]. Source: Jones 1960 and Harris, without gyroscopic moment.
[[nodiscard]] double centrifugal_ball_shift(BallBearing const& b, double axial, double angular_speed,
                                            double ball_density = 7800.0);

}  // namespace thermotwin::thermal
