#pragma once

#include <span>

#include "models/error_model.h"

namespace thermotwin::models {

/// Multiple linear regression y = b₀ + Σ b_j ΔT_j by least squares: the baseline without memory.
ErrorModel fit_linear(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
