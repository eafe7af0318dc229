#include "twin/volumetric/verification.h"

#include <algorithm>
#include <cmath>

namespace thermotwin::twin {

double VolumeState::largest_diagonal() const { return *std::max_element(diagonals.begin(), diagonals.end()); }

VolumeState state_of(PoseFunction const& pose, StepDiagonals const& measured, VolumeGrid const& grid) {
  VolumeState state;
  for (std::size_t k = 0; k < 4; ++k)
    for (int i = 0; i <= measured.steps; ++i)
      state.diagonals[k] = std::max(state.diagonals[k], std::abs(measured.errors[k][3 * i]));
  auto const field = without_rigid_motion(sample(error_of(pose, grid.workspace.from), grid.positions()));
  state.largest = field.largest();
  state.root_mean_square = field.root_mean_square();
  return state;
}

}  // namespace thermotwin::twin
