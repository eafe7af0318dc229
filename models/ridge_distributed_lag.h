#pragma once

#include <span>
#include <vector>

#include "models/error_model.h"

namespace thermotwin::models {

/// 0, 5, 10, 20, 40 and 80 min in samples of this period [s], each once.
std::vector<int> geometric_lags(double sample_period);

/// Ridge regression on readings that reach back 0, 5, 10, 20, 40 and 80 min: a response whose time constants lie
/// between minutes and hours is a sum of a few lags that grow in proportion, and the penalty, chosen by blocked
/// cross-validation, keeps their collinearity in check. What distributed lags lacked; from the literature on finite
/// lags with ridge (Maddala 1974) and on measured spindles.
ErrorModel fit_ridge_distributed_lag(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
