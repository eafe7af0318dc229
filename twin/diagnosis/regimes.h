#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"

namespace thermotwin::twin {

/// Names of parts of a run, and for each of its rows the one that it belongs to.
struct Regimes {
  std::vector<std::string> names;
  std::vector<std::size_t> of_row;
};

/// By spindle speed: "idle" and each speed to 10 rpm; with more than eight speeds, quarters of the largest.
[[nodiscard]] Regimes speed_regimes(MeasuredRun const& run, Eigen::VectorXd const& time);

/// By what its sensors do together, on average and over two rows: "warm-up" while it moves and they rise by more than
/// half a kelvin an hour, "cool-down" where they fall by as much, else "steady" while it moves and "idle" while it
/// stands.
[[nodiscard]] Regimes thermal_regimes(BinnedRun const& run);

/// Twelve equal parts of the run, by their hours: "0-2 h".
[[nodiscard]] Regimes time_windows(BinnedRun const& run);

}  // namespace thermotwin::twin
