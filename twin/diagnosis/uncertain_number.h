#pragma once

#include <string>
#include <vector>

#include "thermal/dimension.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

/// A number of a machine file that its author did not know exactly: ln(value/nominal) ~ N(0, deviation²).
struct UncertainNumber {
  std::string path;  ///< bearing.front.grease_factor
  double nominal = 0.0;
  thermal::Dimension dimension;
  double deviation = 0.2;
  std::string unit = {};  ///< that its author chose; empty: a bare number
};

/// What is uncertain in a machine file, by what kind of number it is (physics.md 8.1, as deviations of the logarithm):
///
/// | number                                   | deviation |
/// |------------------------------------------|-----------|
/// | conductance, film coefficient of contact | 0.30      |
/// | friction: grease_factor, torque          | 0.25      |
/// | power of a loss                          | 0.25      |
/// | area of a film, film coefficient         | 0.20      |
/// | mass, heat capacity                      | 0.10      |
/// | growth of a segment of the loop          | 0.10      |
///
/// `document` gets a growth_factor of 1 wherever a segment has none, so that every path can be set.
[[nodiscard]] std::vector<UncertainNumber> uncertain_numbers(Value& document);

}  // namespace thermotwin::twin
