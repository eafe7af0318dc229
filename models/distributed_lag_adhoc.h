#pragma once

#include <span>
#include <string>

#include "models/error_model.h"

namespace thermotwin::models {

/// What the sequential rule found.
struct LagOrder {
  int order = 0;
  std::string reason;  ///< why the next order was refused
};

/// The ad hoc estimation of Alt and Tinbergen as Miao et al. 2016 use it (methods.md §7.1): fit n = 0, 1, 2, …; stop at
/// the first n for which
///
///   - no coefficient of the newest lag is significant (t test, 5 %), or
///   - a coefficient has another sign than in the fit of n − 1, or
///   - a lagged reading is a combination of the others, or there are too few samples,
///
/// and take n − 1.
LagOrder adhoc_lag_order(std::span<Batch const> batches);

/// Distributed lag of that order.
ErrorModel fit_distributed_lag_adhoc(std::span<Batch const> batches, FitOptions const& options);

}  // namespace thermotwin::models
