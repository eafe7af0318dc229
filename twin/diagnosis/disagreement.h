#pragma once

#include <string>
#include <vector>

#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// How far a twin is from a channel in one part of a run (physics.md 8.2).
struct Disagreement {
  std::string run, channel, unit;  ///< in which people read the channel: K, um, urad
  std::string cut;                 ///< how the run was cut: "regime", "speed" or "time" (regimes.h)
  std::string part;
  double mean = 0.0, rms = 0.0;  ///< of measured minus twin, without offsets [SI]
  double power = 0.0;            ///< Σ r²/N of the whitened residual r: 1 where it is what the noise leaves
  double p_value = 1.0;          ///< of so much or more, N power being χ² with N degrees of freedom
  bool significant = false;
};

/// Of all channels in all parts of all runs, with the estimates `x` and the noise that `estimation` expects.
/// Significant are those that the procedure of Benjamini and Hochberg (J. R. Stat. Soc. B 57 (1995) 289) finds at a
/// rate of false discoveries of 1 %, over all cells of a cut.
[[nodiscard]] std::vector<Disagreement> disagreements(Estimation const& estimation, Eigen::VectorXd const& x,
                                                      Machine const& machine);

/// Which of them are significant: false discoveries among those found are at most the share `rate` on average.
[[nodiscard]] std::vector<bool> discoveries(std::vector<double> const& p_values, double rate);

}  // namespace thermotwin::twin
