#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "models/batch.h"
#include "models/feed_axis.h"
#include "twin/study/study_file.h"
#include "twin/study/study_runs.h"

namespace thermotwin::twin {

/// One run of a world as models see it.
struct StudyRun {
  models::Batch seen;                             ///< as the instruments showed it
  std::optional<models::Batch> truth;             ///< without noise, of a simulated run
  std::optional<models::AxisRecord> axis;         ///< where the error is a slope: as the instruments showed it
  std::optional<models::AxisRecord> judged_axis;  ///< the same, with true errors where these are known
  std::vector<Eigen::Index> kept{};               ///< rows of its data set that all of these are of
};

/// The runs of a world, once for each time that instruments are drawn: once in all where all runs were measured.
///
/// Rows that lack a sensor or the error are left out. Temperatures count from the first row that is left, and so do
/// measured displacements, whose zero is another one in each run; simulated errors are what their instrument shows. A
/// sensor that a run lacks, or of which it lacks more than a tenth of the readings, is left
/// out of the whole world. `remarks` say so, and of the first repetition which rows are left out. They also say what
/// the reader of measured data remarked, and which readings the means over `sampling` lack.
struct WorldData {
  std::vector<std::vector<StudyRun>> train, test;  ///< per repetition, per run, as the file lists them
  std::vector<std::string> sensors;                ///< candidates
  std::string unit;                                ///< of the error
  std::vector<std::string> remarks;
  std::shared_ptr<WorldRuns const> runs;  ///< what all of it was read from

  [[nodiscard]] int repetitions() const { return static_cast<int>(train.size()); }
  [[nodiscard]] bool simulated() const { return train.front().front().truth.has_value(); }
};

/// What models get to see of these rows of a simulated data set, without noise: the world's sensors, and its error.
[[nodiscard]] models::Batch true_batch(StudyWorld const& world, WorldData const& data, output::Dataset const& dataset,
                                       std::vector<Eigen::Index> const& kept);

/// Simulates or reads every run of the study, each data set once, however many worlds use it. Repetition r of the d-th
/// of D different runs has the seed 1 + d + D r: independent noise everywhere, the same in every world.
///
/// InputError that names the world and the run: an unknown machine, experiment, sensor or displacement; no sensor or no
/// row left; an instant more than half a pass from any pass of the laser.
[[nodiscard]] std::vector<WorldData> study_data(Study const& study, std::function<void(double)> const& progress,
                                                std::atomic<bool> const* stop);

}  // namespace thermotwin::twin
