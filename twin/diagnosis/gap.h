#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// How far a machine is from what a channel showed in one run.
struct ChannelGap {
  std::string run, channel;
  bool displacement = false;
  std::string unit = "K";            ///< in which people read it: K, um, urad
  double before = 0.0, after = 0.0;  ///< RMS [K, m, rad] of the machine as it was and as it is amended
  double calibrated = NAN;           ///< of the machine whose numbers were fitted, without what was added to it
};

/// Both machines along the same runs, channel by channel. One constant per channel and run is taken off: an
/// instrument's offset, and the zero of a displacement, belong to no machine.
[[nodiscard]] std::vector<ChannelGap> gaps(Machine const& before, Machine const& after,
                                           std::vector<BinnedRun> const& runs, Machine const* calibrated = nullptr);

/// RMS about the mean of the values that there are; NaN if there are none.
[[nodiscard]] double spread(Eigen::VectorXd const& values);
/// Of the values that both have; 0 where one of them does not move.
[[nodiscard]] double correlation(Eigen::VectorXd const& a, Eigen::VectorXd const& b);

/// In which people read a channel's gap: K, um, urad.
[[nodiscard]] std::string unit_of(MeasuredChannel const& channel, Machine const& machine);
/// What they read then; of any unit that is SI or a millionth of it.
[[nodiscard]] double in_unit(std::string const& unit, double si);

/// All channels in one number: RMS over channels of each RMS over 0.1 K or 1 µm.
struct WholeGap {
  double before = 0.0, after = 0.0;
};
[[nodiscard]] WholeGap whole(std::vector<ChannelGap> const& gaps);

}  // namespace thermotwin::twin
