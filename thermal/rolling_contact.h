#pragma once

#include <cmath>

#include "thermal/ball_bearing.h"
#include "thermal/lubricant.h"
#include "thermal/validity.h"

namespace thermotwin::thermal {

/// Friction of lubricated rolling contacts after Jungnickel 2010, eq. 9.49 (1.10):
///   Q = k₀ |ω| (|ω| e^{B/(T[°C]+95)})^{k₂},
/// k₀ from the number of contacts, the force F on each, W = F/(E' r_b²) and G = α'E', α' = 1.29e-7 ν₄₀^0.204 [1/Pa].
/// Take its exponents of speed (about 1.5) and temperature as a prior; its magnitude should be fitted.
/// For a guide, the velocity [m/s] stands for ω. Source: physics.md §1.5.
template <class S>
struct RollingFriction {
  S factor;                        ///< k₀
  double exponent = 0.0;           ///< k₂
  double vogel_temperature = 0.0;  ///< B [K]
};

/// Q [W]; ω [rad/s] (or v [m/s] of a guide), T temperature of the contact [K].
template <class S>
S rolling_friction_heat(RollingFriction<S> const& friction, S const& speed, S const& temperature) {
  using std::abs;
  using std::exp;
  using std::pow;
  within<S>(vogel_cameron_temperature, temperature);
  S const thinning = exp(friction.exponent * friction.vogel_temperature / (temperature - Vogel{}.pole));
  return friction.factor * pow(S(abs(speed)), 1.0 + friction.exponent) * thinning;
}

/// The oil in a rolling contact.
struct ContactOil {
  Vogel viscosity;
  double density = 870.0;  ///< at 40 °C [kg/m³]
  bool sealed = true;      ///< contact seals double the friction
};

/// E' [Pa]: reduced modulus of steel on steel.
inline constexpr double reduced_modulus = 2.31e11;

/// The published constants of one kind of contact.
struct ContactLaw {
  double scale;
  double material_exponent;
  double load_exponent;
  double speed_exponent;  ///< k₂
};

inline constexpr ContactLaw angular_contact_ball_law{4.31, -0.2, -0.569, 0.5386};
inline constexpr ContactLaw single_nut_law{9.16, -0.2, -0.5, 0.4936};   ///< balls in 4-point contact
inline constexpr ContactLaw double_nut_law{9.16, -0.2, -0.516, 0.512};  ///< balls in 2-point contact
inline constexpr ContactLaw guide_two_point_law{4.31, -0.2, -0.569, 0.538};
inline constexpr ContactLaw guide_four_point_law{20.0, -0.2, -0.466, 0.513};
inline constexpr ContactLaw guide_roller_law{85.7, -0.352, -0.575, 0.598};

/// k₀ = N a G^g W^w X^{k₂} F r s: `contacts` N, `force` F on each [N], `load` W, `lever` r [m], `drag` X = ρA
/// t_m/(2E').
template <class S>
RollingFriction<S> rolling_friction(ContactLaw const& law, ContactOil const& oil, S const& contacts, S const& force,
                                    S const& load, S const& drag, S const& lever) {
  using std::pow;
  double const viscosity_40 = viscosity(oil.viscosity, 313.15);
  double const material = 1.29e-7 * std::pow(viscosity_40, 0.204) * reduced_modulus;
  double const seals = oil.sealed ? 2.0 : 1.0;
  S const factor = contacts * (seals * law.scale * std::pow(material, law.material_exponent)) *
                   pow(load, law.load_exponent) * pow(drag, law.speed_exponent) * force * lever;
  return {factor, law.speed_exponent, oil.viscosity.temperature};
}

/// Angular contact ball bearing; F_a axial load [N], F = F_a/(z sin α).
template <class S>
RollingFriction<S> bearing_contact_friction(BallBearing const& b, ContactOil const& oil, S const& axial) {
  S const force = axial / (b.balls * std::sin(b.contact_angle));
  double const ratio = b.pitch_radius() / b.ball_radius();
  S const drag(oil.density * oil.viscosity.scale * ratio / (2.0 * reduced_modulus));
  S const load = force / (reduced_modulus * b.ball_radius() * b.ball_radius());
  return rolling_friction<S>(angular_contact_ball_law, oil, S(b.balls), force, load, drag, S(b.pitch_radius()));
}

/// Ball nut; preload F_pre as axial force [N], F = F_pre/(N_b sin α cos ψ); single_nut_law or double_nut_law.
template <class S>
RollingFriction<S> nut_contact_friction(ContactLaw const& law, BallNut const& nut, ContactOil const& oil,
                                        S const& preload) {
  double const cosine = std::cos(nut.lead_angle());
  double const ball_radius = 0.5 * nut.ball_diameter;
  double const radius = 0.5 * nut.nominal_diameter;
  S const force = preload / (nut.balls() * std::sin(nut.contact_angle) * cosine);
  S const drag(oil.density * oil.viscosity.scale * (radius / ball_radius) / (2.0 * reduced_modulus * cosine));
  S const load = force / (reduced_modulus * ball_radius * ball_radius);
  return rolling_friction<S>(law, oil, S(nut.balls()), force, load, drag, S(radius / cosine));
}

/// Linear ball guide; `total` sum of the normal forces on all balls [N]; guide_two_point_law or guide_four_point_law.
template <class S>
RollingFriction<S> ball_guide_contact_friction(ContactLaw const& law, int balls, double ball_radius,
                                               ContactOil const& oil, S const& total) {
  S const force = total / balls;
  S const drag(oil.density * oil.viscosity.scale / (2.0 * reduced_modulus * ball_radius));
  S const load = force / (reduced_modulus * ball_radius * ball_radius);
  return rolling_friction<S>(law, oil, S(balls), force, load, drag, S(1.0));
}

/// Linear roller guide, W = F/(E' r l); `length` l of a roller [m].
template <class S>
RollingFriction<S> roller_guide_contact_friction(int rollers, double radius, double length, ContactOil const& oil,
                                                 S const& total) {
  S const force = total / rollers;
  S const drag(oil.density * oil.viscosity.scale / (2.0 * reduced_modulus * radius));
  S const load = force / (reduced_modulus * radius * length);
  return rolling_friction<S>(guide_roller_law, oil, S(rollers), force, load, drag, S(1.0));
}

}  // namespace thermotwin::thermal
