#include "models/distributed_lag_adhoc.h"

#include <fmt/format.h>
#include <stdexcept>

#include "models/distributed_lag.h"
#include "models/linear_regression.h"
#include "models/training_set.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;

constexpr double dropped_above = 0.05;

LinearRegression regression(TrainingSet const& set) {
  return linear_regression(set.regressors, set.error, {regressor_names(set), set.run_lengths, {}});
}

bool enough_samples(std::span<Batch const> batches, int order) {
  Index rows = 0;
  for (auto const& batch : batches) {
    Index const own = batch.time.size() - without_history(batch, order);
    if (own < 1) return false;
    rows += own;
  }
  return rows >= batches.front().temperature_rise.cols() * (order + 1) + 2;
}

/// Why the larger of two neighbouring orders is refused; empty if it is not.
std::string objection(LinearRegression const& before, LinearRegression const& after, TrainingSet const& set) {
  auto const inputs = static_cast<Index>(set.inputs.size());
  if (after.p.tail(inputs).minCoeff() >= dropped_above)
    return fmt::format("no coefficient of lag {} is significant", set.lags.back());
  for (Index k = 0; k < before.coefficients.size(); ++k)
    if (before.coefficients(k) * after.coefficients(k) < 0)
      return fmt::format("the coefficient of {} changes its sign at order {}",
                         regressor_names(set)[static_cast<std::size_t>(k)], set.lags.back());
  return "";
}

}  // namespace

LagOrder adhoc_lag_order(std::span<Batch const> batches) {
  auto before = regression(training_set(batches));
  for (int n = 1;; ++n) {
    if (!enough_samples(batches, n)) return {n - 1, fmt::format("too few samples for order {}", n)};
    auto const set = training_set(batches, lags_up_to(n));
    try {
      auto after = regression(set);
      if (auto reason = objection(before, after, set); !reason.empty()) return {n - 1, std::move(reason)};
      before = std::move(after);
    } catch (std::invalid_argument const& error) {
      return {n - 1, error.what()};
    }
  }
}

ErrorModel fit_distributed_lag_adhoc(std::span<Batch const> batches, FitOptions const&) {
  auto const found = adhoc_lag_order(batches);
  auto const set = training_set(batches, lags_up_to(found.order));
  auto const fit = regression(set);
  return linear_model("distributed_lag_adhoc", set, fit.intercept, fit.coefficients,
                      static_cast<double>(set.regressors.cols()) + 1,
                      fmt::format("order {} by the rule: {}", found.order, found.reason));
}

}  // namespace thermotwin::models
