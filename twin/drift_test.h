#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "output/dataset.h"

namespace thermotwin::twin {

/// How one channel of displacement drifted, in its own unit; NaN where the run does not tell.
struct ChannelDrift {
  std::string name, unit;
  /// Highest less lowest reading, over the whole run. Noise of deviation σ widens it, the more the flatter the course:
  /// in the mean by what it spans alone at most, 4.5 σ of 50 readings, 6.5 σ of 1000.
  double range = 0.0;
  double first_hour = 0.0;  ///< 60 min after motion began, against its beginning
  double last_hour = 0.0;   ///< change in the last 60 min of motion, up to the same sample as at_stop
  double at_stop = 0.0;     ///< when motion ended: in the last sample that is not after it
  double read_at = 0.0;     ///< time of that sample [s]
  double at_end = 0.0;      ///< of the record, when the machine has rested
};

/// A run evaluated as a drift test in the style of ISO 230-3 (methods.md 9): at rest, the range that the environment
/// causes; with a turning spindle or a moving axis, the drift after 60 min, at the end of motion and after the rest
/// that follows, per channel of displacement and tilt, and for an axis with a laser at both ends of its path and
/// between them. Readings as they are, no filter; times between samples by straight lines, but for start and stop,
/// where a course bends: there the last sample before counts.
struct DriftTest {
  enum class Kind { environment, spindle, axis } kind = Kind::environment;
  double from = 0.0, to = 0.0;  ///< of the motion, start and last stop; of a test at rest the whole run [s]
  std::vector<ChannelDrift> drifts;
};

/// Nothing for a run without displacements, or of a machine without spindle and axes. `jumps`: of the inputs, in order
/// [s]; a start or a stop between two samples is where they jump, without jumps at the second of the two.
[[nodiscard]] std::optional<DriftTest> drift_test(output::Dataset const& dataset,
                                                  std::vector<double> const& jumps = {});

[[nodiscard]] std::string drift_table(DriftTest const& test);
[[nodiscard]] nlohmann::ordered_json drift_json(DriftTest const& test);

}  // namespace thermotwin::twin
