#pragma once

#include <string>
#include <vector>

#include "scenarios/experiment.h"
#include "twin/file/value.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// What is odd about an experiment on a machine though it can be run, with the places in the experiment's file: inputs
/// by a name that nothing reads, or that change more than once between two rows, spectra that go on when the run has
/// ended, records that end before or whose clock was put forward, an end of the run without a row. InputError where it
/// cannot be run.
[[nodiscard]] std::vector<std::string> experiment_remarks(Value const& document,
                                                          scenarios::Experiment const& experiment,
                                                          Machine const& machine);

}  // namespace thermotwin::twin
