#pragma once

#include <cmath>

#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Friction of single-row angular contact ball bearings after SKF (2003 and later) (1.5): M = M_rr + M_sl.
///
/// The published formulas are in N mm, mm, N, 1/min, mm²/s; they stand here as published, with SI at the function's
/// edge. CAUTION: the centrifugal terms R₃, S₃ hold for steel balls of general design; above n d_m = 4e5 mm/min they
/// overpredict super-precision bearings. Use it for ball-screw supports, or as a bound. Seal torque: seal.h.
/// Sources: SKF General Catalogue 6000; Rolling bearings 2013; physics.md §1.2.
template <class Real>
struct SkfBearingOf {
  Real bore{0.0};                          ///< d [m]
  Real outer_diameter{0.0};                ///< D [m]
  Real r1{5.03e-7};                        ///< rolling: R₁
  Real r2{1.97};                           ///< rolling: R₂, weight of the axial load
  Real r3{1.90e-12};                       ///< rolling: R₃, centrifugal
  Real s1{1.30e-2};                        ///< sliding: S₁
  Real s2{0.68};                           ///< sliding: S₂
  Real s3{1.91e-12};                       ///< sliding: S₃
  Real replenishment{6e-8};                ///< K_rs: 6e-8 grease and oil-air, 3e-8 low oil bath and jet
  Real geometry{4.4};                      ///< K_z: 4.4 single angular contact, 3.1 other ball bearings
  Real boundary_friction{0.15};            ///< μ_bl: 0.15 in the catalogue of 2013, 0.12 in later ones
  Real elastohydrodynamic_friction{0.05};  ///< μ_EHL: 0.05 mineral, 0.04 synthetic oil
};
using SkfBearing = SkfBearingOf<double>;

/// n d_m = 4e5 mm/min.
inline constexpr Validity skf_speed_times_diameter{-41.9, 41.9,
                                                   "angular speed times diameter of a bearing after SKF [m/s]"};

namespace skf {

/// [1/min] and [N] below which a speed or a load counts as none; keeps the powers below 1 differentiable at 0.
inline constexpr double no_speed_rpm = 1e-2;
inline constexpr double no_load = 1e-3;

template <class Real>
Real mean_diameter_mm(SkfBearingOf<Real> const& b) {
  return 500.0 * (b.bore + b.outer_diameter);
}

/// n [1/min], positive, of ω [rad/s] of either sign.
template <class S>
S speed_rpm(S const& angular_speed) {
  return smooth_abs<S>(angular_speed * 9.549296585513721, no_speed_rpm);
}

}  // namespace skf

/// M_rr = Φ_ish Φ_rs G_rr (νn)^0.6 [N m], G_rr = R₁ d_m^1.97 (F_r + R₃ d_m⁴ n² + R₂ F_a)^0.54,
/// Φ_ish = 1/(1 + 1.84e-9 (n d_m)^1.28 ν^0.64), Φ_rs = exp(−K_rs ν n (d + D) sqrt(K_z/(2(D − d)))).
/// F_r, F_a loads [N], ν [m²/s], ω [rad/s].
template <class S, class Real>
S skf_rolling_torque(SkfBearingOf<Real> const& b, S const& radial, S const& axial, S const& viscosity,
                     S const& angular_speed) {
  using std::exp;
  using std::pow;
  using std::sqrt;
  Real const dm = skf::mean_diameter_mm(b);
  within<S>(skf_speed_times_diameter, angular_speed * (1e-3 * dm));
  Real const sum_mm = 1e3 * (b.bore + b.outer_diameter);
  Real const difference_mm = 1e3 * (b.outer_diameter - b.bore);
  S const n = skf::speed_rpm<S>(angular_speed);
  S const nu = 1e6 * viscosity;
  S const load = smooth_abs<S>(radial + b.r3 * dm * dm * dm * dm * n * n + b.r2 * axial, skf::no_load);
  S const geometric = b.r1 * pow(dm, 1.97) * pow(load, 0.54);
  S const inlet_heating = 1.0 / (1.0 + 1.84e-9 * pow(S(n * dm), 1.28) * pow(nu, 0.64));
  S const starvation = exp(-b.replenishment * nu * n * sum_mm * sqrt(Real(b.geometry / (2.0 * difference_mm))));
  return 1e-3 * inlet_heating * starvation * geometric * pow(S(nu * n), 0.6);
}

/// M_sl = G_sl μ_sl [N m], G_sl = S₁ d_m^0.26 ((F_r + S₃ d_m⁴ n²)^{4/3} + S₂ F_a^{4/3}),
/// μ_sl = Φ_bl μ_bl + (1 − Φ_bl) μ_EHL, Φ_bl = exp(−2.6e-8 (νn)^1.4 d_m).
template <class S, class Real>
S skf_sliding_torque(SkfBearingOf<Real> const& b, S const& radial, S const& axial, S const& viscosity,
                     S const& angular_speed) {
  using std::exp;
  using std::pow;
  Real const dm = skf::mean_diameter_mm(b);
  S const n = skf::speed_rpm<S>(angular_speed);
  S const radial_load = smooth_abs<S>(radial + b.s3 * dm * dm * dm * dm * n * n, skf::no_load);
  S const axial_load = smooth_abs<S>(axial, skf::no_load);
  S const geometric = b.s1 * pow(dm, 0.26) * (pow(radial_load, 4.0 / 3.0) + b.s2 * pow(axial_load, 4.0 / 3.0));
  S const boundary = exp(-2.6e-8 * dm * pow(S(1e6 * viscosity * n), 1.4));
  S const friction = boundary * b.boundary_friction + (1.0 - boundary) * b.elastohydrodynamic_friction;
  return 1e-3 * geometric * friction;
}

/// M = M_rr + M_sl [N m].
template <class S, class Real>
S skf_torque(SkfBearingOf<Real> const& b, S const& radial, S const& axial, S const& viscosity, S const& angular_speed) {
  return skf_rolling_torque<S>(b, radial, axial, viscosity, angular_speed) +
         skf_sliding_torque<S>(b, radial, axial, viscosity, angular_speed);
}

}  // namespace thermotwin::thermal
