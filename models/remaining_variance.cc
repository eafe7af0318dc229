#include "models/remaining_variance.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace thermotwin::models {

void check(PlacementProblem const& problem) {
  auto const refuse = [](std::string const& why) { throw std::invalid_argument("sensor placement: " + why); };
  auto const n = problem.sites();
  if (n == 0) refuse("there is no site");
  if (problem.readings.cols() != n || problem.cross.rows() != n || problem.noise.size() != n ||
      (problem.cost.size() != 0 && problem.cost.size() != n))
    refuse(fmt::format("{} sites, but covariances of {} × {} and {} rows, {} noises and {} costs", n, n,
                       problem.readings.cols(), problem.cross.rows(), problem.noise.size(), problem.cost.size()));
  if (!problem.readings.allFinite() || !problem.cross.allFinite() || !std::isfinite(problem.prior))
    refuse("a covariance is not finite");
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!(problem.noise[i] > 0.0))
      refuse(fmt::format("the noise of site {} is {}; it must be > 0", i, problem.noise[i]));
    if (!(problem.cost_of(i) > 0.0))
      refuse(fmt::format("the cost of site {} is {}; it must be > 0", i, problem.cost[i]));
  }
}

RemainingVariance::RemainingVariance(PlacementProblem const& problem, Eigen::Index most)
    : problem_(&problem),
      variance_(problem.readings.diagonal()),
      cross_(problem.cross),
      factor_(problem.sites(), most),
      value_(problem.prior) {
  find_gains();
}

void RemainingVariance::add(Eigen::Index site) {
  auto const k = Eigen::Index(sensors_.size());
  double const deviation = std::sqrt(variance_[site] + problem_->noise[site]);
  auto column = factor_.col(k);
  column = problem_->readings.col(site);
  if (k > 0) column.noalias() -= factor_.leftCols(k) * factor_.row(site).head(k).transpose();
  column /= deviation;
  Eigen::RowVectorXd const told = cross_.row(site) / deviation;
  value_ -= told.squaredNorm();
  cross_.noalias() -= column * told;
  variance_ -= column.cwiseAbs2();
  variance_ = variance_.cwiseMax(0.0);
  sensors_.push_back(site);
  find_gains();
}

void RemainingVariance::find_gains() {
  gains_ = cross_.rowwise().squaredNorm().cwiseQuotient(variance_ + problem_->noise);
  for (auto const site : sensors_) gains_[site] = -1.0;
}

double remaining_variance(PlacementProblem const& problem, std::span<Eigen::Index const> sensors) {
  RemainingVariance state(problem, Eigen::Index(sensors.size()));
  for (auto const site : sensors) state.add(site);
  return state.value();
}

Eigen::MatrixXd estimator(PlacementProblem const& problem, std::span<Eigen::Index const> sensors) {
  std::vector<Eigen::Index> const set(sensors.begin(), sensors.end());
  Eigen::MatrixXd readings = problem.readings(set, set);
  readings.diagonal() += problem.noise(set);
  return readings.llt().solve(problem.cross(set, Eigen::all));
}

}  // namespace thermotwin::models
