#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"

namespace thermotwin::twin {

/// What a channel reads stands otherwise, by a constant, than the rest of its readings: a sensor with another offset in
/// one run than in the others, exchanged or calibrated anew; or a probe that was knocked, or set to zero, in the midst
/// of one.
struct ChangedZero {
  std::size_t run = 0, channel = 0;  ///< by their numbers; of the channel in its run
  double from = 0.0;                 ///< [s]; where the run begins: in all of it
  double deviation = 1.0;            ///< of its prior about none [K, m, rad]
  double shown = 0.0;                ///< by how much the readings themselves stand otherwise

  /// "T8 in run 2, beside the others" or "E_Z from 3.20 h of run 1 on".
  [[nodiscard]] std::string name(std::vector<BinnedRun> const& data) const;
  /// Of the samples of each row that were taken from then on.
  [[nodiscard]] Eigen::VectorXd share(BinnedRun const& run) const;
  [[nodiscard]] bool is_in_all_of(BinnedRun const& run) const { return from <= run.run->time[0]; }
};

}  // namespace thermotwin::twin
