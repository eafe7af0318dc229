#pragma once

#include <cmath>

#include "thermal/ball_bearing.h"
#include "thermal/smooth.h"

namespace thermotwin::thermal {

/// Preload of rigidly preloaded angular contact ball bearings, and how heat and speed change it.
/// (Preloaded by springs, F_a is constant and the approach only shifts the shaft.)
/// Sources: Stein & Tu 1994; Bossmanns & Tu 1999; physics.md §1.4.

/// s in (1.7): a hot shaft unloads a back-to-back (O, DB) pair along the axis and loads a face-to-face (X, DF) one.
enum class PairArrangement { back_to_back, face_to_face };

/// What changes the gap between a ball and its two races.
template <class S>
struct PairGrowth {
  S inner{0.0};               ///< θ_i, rise of the inner ring since assembly [K]
  S outer{0.0};               ///< θ_o, of the outer ring; in a tight housing mixed with the housing's [K]
  S ball{0.0};                ///< θ_b [K]
  S centrifugal{0.0};         ///< u_cf, radial growth of the inner race [m]
  S shaft_elongation{0.0};    ///< α_s ∫θ_s dz over the span between the pair's rows [m]
  S housing_elongation{0.0};  ///< α_h ∫θ_h dz over the same span [m]
};

/// δ_n = cos α [α_b (r_i θ_i − r_o θ_o) + u_cf] + α_b D_b θ_b + s sin α ½ [shaft − housing elongation] (1.7) [m]:
/// approach of ball and races along the contact normal since assembly. α_b expansion of rings and balls [1/K].
template <class S>
S normal_approach(BallBearing const& b, PairArrangement arrangement, S const& ring_expansion, PairGrowth<S> const& g) {
  double const s = arrangement == PairArrangement::back_to_back ? -1.0 : 1.0;
  S const radial =
      ring_expansion * (b.inner_contact_radius() * g.inner - b.outer_contact_radius() * g.outer) + g.centrifugal;
  S const axial = 0.5 * s * (g.shaft_elongation - g.housing_elongation);
  return std::cos(b.contact_angle) * radial + ring_expansion * b.ball_diameter * g.ball +
         std::sin(b.contact_angle) * axial;
}

/// δ = 4.36e-4 (Q²/D_b)^{1/3} mm for Q in N and D_b in mm: one steel ball against both races, along the normal [m].
/// Source: Palmgren, as NSK prints it. Q load of one ball [N].
template <class S>
S contact_deflection(BallBearing const& b, S const& ball_load) {
  using std::pow;
  return 4.36e-8 * pow(ball_load, 2.0 / 3.0) / std::cbrt(b.ball_diameter);
}

/// Q = F_a/(z sin α) [N].
template <class S>
S ball_load(BallBearing const& b, S const& axial) {
  return axial / (b.balls * std::sin(b.contact_angle));
}

/// F_a = F_a0 (1 + δ_n/δ₀)₊^{3/2} (1.8) [N]: axial preload after the approach δ_n [m]; δ₀ is the deflection under
/// F_a0 > 0. Continuous with its slope where the preload is lost, at δ_n = −δ₀.
template <class S>
S preload(BallBearing const& b, S const& initial, S const& approach) {
  using std::pow;
  S const relative = 1.0 + approach / contact_deflection<S>(b, ball_load<S>(b, initial));
  return relative > S(0.0) ? initial * pow(relative, 1.5) : S(0.0);
}

/// δ = α r (θ_screw − θ_nut) [m]: interference of nut and screw at radius r, which changes the nut's preload as δ_n
/// does.
template <class S>
S nut_approach(S const& expansion, S const& radius, S const& screw_rise, S const& nut_rise) {
  return expansion * radius * (screw_rise - nut_rise);
}

/// g = (∂Q/∂(θ_i − θ_o))/G: loop gain of heat that feeds on its own temperature difference; G conductance from the
/// inner ring to the sink [W/K]. At 1 the bearing runs away; 0.5 is near.
template <class S>
S loop_gain(S const& heat_slope, S const& conductance) {
  return heat_slope / conductance;
}

/// A ring a ≤ r ≤ b rotating freely.
struct RotatingRing {
  double bore_radius = 0.0;   ///< a [m]
  double outer_radius = 0.0;  ///< b [m]
  double youngs_modulus = 210e9;
  double poisson_ratio = 0.3;
  double density = 7850.0;
};

/// u_r(r) = ((3+ν)(1−ν)/(8E)) ρω² r [a² + b² + ((1+ν)/(1−ν)) a²b²/r² − ((1+ν)/(3+ν)) r²] (1.9) [m].
/// Source: Timoshenko & Goodier, rotating disc, plane stress.
template <class S>
S centrifugal_growth(RotatingRing const& ring, double radius, S const& angular_speed) {
  double const nu = ring.poisson_ratio;
  double const a2 = ring.bore_radius * ring.bore_radius;
  double const b2 = ring.outer_radius * ring.outer_radius;
  double const r2 = radius * radius;
  double const shape = a2 + b2 + (1.0 + nu) / (1.0 - nu) * a2 * b2 / r2 - (1.0 + nu) / (3.0 + nu) * r2;
  double const stiffness = (3.0 + nu) * (1.0 - nu) / (8.0 * ring.youngs_modulus);
  return stiffness * ring.density * radius * shape * angular_speed * angular_speed;
}

}  // namespace thermotwin::thermal
