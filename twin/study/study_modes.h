#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "twin/study/question.h"

namespace thermotwin::twin {

/// What the sensors of a world see of its machine's thermal modes.
struct ModeShapes {
  Eigen::MatrixXd sensors;  ///< sensors × modes
  std::string refused;      ///< why there are none; empty: there are some
};

/// What of these parts is of the first run among them: where the machine is linearised.
[[nodiscard]] std::vector<RunPart> of_first_run(std::vector<RunPart> const& parts);

/// Of the machine linearised at the mean of its inputs over these parts of one run (thermal_modes.h): nobody sees more
/// of a run than what is trained on.
[[nodiscard]] ModeShapes mode_shapes(StudyWorld const& world, WorldData const& data, std::vector<RunPart> const& parts);

}  // namespace thermotwin::twin
