#pragma once

#include <map>
#include <string>

#include "output/dataset.h"
#include "scenarios/experiment.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// Heat that reaches a body [W]: mean over a run, while the spindle or an axis moves, and while all stands.
struct MeanHeat {
  double mean = 0.0, moving = 0.0, standing = 0.0;
};

/// What one machine's parts give to each body beyond those of another, at the same temperatures: the heat of what is
/// hidden. `course` is a run of `with`, kept with its node temperatures.
///
///   q_b = Σ_{i in b} C_i (dT_i/dt|with − dT_i/dt|without)
///
/// Bodies that receive nothing are left out; none at all where a machine has relays, whose states a data set lacks.
[[nodiscard]] std::map<std::string, MeanHeat> hidden_heat(Machine const& with, Machine const& without,
                                                          scenarios::Experiment const& experiment,
                                                          output::Dataset const& course);

}  // namespace thermotwin::twin
