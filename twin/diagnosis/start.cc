#include "twin/diagnosis/start.h"

#include <algorithm>

#include "twin/instruments/random_stream.h"

namespace thermotwin::twin {
namespace {

constexpr std::uint64_t points_nearby = 4;
constexpr double nearby = 0.1;  // of the priors' deviations

Eigen::VectorXd drawn(Estimation const& estimation, std::uint64_t seed, double share) {
  Eigen::VectorXd x = estimation.prior_mean();
  for (std::size_t u = 0; u < estimation.unknowns().size(); ++u) {
    auto const& unknown = estimation.unknowns()[u];
    double const draw = unknown.mean + share * unknown.deviation * RandomStream(seed, unknown.name).normal();
    x[Eigen::Index(u)] = std::clamp(draw, unknown.lower, unknown.upper);
  }
  return x;
}

}  // namespace

Eigen::VectorXd drawn_start(Estimation const& estimation, std::uint64_t seed) { return drawn(estimation, seed, 1.0); }

std::vector<Eigen::VectorXd> starts(Estimation const& estimation) {
  std::vector<Eigen::VectorXd> points = {estimation.prior_mean()};
  if (has_drawings(estimation.numbers())) return points;
  for (std::uint64_t seed = 1; seed <= points_nearby; ++seed) points.push_back(drawn(estimation, seed, nearby));
  return points;
}

Fit best_fit(Estimation const& estimation, int iterations) {
  Fit best;
  for (auto const& start : starts(estimation))
    if (auto fit = estimation.fit(start, iterations); best.x.size() == 0 || fit.evidence < best.evidence)
      best = std::move(fit);
  return best;
}

}  // namespace thermotwin::twin
