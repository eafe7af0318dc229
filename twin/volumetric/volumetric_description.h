#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "thermal/physical_constant.h"
#include "twin/description.h"
#include "twin/file/schema.h"

/// What `[volumetric]` of a machine file says, as plain structs.
namespace thermotwin::twin {

/// `volumetric.axis`: a linear axis and, where a screw positions it, how the nut runs along the screw.
struct VolumetricAxisDescription {
  std::string name;
  double from = required, to = required;
  std::string screw;
  std::optional<double> screw_from, screw_to;

  template <class Fields>
  static void fields(Fields& f) {
    using A = VolumetricAxisDescription;
    f.name("name", &A::name, "x, y or z");
    f("from", &A::from, dimension::length, "lowest command of the volume");
    f("to", &A::to, dimension::length, "highest command of the volume");
    f("screw", &A::screw, "ball_screw whose growth enters the linear error; default: none");
    f("screw_from", &A::screw_from, dimension::length, "where the nut stands on the screw at `from`");
    f("screw_to", &A::screw_to, dimension::length, "where the nut stands on the screw at `to`");
  }
};

template <thermal::Dimension of>
struct HarmonicDescription {
  double amplitude = required, period = required, phase = 0.0;

  template <class Fields>
  static void fields(Fields& f) {
    using H = HarmonicDescription;
    f("amplitude", &H::amplitude, of, "of the sine");
    f("period", &H::period, dimension::length, "along the axis", above_zero);
    f("phase", &H::phase, dimension::angle, "at `from`");
  }
};

/// `volumetric.translation` and `volumetric.rotation`: one error element; what is given adds up.
template <thermal::Dimension of>
struct ElementDescription {
  std::string name;
  std::vector<double> positions, values, polynomial;
  std::vector<HarmonicDescription<of>> harmonic;

  template <class Fields>
  static void fields(Fields& f) {
    using E = ElementDescription;
    f.name("name", &E::name, "EXX, EYX, …, ECZ (ISO 230-1): letter of the motion, letter of the axis");
    f("positions", &E::positions, dimension::length, "of a table, ascending");
    f("values", &E::values, of, "of that table; linear between");
    f("polynomial", &E::polynomial, of, "c0, c1, c2, …: Σ c_k uᵏ, u from 0 to 1 along the travel");
    f("harmonic", &E::harmonic, "sines along the travel");
  }
};

/// `volumetric.growth`: a displacement or rotation channel of a run that moves an element.
struct GrowthDescription {
  std::string channel, element;
  double factor = 1.0;

  template <class Fields>
  static void fields(Fields& f) {
    using G = GrowthDescription;
    f.name("channel", &G::channel, "displacement or rotation of the structural loop: E_Y, A");
    f.name("element", &G::element, "what it adds to: EXX … ECZ all along the axis, squareness_xy, _xz or _yz");
    f("factor", &G::factor, dimension::dimensionless, "sign and share");
  }
};

/// `volumetric.drawn`: elements that the file does not give are drawn with these standard deviations.
struct DrawnDescription {
  std::uint64_t seed = 1;
  double linear = 15e-6, straightness = 4e-6, angular = 15e-6, squareness = 60e-6;

  template <class Fields>
  static void fields(Fields& f) {
    using D = DrawnDescription;
    f("seed", &D::seed, "the same seed draws the same machine");
    f("linear", &D::linear, dimension::length, "change of EXX, EYY, EZZ over the travel, rms", Range{0, 1e-3});
    f("straightness", &D::straightness, dimension::length, "rms", Range{0, 1e-3});
    f("angular", &D::angular, dimension::tilt, "change over the travel, rms", Range{0, 1e-3});
    f("squareness", &D::squareness, dimension::tilt, "rms", Range{0, 1e-2});
  }
};

/// `volumetric.measurement`: the step-diagonal measurement that `thermotwin volumetric` makes; the laser itself is
/// `[laser]`. What stands here in rms is drawn once per diagonal.
struct StepDiagonalDescription {
  int steps = 10;
  int passes = 1;
  double mirror_misalignment = 0.1e-3, beam_misalignment = 0.1e-3;
  double air_temperature = thermal::reference_temperature, air_drift = 0.0;
  double linear_noise = 0.2e-6;

  template <class Fields>
  static void fields(Fields& f) {
    using S = StepDiagonalDescription;
    f("steps", &S::steps, "of each axis along a diagonal", Range{2, 200});
    f("passes", &S::passes, "whose mean is taken", Range{1, 100});
    f("mirror_misalignment", &S::mirror_misalignment, dimension::tilt,
      "of the flat mirror's normal against the diagonal, in each of two directions, rms", Range{0, 0.01});
    f("beam_misalignment", &S::beam_misalignment, dimension::tilt,
      "of the beam against the diagonal, in each of two directions, rms", Range{0, 0.01});
    f.temperature("air_temperature", &S::air_temperature, "in the laser's path at the start");
    f("air_drift", &S::air_drift, dimension::temperature_rate, "of the air while measuring");
    f("linear_noise", &S::linear_noise, dimension::length, "of the total travel of an axis, measured on its own, rms",
      Range{0, 1e-4});
  }
};

/// `[volumetric]`: 21 error elements of a machine with three linear axes.
struct VolumetricDescription {
  std::string chain = "XYFZ", convention = "tool-relative";
  Eigen::Vector3d tool_offset = Eigen::Vector3d::Zero();
  std::optional<double> squareness_xy, squareness_xz, squareness_yz;
  std::vector<VolumetricAxisDescription> axis;
  std::vector<ElementDescription<dimension::length>> translation;
  std::vector<ElementDescription<dimension::tilt>> rotation;
  std::vector<GrowthDescription> growth;
  std::optional<DrawnDescription> drawn;
  StepDiagonalDescription measurement;

  template <class Fields>
  static void fields(Fields& f) {
    using V = VolumetricDescription;
    f.choice("chain", &V::chain, {"FXYZ", "XFYZ", "XYFZ", "XYZF"},
             "axes before F carry the workpiece, those after it the tool");
    f.choice("convention", &V::convention, {"tool-relative", "body-fixed"},
             "what the elements are motions of: tool side against workpiece side of a joint, or the moving carriage");
    f("tool_offset", &V::tool_offset, dimension::length, "tool tip from the reference point of the last carriage");
    f("squareness_xy", &V::squareness_xy, dimension::tilt, "angle between X and Y less 90 deg");
    f("squareness_xz", &V::squareness_xz, dimension::tilt, "angle between X and Z less 90 deg");
    f("squareness_yz", &V::squareness_yz, dimension::tilt, "angle between Y and Z less 90 deg");
    f("axis", &V::axis, "x, y and z, each once");
    f("translation", &V::translation, "error elements that are lengths");
    f("rotation", &V::rotation, "error elements that are angles");
    f("growth", &V::growth, "what the machine's warming moves, from a run");
    f("drawn", &V::drawn, "draws what is not given; without it that is zero");
    f("measurement", &V::measurement, "with the laser along the body diagonals");
  }
};

}  // namespace thermotwin::twin
