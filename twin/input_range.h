#pragma once

#include <string>
#include <vector>

#include "models/batch.h"

namespace thermotwin::twin {

/// Between what changes since a run's first row [K] the fit of an error model saw an input; beside a twin, changes less
/// those that the twin says.
struct InputRange {
  double lowest = 0.0, highest = 0.0;

  /// By more than a tenth of its width, and than a step of the readings [K], so that noise at its ends is no
  /// extrapolation.
  [[nodiscard]] bool left_by(double change, double step = 0.0) const;

  bool operator==(InputRange const&) const = default;
};

/// Of every input over all runs of a fit, to 1 mK.
[[nodiscard]] std::vector<InputRange> input_ranges(std::vector<models::Batch> const& batches);

/// By how much the readings of a sensor differ that differ least: what it resolves [K]. 0 where that is more than any
/// sensor's resolution.
[[nodiscard]] double reading_step(Eigen::VectorXd const& readings);

/// "T3 changed by 9.21 K; the model was fitted on changes of -0.06 K to 7.81 K"
[[nodiscard]] std::string range_left_text(std::string const& input, double change, InputRange const& range);

}  // namespace thermotwin::twin
