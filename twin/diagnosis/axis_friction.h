#pragma once

#include <optional>
#include <string>
#include <vector>

#include "twin/diagnosis/amended_file.h"
#include "twin/diagnosis/binned_run.h"
#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// Axes whose nuts, bearings and motors have the torque of the speed while they move, by the data, where the machine's
/// file takes that of the mean speed.
struct FrictionWhileMoving {
  std::vector<std::string> axes;
  double gain = 0.0;  ///< how much likelier the runs are so, numbers at their best either way [2 ln]
  Value document;     ///< the machine so

  [[nodiscard]] std::vector<ChangedValue> changes() const;
  /// For people.
  [[nodiscard]] std::string remark() const;
};

/// Nothing where the runs are not likelier so by `threshold`, as where no axis rests in them for a part of the time.
[[nodiscard]] std::optional<FrictionWhileMoving> friction_while_moving(Value const& machine,
                                                                       std::vector<BinnedRun> const& runs,
                                                                       double threshold, FitWatch const& watch);

}  // namespace thermotwin::twin
