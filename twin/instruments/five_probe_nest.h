#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>

#include "thermal/units.h"
#include "twin/file/schema.h"
#include "twin/instruments/displacement_probe.h"

namespace thermotwin::twin {

/// Five displacement probes around a test bar in the spindle: X1, Y1 at ℓ₁ and X2, Y2 at ℓ₂ from the nose, Z on its
/// end.
///
///   X_i = E_X + B z_i,   Y_i = E_Y − A z_i,   Z = E_Z,   z_i = s ℓ_i
///   B = (X1 − X2)/(z₁ − z₂),   A = −(Y1 − Y2)/(z₁ − z₂),   E_X = X2 − B z₂,   E_Y = Y2 + A z₂
///
/// E_X, E_Y, E_Z displacement of the spindle nose relative to the table [m], A, B rotation about X, Y, right hand
/// [rad]; s = +1 where the bar points to +z, −1 where it points to −z, as on a vertical machine whose z points up. With
/// s = +1 this is physics.md (3.4). Small angles. With noise σ per probe the tilt has √2 σ/|ℓ₁ − ℓ₂|: 0.1 µm over 0.1 m
/// make 1.4 µrad. (ISO 230-3; physics.md §3.3)
struct FiveProbeNest {
  double far_distance = 0.150;   ///< ℓ₁ [m]
  double near_distance = 0.050;  ///< ℓ₂ [m]
  std::string bar_points_to = "+z";
  DisplacementProbe radial;  ///< X1, Y1, X2, Y2
  DisplacementProbe axial;   ///< Z

  template <class Fields>
  static void fields(Fields& f) {
    using N = FiveProbeNest;
    namespace dimension = thermal::dimension;
    f("far_distance", &N::far_distance, dimension::length, "of X1 and Y1 from the spindle nose", Range{0, 1});
    f("near_distance", &N::near_distance, dimension::length, "of X2 and Y2 from the spindle nose", Range{0, 1});
    f.choice("bar_points_to", &N::bar_points_to, {"+z", "-z"}, "direction of the test bar, away from the nose");
    f("radial", &N::radial, "the probes X1, Y1, X2, Y2");
    f("axial", &N::axial, "the probe Z");
  }
};

/// One row per time: E_X, E_Y, E_Z [m], A, B [rad]; or X1, Y1, X2, Y2, Z [m].
using FiveColumns = Eigen::Matrix<double, Eigen::Dynamic, 5>;

inline std::array<std::string, 5> const probe_names{"X1", "Y1", "X2", "Y2", "Z"};
inline std::array<std::string, 5> const error_names{"E_X", "E_Y", "E_Z", "E_A", "E_B"};

/// InputError if both distances are equal, or for probes that check_probe refuses.
void check_nest(FiveProbeNest const& nest);

/// What the five probes see. Throws InputError if both distances are equal.
FiveColumns probe_displacements(FiveProbeNest const& nest, FiveColumns const& errors);

/// The inverse: exact but for rounding.
FiveColumns spindle_errors(FiveProbeNest const& nest, FiveColumns const& displacements);

/// What the nest is exposed to, on the time grid of the run.
struct SpindleCourse {
  Eigen::VectorXd time;           ///< [s]
  FiveColumns errors;             ///< E_X, E_Y, E_Z [m], A, B [rad]
  Eigen::VectorXd air;            ///< near the nest [K]
  Eigen::VectorXd spindle_speed;  ///< [rad/s]; empty: stands
};

struct NestReadings {
  FiveColumns probes;                   ///< X1, Y1, X2, Y2, Z [µm]
  FiveColumns errors;                   ///< E_X, E_Y, E_Z [µm], E_A, E_B [µrad], from the probes
  FiveColumns truth_probes;             ///< X1, Y1, X2, Y2, Z of perfect probes [µm]
  std::map<std::string, double> drawn;  ///< "X1.scale_error", … [SI]
};

/// Each probe is a channel of its own, named "<nest>/X1" and so on.
NestReadings read(FiveProbeNest const& nest, InstrumentChannel const& channel, SpindleCourse const& course,
                  Eigen::VectorXd const& sample_times);

}  // namespace thermotwin::twin
