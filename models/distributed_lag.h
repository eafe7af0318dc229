#pragma once

#include <span>
#include <vector>

#include "models/error_model.h"

namespace thermotwin::models {

/// The order that the paper's own rule gave: two samples of 3 min, 6 min of memory.
constexpr int distributed_lag_order = 2;

/// 0, 1, …, n.
std::vector<int> lags_up_to(int order);

/// Distributed lag of order 2 by least squares on N − 2 rows of each batch (Miao et al. 2016; methods.md §7.1):
///
///     y_t = α₀ + Σ_j Σ_{i=0..2} β_ji x_{j,t−i} + e_t
ErrorModel fit_distributed_lag(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
