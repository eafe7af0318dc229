#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/dataset.h"
#include "scenarios/experiment.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/file/value.h"
#include "twin/machine.h"
#include "twin/study/study_file.h"

namespace thermotwin::twin {

/// A thermometer that models may see.
struct WorldSensor {
  std::string name, component;
};

/// The data sets of one world, in memory: readings in °C, displacements in µm, truth where simulated.
struct WorldRuns {
  std::optional<Machine> machine;                  ///< none: the world names none, and all runs were measured
  std::vector<WorldSensor> sensors;                ///< of the machine, or of the first run
  std::string unit;                                ///< of the error
  std::vector<std::vector<output::Dataset>> runs;  ///< per repetition: those of 'train', then those of 'test'
  Value nominal;  ///< the document of a user's machine: without the changes, where these are what was simulated
  std::vector<std::optional<scenarios::Experiment>> experiments;  ///< of each run; none where it was measured
  std::vector<std::shared_ptr<MeasuredRun const>> measured;       ///< of each run; none where it is simulated
  std::size_t made = 0;  ///< data sets that were simulated or read for this world, and for none before it
};

/// Why a world without a machine has no twin and no thermal modes.
inline constexpr std::string_view no_machine = "the world names no machine";

/// FileError where a world names a machine, a run, a sensor or an error that is not there, an experiment that the
/// machine cannot be put through, one without a machine, a slope of what no laser measured, a `split` behind the end of
/// its run, or a measured run that cannot be read on it (the shipped ones, whose data may be elsewhere, are not read);
/// simulates nothing.
void check_worlds(Study const& study);

/// Simulates and reads, in parallel; see study_data().
[[nodiscard]] std::vector<WorldRuns> study_runs(Study const& study, std::function<void(double)> const& progress,
                                                std::atomic<bool> const* stop);

/// The row of the first instant at which any channel was read; what comes before it is a past.
[[nodiscard]] Eigen::Index first_reading(MeasuredRun const& run);

/// A measured run as a data set, °C and µm, from its first reading on: what its channels showed, or what `values` (row
/// × channel, SI) say in their place.
[[nodiscard]] output::Dataset dataset_of(MeasuredRun const& run, std::optional<double> sampling,
                                         Eigen::MatrixXd const* values = nullptr);

/// Means of what is not missing over stretches of `period` [s]; each bears the time of its stretch's start. A stretch
/// without any value is NaN.
[[nodiscard]] output::Dataset averaged(output::Dataset const& data, double period);

}  // namespace thermotwin::twin
