#pragma once

#include <string>
#include <vector>

#include "scenarios/experiment.h"
#include "twin/file/value.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// What is odd about an experiment on a machine though it can be run, with the places in the experiment's file: inputs
/// that nothing reads, or that change more than once between two rows, spectra that go on when the run has ended and
/// doors that open then, records that end before or whose clock was put forward, targets of a laser beyond the stroke,
/// an end of the run without a row. InputError where it cannot be run.
[[nodiscard]] std::vector<std::string> experiment_remarks(Value const& document,
                                                          scenarios::Experiment const& experiment,
                                                          Machine const& machine);

}  // namespace thermotwin::twin
