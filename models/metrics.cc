#include "models/metrics.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Metrics metrics(VectorXd const& truth, VectorXd const& prediction, double guard) {
  if (truth.size() != prediction.size() || truth.size() == 0)
    throw std::invalid_argument(
        fmt::format("{} true values and {} predicted ones; metrics need as many of both, and at least one",
                    truth.size(), prediction.size()));
  auto const samples = static_cast<double>(truth.size());
  VectorXd const error = truth - prediction;
  Metrics result;
  result.rmse = std::sqrt(error.squaredNorm() / samples);
  result.mae = error.cwiseAbs().sum() / samples;
  result.max = error.cwiseAbs().maxCoeff();
  double const spread = (truth.array() - truth.mean()).square().sum();
  result.r_squared = truth.maxCoeff() > truth.minCoeff() ? 1.0 - error.squaredNorm() / spread : undefined;
  double sum = 0;
  for (Index i = 0; i < truth.size(); ++i)
    if (std::abs(truth(i)) >= guard && truth(i) != 0) {
      sum += std::abs(error(i) / truth(i));
      ++result.mape_samples;
    }
  result.mape = result.mape_samples > 0 ? 100.0 * sum / static_cast<double>(result.mape_samples) : undefined;
  return result;
}

double improvement(double before, double after) {
  if (!(before > 0)) throw std::invalid_argument(fmt::format("no improvement on a metric of {:g}", before));
  return 100.0 * (1.0 - after / before);
}

double compensation_rate(VectorXd const& before, VectorXd const& after) {
  double const largest = before.size() > 0 ? before.cwiseAbs().maxCoeff() : 0.0;
  if (!(largest > 0) || after.size() == 0)
    throw std::invalid_argument("a compensation rate needs an error before and one after");
  return 1.0 - after.cwiseAbs().maxCoeff() / largest;
}

}  // namespace thermotwin::models
