#include "twin/diagnosis/birge_ratio.h"

#include <algorithm>

namespace thermotwin::twin {

double squared_birge_ratio(Estimation const& estimation, Fit const& fit) {
  double squares = 0.0, known = 0.0;
  auto const& unknowns = estimation.unknowns();
  for (std::size_t u = 0; u < unknowns.size(); ++u) {
    auto const& unknown = unknowns[u];
    if (unknown.kind != Unknown::Kind::number && unknown.kind != Unknown::Kind::lag) continue;
    auto const i = Eigen::Index(u);
    double const variance = unknown.deviation * unknown.deviation, from_mean = fit.x[i] - unknown.mean;
    squares += from_mean * from_mean / variance;
    known += std::max(0.0, 1.0 - fit.covariance(i, i) / variance);
  }
  return squares > known ? squares / known : 1.0;
}

double strictness(Estimation const& estimation, Fit const& fit) {
  double const ratio = squared_birge_ratio(estimation, fit);
  return std::min(ratio * ratio, strictest);
}

bool has_left_file(Estimation const& estimation, Fit const& fit) {
  auto const& unknowns = estimation.unknowns();
  for (std::size_t u = 0; u < unknowns.size(); ++u)
    if (unknowns[u].kind == Unknown::Kind::number && unknowns[u].departure(fit.x[Eigen::Index(u)]) > far_from_file)
      return true;
  return false;
}

}  // namespace thermotwin::twin
