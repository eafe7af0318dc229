#pragma once

#include <array>

#include "twin/volumetric/error_field.h"
#include "twin/volumetric/step_diagonal.h"

namespace thermotwin::twin {

/// How large the errors of a machine are, seen in two ways.
struct VolumeState {
  std::array<double, 4> diagonals{};  ///< largest |error| that the laser reads on each diagonal [m]
  double largest = 0.0;               ///< of the grid, without its rigid motion [m]
  double root_mean_square = 0.0;      ///< likewise [m]

  [[nodiscard]] double largest_diagonal() const;
};

/// The laser's readings at the stops that lie on the diagonals, and the true errors on the grid.
[[nodiscard]] VolumeState state_of(PoseFunction const& pose, StepDiagonals const& measured, VolumeGrid const& grid);

/// A compensation by what it does on the diagonals and in the volume. The diagonals that were fitted are no test:
/// where the model is wrong they get better while the volume gets worse. (methods.md §5.5, row D5)
struct Verification {
  VolumeState before, after;

  /// 1 − after/before of the grid's largest error.
  [[nodiscard]] double reduction() const { return 1.0 - after.largest / before.largest; }
  /// The diagonals got better and the volume worse.
  [[nodiscard]] bool misleading() const {
    return after.largest_diagonal() < before.largest_diagonal() && after.largest > before.largest;
  }
};

}  // namespace thermotwin::twin
