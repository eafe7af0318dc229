#include "models/selection_score.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include "models/candidates.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// 1 for the largest; equal values share the mean of their ranks.
VectorXd ranks_of(VectorXd const& values) {
  VectorXd ranks(values.size());
  for (Index i = 0; i < values.size(); ++i) {
    auto const above = (values.array() > values(i)).count(), equal = (values.array() == values(i)).count();
    ranks(i) = static_cast<double>(above) + (static_cast<double>(equal) + 1) / 2;
  }
  return ranks;
}

}  // namespace

SelectionScore score(Selection const& selection, VectorXd const& truth) {
  if (truth.size() != selection.score.size() || !truth.allFinite())
    throw std::invalid_argument(
        fmt::format("truth of {} sensors for a selection among {}, all finite", truth.size(), selection.score.size()));
  auto const best = by_falling_score(truth);
  auto const last = std::min(selection.sensors.size(), best.size());
  double const least = last == 0 ? 0 : truth(best[last - 1]);
  auto const informative = [&](Index sensor) { return truth(sensor) >= least && truth(sensor) > 0; };
  SelectionScore result;
  result.informative = static_cast<int>(std::count_if(best.begin(), best.end(), informative));
  result.found = static_cast<int>(std::count_if(selection.sensors.begin(), selection.sensors.end(), informative));
  result.rank_correlation = rank_correlation(selection.score, truth);
  return result;
}

double rank_correlation(VectorXd const& a, VectorXd const& b) {
  VectorXd const x = centred(ranks_of(a)), y = centred(ranks_of(b));
  double const size = x.norm() * y.norm();
  return size > 0 ? x.dot(y) / size : 0;
}

double regret(Selection const& selection, SubsetValidation const& validation, BestSubset const& optimum) {
  if (selection.sensors.size() != optimum.sensors.size())
    throw std::invalid_argument(fmt::format("a selection of {} sensors cannot be measured by the best set of {}",
                                            selection.sensors.size(), optimum.sensors.size()));
  return validation.rmse(selection.sensors) - optimum.rmse;
}

}  // namespace thermotwin::models
