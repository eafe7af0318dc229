#pragma once

#include <cmath>
#include <numbers>

namespace thermotwin::thermal {

/// Geometry of an angular contact ball bearing. Defaults: none is sensible, so all are 0 but the conformity.
struct BallBearing {
  int balls = 0;
  double ball_diameter = 0.0;   ///< D_b [m]
  double pitch_diameter = 0.0;  ///< d_m [m]
  double contact_angle = 0.0;   ///< α [rad]
  double conformity = 0.52;     ///< groove radius/D_b [1]

  [[nodiscard]] double ball_radius() const { return 0.5 * ball_diameter; }
  [[nodiscard]] double pitch_radius() const { return 0.5 * pitch_diameter; }
  [[nodiscard]] double groove_radius() const { return conformity * ball_diameter; }
  /// Radius at which the balls touch the inner race [m].
  [[nodiscard]] double inner_contact_radius() const { return pitch_radius() - ball_radius() * std::cos(contact_angle); }
  /// Radius at which the balls touch the outer race [m].
  [[nodiscard]] double outer_contact_radius() const { return pitch_radius() + ball_radius() * std::cos(contact_angle); }
};

/// Geometry of a ball screw's nut.
struct BallNut {
  double nominal_diameter = 0.0;                  ///< d_n, ball centre circle [m]
  double lead = 0.0;                              ///< l [m]
  double ball_diameter = 0.0;                     ///< [m]
  double turns = 0.0;                             ///< i, circulating turns of balls
  double contact_angle = std::numbers::pi / 4.0;  ///< α [rad]

  /// ψ = atan(l/(π d_n)) [rad].
  [[nodiscard]] double lead_angle() const { return std::atan(lead / (std::numbers::pi * nominal_diameter)); }
  /// N_b = i π r_n/(cos ψ r_b): balls side by side on the helix.
  [[nodiscard]] double balls() const {
    return turns * std::numbers::pi * nominal_diameter / (std::cos(lead_angle()) * ball_diameter);
  }
};

}  // namespace thermotwin::thermal
