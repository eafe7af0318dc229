#include "models/back_propagation.h"

#include <fmt/format.h>

#include "models/uniform_draw.h"

namespace thermotwin::models {

namespace {

using Eigen::VectorXd;

constexpr double faster = 1.05, slower = 0.7, tolerated_rise = 1.04;

}  // namespace

Descent descend(NetworkLoss& loss, VectorXd const& start, DescentOptions const& options) {
  auto const samples = static_cast<double>(loss.samples());
  VectorXd here = start, slope, step = VectorXd::Zero(start.size()), next, next_slope;
  double level = loss.with_gradient(here, slope), rate = options.rate;
  Descent best{here, level, 0};
  while (best.epochs < options.epochs && best.loss > options.goal * samples) {
    ++best.epochs;
    step = options.momentum * step - rate / samples * slope;
    next = here + step;
    double const reached = loss.with_gradient(next, next_slope);
    if (!(reached <= tolerated_rise * level)) {
      rate *= slower;
      step.setZero();
      continue;
    }
    if (reached < level) rate *= faster;
    here.swap(next);
    slope.swap(next_slope);
    level = reached;
    if (level < best.loss) {
      best.loss = level;
      best.parameters = here;
    }
  }
  return best;
}

VectorXd random_parameters(Eigen::Index count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  return VectorXd::NullaryExpr(count, [&] { return 2.0 * uniform_draw(random) - 1.0; });
}

ErrorModel fit_back_propagation(std::span<Batch const> batches, FitOptions const& options) {
  NetworkSamples const samples(batches);
  auto loss = samples.loss();
  auto const found = descend(loss, random_parameters(loss.parameters(), options.seed), {.epochs = network_epochs});
  return samples.model(
      "back_propagation", found.parameters,
      fmt::format("{} hidden nodes, {} epochs", hidden_nodes(samples.set.regressors.cols()), found.epochs));
}

}  // namespace thermotwin::models
