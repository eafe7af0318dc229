#include "models/ridge_distributed_lag.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "models/ridge.h"
#include "models/training_set.h"

namespace thermotwin::models {

std::vector<int> geometric_lags(double sample_period) {
  std::vector<int> lags = {0};
  for (double const minutes : {5.0, 10.0, 20.0, 40.0, 80.0}) {
    auto const lag = static_cast<int>(std::lround(minutes * 60.0 / sample_period));
    if (lag > lags.back()) lags.push_back(lag);
  }
  return lags;
}

ErrorModel fit_ridge_distributed_lag(std::span<Batch const> batches, FitOptions const& options) {
  if (batches.empty()) throw std::invalid_argument("no batch at all");
  check(batches.front());
  auto const set = training_set(batches, geometric_lags(sample_period(batches.front())), History::rest);
  auto const fit = ridge_regression(set.regressors, set.error, folds_of_runs(set.run_lengths, options.folds));
  return linear_model("ridge_distributed_lag", set, fit.intercept, fit.coefficients, fit.parameters,
                      fmt::format("lags to {} samples, penalty {:.3g}, {:.1f} effective parameters", set.lags.back(),
                                  fit.penalty, fit.parameters));
}

}  // namespace thermotwin::models
