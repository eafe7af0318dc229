#pragma once

#include <span>

#include "models/error_model.h"

namespace thermotwin::models {

/// Principal component regression on the regressors of the distributed lag of order 2, A = [x_{j,t−i}] (Miao et al.
/// 2016; methods.md §7.3): the same equation, fewer free numbers.
ErrorModel fit_principal_component_distributed_lag(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
