#include "models/distributed_lag.h"

#include <fmt/format.h>
#include <numeric>

#include "models/linear_regression.h"
#include "models/training_set.h"

namespace thermotwin::models {

std::vector<int> lags_up_to(int order) {
  std::vector<int> lags(static_cast<std::size_t>(order) + 1);
  std::iota(lags.begin(), lags.end(), 0);
  return lags;
}

ErrorModel fit_distributed_lag(std::span<Batch const> batches, FitOptions const&) {
  auto const set = training_set(batches, lags_up_to(distributed_lag_order));
  auto const fit = linear_regression(set.regressors, set.error, {regressor_names(set), set.run_lengths, {}});
  return linear_model("distributed_lag", set, fit.intercept, fit.coefficients,
                      static_cast<double>(set.regressors.cols()) + 1,
                      fmt::format("order {}, R² = {:.4f}", distributed_lag_order, fit.r_squared));
}

}  // namespace thermotwin::models
