#include "models/linear.h"

#include <fmt/format.h>

#include "models/linear_regression.h"
#include "models/training_set.h"

namespace thermotwin::models {

ErrorModel fit_linear(std::span<Batch const> batches, FitOptions const&) {
  auto const set = training_set(batches);
  auto const fit = linear_regression(set.regressors, set.error, {set.inputs, set.run_lengths, {}});
  return linear_model("linear", set, fit.intercept, fit.coefficients, static_cast<double>(set.inputs.size()) + 1,
                      fmt::format("R² = {:.4f}", fit.r_squared));
}

}  // namespace thermotwin::models
