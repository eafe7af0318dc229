#pragma once

#include <cmath>
#include <numbers>

#include "thermal/ball_bearing.h"
#include "thermal/rolling_contact.h"
#include "thermal/smooth.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Heat conductance of rolling elements between inner and outer ring, or nut and screw [W/K].
///
/// The two models of a rotating bearing differ by a factor of 7: start from 2 W/K per bearing, factor 3, and fit it.
/// Source: physics.md §2.4.

/// Half axes of a Hertzian contact ellipse [m].
template <class S>
struct ContactEllipse {
  S major;
  S minor;
};

/// Brewe & Hamrock 1977: ellipticity κ = 1.0339 (R_y/R_x)^0.636, E = 1.0003 + 0.5968 R_x/R_y, major half axis
/// (6 κ² E F R/(π E'))^{1/3}, 1/R = 1/R_x + 1/R_y.
/// R_x along, R_y across the direction of rolling [m], R_y/R_x 1 to 100, F load [N], E' = E/(1 − ν²) for two equal
/// bodies [Pa].
template <class S>
ContactEllipse<S> contact_ellipse(S const& rolling_radius, S const& cross_radius, S const& load, S const& modulus) {
  using std::cbrt;
  using std::pow;
  S const ratio = cross_radius / rolling_radius;
  S const ellipticity = 1.0339 * pow(ratio, 0.636);
  S const integral = 1.0003 + 0.5968 / ratio;
  S const radius = rolling_radius * cross_radius / (rolling_radius + cross_radius);
  S const major = cbrt(S(6.0 * ellipticity * ellipticity * integral * load * radius / (std::numbers::pi * modulus)));
  return {major, major / ellipticity};
}

/// Ellipse of ball and race; `race_radius` is positive for the inner race, negative for the outer one [m].
template <class S>
ContactEllipse<S> race_ellipse(BallBearing const& b, double race_radius, S const& ball_load, double modulus) {
  double const rolling = 1.0 / (1.0 / b.ball_radius() + 1.0 / race_radius);
  double const cross = 1.0 / (1.0 / b.ball_radius() - 1.0 / b.groove_radius());
  return contact_ellipse<S>(S(rolling), S(cross), ball_load, S(modulus));
}

/// R = 1/(4 k₁ √(ab)) + 1/(4 k₂ √(ab)) [K/W]: constriction on both sides of an elliptic contact, replaced by the circle
/// of equal area (10 to 20 % off at bearing ellipticities). Source: Yovanovich 1967.
template <class S>
S constriction_resistance(ContactEllipse<S> const& ellipse, S const& k1, S const& k2) {
  using std::sqrt;
  return (1.0 / k1 + 1.0 / k2) / (4.0 * sqrt(S(ellipse.major * ellipse.minor)));
}

/// G = z/(R_i + R_o) [W/K]: dry bearing at rest; F_a axial load [N], k of balls and rings [W/(m K)].
/// 7014C at 300 N: 0.13 W/K, so that grease and rotation dominate.
template <class S>
S static_ball_conductance(BallBearing const& b, S const& axial, S const& ball_k, S const& ring_k,
                          double modulus = 208e9 / 0.91) {
  S const load = axial / (b.balls * std::sin(b.contact_angle));
  S const inner =
      constriction_resistance<S>(race_ellipse<S>(b, b.inner_contact_radius(), load, modulus), ball_k, ring_k);
  S const outer =
      constriction_resistance<S>(race_ellipse<S>(b, -b.outer_contact_radius(), load, modulus), ball_k, ring_k);
  return S(b.balls) / (inner + outer);
}

/// [rad/s] The empirical law's logarithm ends here; slower rotation counts as this.
inline constexpr double slowest_rotation = 1.0;
inline constexpr Validity schaefer_angular_speed{-2500.0, 2500.0, "angular speed of a bearing that conducts [rad/s]"};

/// G = z (D_b²/2400) √(14 + 2 ln v − 2 ln D_b) (2.5) [W/K], D_b in **mm**, v speed of the pitch circle in **m/s**.
/// Source: Schäfer/FAG 1993, in Thermca's form. CAUTION: a public code puts D_b in m inside the logarithm.
template <class S>
S rotating_ball_conductance(BallBearing const& b, S const& angular_speed) {
  using std::log;
  using std::sqrt;
  within<S>(schaefer_angular_speed, angular_speed);
  double const ball_mm = 1e3 * b.ball_diameter;
  S const speed = b.pitch_radius() * smooth_abs<S>(angular_speed, slowest_rotation);
  return b.balls * (ball_mm * ball_mm / 2400.0) * sqrt(S(14.0 + 2.0 * log(speed) - 2.0 * std::log(ball_mm)));
}

/// What Jungnickel's contact model needs to know of the elements between two raceways.
template <class Real>
struct RollingElementsOf {
  Real count{0.0};
  Real radius{0.0};                           ///< r_b [m]
  Real pitch_radius{0.0};                     ///< r_m [m]; for a guide 1: the velocity then stands for ω
  bool four_point = false;                    ///< two contacts on either side
  Real conductivity{32.8};                    ///< of the steel [W/(m K)]
  Real diffusivity{32.8 / (7850.0 * 480.0)};  ///< of the steel [m²/s]
};
using RollingElements = RollingElementsOf<double>;

[[nodiscard]] inline RollingElements rolling_elements(BallBearing const& b) {
  return {static_cast<double>(b.balls), b.ball_radius(), b.pitch_radius()};
}

/// Of a single nut; a double nut has two of them.
[[nodiscard]] inline RollingElements rolling_elements(BallNut const& nut) {
  return {nut.balls(), 0.5 * nut.ball_diameter, 0.5 * nut.nominal_diameter};
}

/// G = G₀ + G₁ √(ω/ω_ref), as measured at rest and at a reference speed: balls that roll carry grease from ring to
/// ring.
template <class S>
S rolling_conductance(S const& at_rest, S const& gain, S const& reference_speed, double angular_speed) {
  using std::abs;
  using std::sqrt;
  return angular_speed != 0.0 ? S(at_rest + gain * sqrt(S(abs(angular_speed) / reference_speed))) : at_rest;
}

/// G = N [n g_c g_f/(2 g_c + g_f) + 0.05 k r_b], n = 1 or 2 (four-point), per element
///   g_c = 1.8 k r_b W^{1/3} [1 + W^{1/6} (ω r_b r_m/a)^{1/2}]   contact, static and renewed by rotation,
///   g_f = 0.22 k_oil r_b W^0.83 U^{−0.67}, U = η ω r_m/(2 E' r_b)   oil film,
/// F force on one contact [N], W = F/(E' r_b²), η dynamic viscosity [Pa s], k_oil [W/(m K)].
/// Source: Jungnickel 2010, p. 175.
template <class S, class Real>
S contact_model_conductance(RollingElementsOf<Real> const& e, S const& force, S const& oil_conductivity,
                            S const& dynamic_viscosity, S const& angular_speed) {
  using std::pow;
  using std::sqrt;
  constexpr double rest = 1e-3;
  S const speed = smooth_abs<S>(angular_speed, rest);
  S const load = force / (reduced_modulus * e.radius * e.radius);
  S const renewal = pow(load, 1.0 / 6.0) * sqrt(S(speed * (e.radius * e.pitch_radius / e.diffusivity)));
  S const contact = 1.8 * e.conductivity * e.radius * pow(load, 1.0 / 3.0) * (1.0 + renewal);
  S const film_speed = dynamic_viscosity * speed * (e.pitch_radius / (2.0 * reduced_modulus * e.radius));
  S const film = 0.22 * oil_conductivity * e.radius * pow(load, 0.83) * pow(film_speed, -0.67);
  S const through_contacts = (e.four_point ? 2.0 : 1.0) * contact * film / (2.0 * contact + film);
  return e.count * (through_contacts + 0.05 * e.conductivity * e.radius);
}

}  // namespace thermotwin::thermal
