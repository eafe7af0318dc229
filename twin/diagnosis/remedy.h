#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/diagnosis/hypothesis.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

/// One more run, one more sensor, or both, and how far apart rivals would be then.
struct Remedy {
  std::string schedule;        ///< name; empty: no further run
  std::filesystem::path file;  ///< of the schedule
  double hours = 0.0;          ///< of the schedule
  std::string sensor;          ///< where it would sit; empty: none
  double distance = 0.0;       ///< least d_ij among the rivals, of one alone its d_i, in units of the noise
};

/// For programs.
[[nodiscard]] nlohmann::ordered_json json_of(Remedy const& remedy);

/// Effects as somebody may look for them: an amplitude each [units of the hypothesis' largest].
struct Rivals {
  std::vector<Hypothesis> hypotheses;
  std::vector<double> amplitudes;
};

/// What tells rivals apart, or shows one that is alone, that the runs so far do not: every separating schedule of the
/// catalogue, and one more sensor on every body in it (physics.md 8.10, the linear version of T-optimality). A list for
/// each, best first; all from one linearisation.
///
/// `document`: the machine without the rivals; `runs`: what was measured.
[[nodiscard]] std::vector<std::vector<Remedy>> remedies(Value const& document, std::vector<BinnedRun> const& runs,
                                                        std::vector<Rivals> const& rivals);

}  // namespace thermotwin::twin
