#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "thermal/evaluation.h"
#include "thermal/units.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// A number of a machine file, by its path: `bearing.front.grease_factor`.
struct Parameter {
  std::string path;
  double value = 0.0;  ///< SI; a temperature in kelvin
  thermal::Dimension dimension;
  bool absolute_temperature = false;
};

/// InputError when the path leads nowhere, or to something that is no number.
[[nodiscard]] Parameter find_number(Value const& document, std::string_view path);

/// Writes another value of that parameter into the document.
void set_number(Value& document, Parameter const& parameter, double value);

/// The document with another value of that parameter.
[[nodiscard]] Value with_number(Value document, Parameter const& parameter, double value);

/// How a machine changes with one parameter θ: what forward sensitivities need. Found by building the machine with
/// θ ± h, so that every number of the file has one and no part needs to know of it.
struct MachineDerivative {
  Parameter parameter;
  thermal::NetworkDerivative network;
  std::vector<NodeWeights> sensors;        ///< d(weights)/dθ, per sensor
  std::vector<NodeWeights> displacements;  ///< d(weights)/dθ, per linear channel
};

/// (plus − minus)/(2 step) of two machines of the same structure.
[[nodiscard]] MachineDerivative difference(Machine const& plus, Machine const& minus, double step);

/// Central differences with h = 1e-4 |θ|: relative error about 1e-8 for the products and quotients of a machine file.
[[nodiscard]] MachineDerivative differentiate(Value const& document, std::string_view path);

}  // namespace thermotwin::twin
