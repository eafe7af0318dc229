#include "thermal/shaft_deformation.h"

#include <initializer_list>
#include <numbers>

namespace thermotwin::thermal {
namespace {

/// Distances between the centres of curvature of both races, for an angle at the inner one.
struct Spread {
  double radial = 0.0, axial = 0.0;
};

Spread spread(BallBearing const& b, double inner_cotangent, double axial_share, double centrifugal_force) {
  Spread sum;
  for (double const cotangent : {inner_cotangent, inner_cotangent + centrifugal_force / axial_share}) {
    double const angle = std::atan2(1.0, cotangent);
    double const length =
        (b.conformity - 0.5) * b.ball_diameter + 0.5 * contact_deflection<double>(b, axial_share / std::sin(angle));
    sum.radial += length * std::cos(angle);
    sum.axial += length * std::sin(angle);
  }
  return sum;
}

/// The radial spread falls as the angle at the inner race opens: bisection between flat and upright.
Spread spread_of_radial(BallBearing const& b, double radial, double axial_share, double centrifugal_force) {
  double narrow = 1e-4, wide = 0.5 * std::numbers::pi;
  for (int i = 0; i < 60; ++i) {
    double const middle = 0.5 * (narrow + wide);
    bool const too_narrow = spread(b, 1.0 / std::tan(middle), axial_share, centrifugal_force).radial > radial;
    (too_narrow ? narrow : wide) = middle;
  }
  return spread(b, 1.0 / std::tan(0.5 * (narrow + wide)), axial_share, centrifugal_force);
}

}  // namespace

double centrifugal_ball_shift(BallBearing const& b, double axial, double angular_speed, double ball_density) {
  double const mass = ball_density * std::numbers::pi / 6.0 * std::pow(b.ball_diameter, 3);
  double const cage = 0.5 * angular_speed * (1.0 - b.ball_diameter * std::cos(b.contact_angle) / b.pitch_diameter);
  double const share = axial / b.balls;
  double const free = 2.0 * (b.conformity - 0.5) * b.ball_diameter * std::cos(b.contact_angle);
  Spread const at_rest = spread_of_radial(b, free, share, 0.0);
  Spread const turning = spread_of_radial(b, free, share, 0.5 * mass * b.pitch_diameter * cage * cage);
  return at_rest.axial - turning.axial;
}

}  // namespace thermotwin::thermal
