#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "twin/volumetric/error_course.h"

namespace thermotwin::twin {

/// Travel of the three linear axes, in machine coordinates.
struct Workspace {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< lowest commands [m]
  Eigen::Vector3d to = Eigen::Vector3d::Ones();    ///< highest commands [m]

  [[nodiscard]] Eigen::Vector3d travel() const { return to - from; }
};

/// The six errors of a linear axis at one position: small motions of its carriage in the machine's axes.
struct CarriageError {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< δx, δy, δz [m]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     ///< εx, εy, εz [rad]
};

/// The 21 error elements of a machine with three linear axes. (methods.md §5.1; names: ISO 230-1)
///
/// | elements                        | here                                                      |
/// |---------------------------------|-----------------------------------------------------------|
/// | EXX EYX EZX … EZZ (9)           | `courses[axis][0..2]`: δx, δy, δz of that axis [m]        |
/// | EAX EBX ECX … ECZ (9)           | `courses[axis][3..5]`: εx, εy, εz of that axis [rad]      |
/// | squareness of X-Y, X-Z, Y-Z (3) | `squareness`: the angle is 90° + S; C0Y = S_xy,           |
/// |                                 | B0Z = −S_xz, A0Z = S_yz in ISO's signs                    |
///
/// X is the primary axis: Y leans by S_xy, Z by S_xz and S_yz.
struct GeometricErrors {
  std::array<std::array<ErrorCourse, 6>, 3> courses;
  Eigen::Vector3d squareness = Eigen::Vector3d::Zero();  ///< S_xy, S_xz, S_yz [rad]

  [[nodiscard]] CarriageError at(int axis, double q) const;
};

/// No errors, over this workspace.
[[nodiscard]] GeometricErrors no_errors(Workspace const& workspace);

/// Where an element stands: axis 0…2, component 0…5.
struct ElementPlace {
  int axis;
  int component;
};

/// "EXX", …, "ECZ": the eighteen names, by axis and component.
[[nodiscard]] std::vector<std::string> element_names();
/// InputError that names the nearest element for anything else.
[[nodiscard]] ElementPlace element_place(std::string_view name);

/// How large the elements of a drawn machine are: standard deviations of their change over the whole travel.
struct ErrorSize {
  double linear = 15e-6;       ///< EXX, EYY, EZZ [m]
  double straightness = 4e-6;  ///< [m]
  double angular = 15e-6;      ///< [rad]
  double squareness = 60e-6;   ///< [rad]
};

/// Machine `seed` of the family: each element is s (g₁ u + g₂ (u² − u) + ½ Σ_{k=1,2} g₂₊ₖ sin(kπu + φₖ)), gᵢ normal,
/// φ even, u from 0 to 1 along the travel; without the line g₁ u for straightness, whose slopes are the squareness.
/// Each element has a stream of its own, so that to fix one in a file leaves the others as they were.
[[nodiscard]] GeometricErrors draw_errors(Workspace const& workspace, ErrorSize const& size, std::uint64_t seed);

}  // namespace thermotwin::twin
