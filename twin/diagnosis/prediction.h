#pragma once

#include <Eigen/Core>

#include "twin/diagnosis/measured_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// What the channels of a measured run would show if the machine were as its file says (channel_reading.h): row ×
/// channel [SI]. The machine starts at the run's 0, at start_of.
[[nodiscard]] Eigen::MatrixXd predict(Machine const& machine, MeasuredRun const& run);

}  // namespace thermotwin::twin
