#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "output/dataset.h"
#include "scenarios/experiment.h"
#include "twin/file/value.h"
#include "twin/machine.h"
#include "twin/study/study_file.h"

namespace thermotwin::twin {

/// The data sets of one world, in memory: readings in °C, displacements in µm, truth where simulated.
struct WorldRuns {
  Machine machine;
  std::vector<std::vector<output::Dataset>> runs;  ///< per repetition: those of 'train', then those of 'test'
  Eigen::MatrixXd mode_shapes;                     ///< all sensors of the machine × modes; empty: `no_modes` says why
  std::string no_modes;
  Value nominal;                                                  ///< the machine's document without changes
  std::vector<std::optional<scenarios::Experiment>> experiments;  ///< of each run; none where it was measured
};

/// Simulates and reads, in parallel; see study_data().
[[nodiscard]] std::vector<WorldRuns> study_runs(Study const& study, std::function<void(double)> const& progress,
                                                std::atomic<bool> const* stop);

/// Means over stretches of `period` [s]; each bears the time of its stretch's start. A stretch without any value is
/// NaN.
[[nodiscard]] output::Dataset averaged(output::Dataset const& data, double period);

}  // namespace thermotwin::twin
