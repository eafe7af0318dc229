#pragma once

#include <span>

#include "models/selection.h"

namespace thermotwin::models {

/// Sequential forward selection: from the empty set on, always the sensor that lowers the RMSE of the blocked
/// cross-validation of a linear regression most (subset_validation.h; Whitney, IEEE Trans. Computers C-20 (1971) 1100).
/// Without a count: as long as one more sensor lowers it by 1 %, one at least. The score of a sensor is by how much it
/// lowered the RMSE when it was taken; of the others, by how much it would have lowered it at the last step [µm].
Selection select_forward(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
