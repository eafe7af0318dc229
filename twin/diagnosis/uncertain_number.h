#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "thermal/dimension.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

/// Beyond so many prior deviations a number no longer is what its file says.
inline constexpr double far_from_file = 3.0;

/// A number of a machine file that its author did not know exactly: value = nominal eˣ, x ~ N(0, deviation²); one of
/// which not even the sign is known: value = nominal + x.
struct UncertainNumber {
  std::string path;  ///< bearing.front.grease_factor
  double nominal = 0.0;
  thermal::Dimension dimension;
  double deviation = 0.2;
  std::string unit = {};  ///< that its author chose; empty: a bare number
  bool of_either_sign = false;
  double lower = -INFINITY, upper = INFINITY;  ///< of x
  bool of_law = false;                         ///< of the form of a law, which mostly is as the file has it
  bool of_any_kind = false;                    ///< an `[[uncertain]]` makes it so, whatever it acts on

  [[nodiscard]] double value(double x) const;
  /// ∂value/∂x.
  [[nodiscard]] double slope(double x) const;
  /// A step of a structural loop without drawings, which may be anything.
  [[nodiscard]] bool is_any_step() const { return path.ends_with(".weight") && nominal == 0.0; }
};

/// What is uncertain in a machine file, by what kind of number it is (physics.md 8.1, as deviations of the logarithm):
///
/// | number                                   | deviation |
/// |------------------------------------------|-----------|
/// | conductance, film coefficient of contact | 0.30      |
/// | friction: grease_factor, torque, preload |           |
/// | of a ball nut                            | 0.25      |
/// | power of a loss                          | 0.25      |
/// | area of a film, film coefficient         | 0.20      |
/// | flow, resistance of a winding            | 0.20      |
/// | mass, heat capacity, capacity_factor     | 0.10      |
/// | growth of a segment of the loop, or of a |           |
/// | ball screw that has a name               | 0.10      |
/// | offset of a coolant's inlet              | 0.3 K     |
/// | viscosity_temperature of a bearing's oil | 0.04      |
/// | viscous_exponent of a bearing            | 0.30      |
/// | conductance_speed of a bearing           | 0.1 G     |
///
/// A conductance that a table leaves to its default is known no better than one that it states.
///
/// A segment of weight 0 stands for a machine without drawings: nobody knows what this body does to the channel. Its
/// weight is N(0, 1), so that the segment's length says how much it may do. Bearings have Palmgren's exponent there.
///
/// A number of which the file states a range (`[[uncertain]]`), of whatever kind but a temperature, stays within it,
/// with the deviation of an even distribution there (JCGM 100:2008, 4.3.7).
///
/// `document` gets a growth_factor of 1 wherever a segment or a screw has none, a capacity_factor wherever a bar has
/// none, a bearing's slope of viscosity, its viscous exponent and what its conductance gains with speed, and the
/// defaults of conductances, so that every path can be set.
[[nodiscard]] std::vector<UncertainNumber> uncertain_numbers(Value& document);

/// Whether the steps of a machine's structural loop are known to some per cent, none of them of weight 0.
[[nodiscard]] bool has_drawings(std::vector<UncertainNumber> const& numbers);

}  // namespace thermotwin::twin
