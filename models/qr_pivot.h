#pragma once

#include <span>

#include "models/selection.h"

namespace thermotwin::models {

/// Column-pivoted QR of the centred readings X (instants × sensors): X Π = Q R, Π the order in which columns have most
/// length left after projection on those before (Businger & Golub, Numer. Math. 7 (1965) 269; as sensor placement
/// Manohar, Brunton, Kutz & Brunton, IEEE Control Systems 38 (2018) 63). The score is |R_ii|/√(N − 1): the deviation
/// that sensors before it leave [K]. The error is not looked at. Without a count: until less than 1 % of the sum of all
/// variances is left.
Selection select_by_qr_pivot(std::span<Batch const> batches, SelectionOptions const& options);

}  // namespace thermotwin::models
