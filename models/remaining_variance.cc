#include "models/remaining_variance.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace thermotwin::models {

void check(PlacementProblem const& problem) {
  auto const refuse = [](std::string const& why) { throw std::invalid_argument("sensor placement: " + why); };
  auto const n = problem.sites();
  if (n == 0) refuse("there is no site");
  if (problem.worlds.empty()) refuse("there is no world");
  if (problem.cost.size() != 0 && problem.cost.size() != n)
    refuse(fmt::format("{} sites, but {} costs", n, problem.cost.size()));
  for (auto const& [readings, cross, prior] : problem.worlds) {
    if (readings.rows() != n || readings.cols() != n || cross.rows() != n ||
        cross.cols() != problem.worlds.front().cross.cols())
      refuse(fmt::format("{} sites, but covariances of {} × {} and {} × {}", n, readings.rows(), readings.cols(),
                         cross.rows(), cross.cols()));
    if (!readings.allFinite() || !cross.allFinite() || !std::isfinite(prior)) refuse("a covariance is not finite");
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!(problem.noise[i] > 0.0))
      refuse(fmt::format("the noise of site {} is {}; it must be > 0", i, problem.noise[i]));
    if (!(problem.cost_of(i) > 0.0))
      refuse(fmt::format("the cost of site {} is {}; it must be > 0", i, problem.cost[i]));
  }
}

double PlacementProblem::prior() const {
  double sum = 0.0;
  for (auto const& world : worlds) sum += world.prior;
  return sum / double(worlds.size());
}

RemainingVariance::RemainingVariance(PlacementProblem const& problem, Eigen::Index most)
    : problem_(&problem), value_(problem.prior()) {
  for (auto const& world : problem.worlds)
    worlds_.push_back({&world, world.readings.diagonal(), world.cross, Eigen::MatrixXd(problem.sites(), most)});
  find_gains();
}

double RemainingVariance::World::add(Eigen::Index site, Eigen::Index sensors, double noise) {
  double const deviation = std::sqrt(variance[site] + noise);
  auto column = factor.col(sensors);
  column = prior->readings.col(site);
  if (sensors > 0) column.noalias() -= factor.leftCols(sensors) * factor.row(site).head(sensors).transpose();
  column /= deviation;
  Eigen::RowVectorXd const told = cross.row(site) / deviation;
  cross.noalias() -= column * told;
  variance -= column.cwiseAbs2();
  variance = variance.cwiseMax(0.0);
  return told.squaredNorm();
}

void RemainingVariance::add(Eigen::Index site) {
  double less = 0.0;
  for (auto& world : worlds_) less += world.add(site, Eigen::Index(sensors_.size()), problem_->noise[site]);
  value_ -= less / double(worlds_.size());
  sensors_.push_back(site);
  find_gains();
}

void RemainingVariance::find_gains() {
  gains_.setZero(problem_->sites());
  for (auto const& world : worlds_)
    gains_ += world.cross.rowwise().squaredNorm().cwiseQuotient(world.variance + problem_->noise);
  gains_ /= double(worlds_.size());
  for (auto const site : sensors_) gains_[site] = -1.0;
}

double remaining_variance(PlacementProblem const& problem, std::span<Eigen::Index const> sensors) {
  RemainingVariance state(problem, Eigen::Index(sensors.size()));
  for (auto const site : sensors) state.add(site);
  return state.value();
}

}  // namespace thermotwin::models
