#include "models/d_optimal.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <fmt/format.h>

#include "models/candidates.h"
#include "models/log_determinant.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double share_left = 0.01;

/// Σ of the others once this variable is known.
void condition_on(MatrixXd& covariance, Index variable) {
  Eigen::VectorXd const column = covariance.col(variable);
  covariance -= column * column.transpose() / column(variable);
  covariance.row(variable).setZero();
  covariance.col(variable).setZero();
}

/// The members by falling conditional variance, each given those before.
std::vector<Index> greedy(MatrixXd covariance, std::vector<Index> members, int count) {
  std::vector<Index> order;
  for (int step = 0; step < count; ++step) {
    auto const next = std::max_element(members.begin(), members.end(),
                                       [&](Index a, Index b) { return covariance(a, a) < covariance(b, b); });
    condition_on(covariance, *next);
    order.push_back(*next);
    members.erase(next);
  }
  return order;
}

double log_determinant(MatrixXd const& covariance, std::vector<Index> const& set) {
  return models::log_determinant(Eigen::LLT<MatrixXd>(covariance(set, set)));
}

/// The best single exchange, carried out; false if none raises the determinant.
bool exchange(MatrixXd const& covariance, std::vector<Index>& set) {
  double most = log_determinant(covariance, set) + 1e-9;
  std::vector<Index> best;
  for (std::size_t i = 0; i < set.size(); ++i)
    for (Index j = 0; j < covariance.rows(); ++j) {
      if (std::find(set.begin(), set.end(), j) != set.end()) continue;
      auto trial = set;
      trial[i] = j;
      double const value = log_determinant(covariance, trial);
      if (value > most) {
        most = value;
        best = std::move(trial);
      }
    }
  if (best.empty()) return false;
  set = std::move(best);
  return true;
}

std::vector<Index> all_of(MatrixXd const& covariance) {
  std::vector<Index> all(static_cast<std::size_t>(covariance.rows()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
  return all;
}

int needed(MatrixXd covariance) {
  double const total = covariance.trace();
  int count = 0;
  for (auto next : greedy(covariance, all_of(covariance), static_cast<int>(covariance.rows()))) {
    condition_on(covariance, next);
    ++count;
    if (covariance.trace() <= share_left * total) break;
  }
  return count;
}

Eigen::VectorXd deviations(MatrixXd covariance, std::vector<Index> const& chosen) {
  Eigen::VectorXd variance(covariance.rows());
  for (auto next : chosen) {
    variance(next) = covariance(next, next);
    condition_on(covariance, next);
  }
  for (Index j = 0; j < covariance.rows(); ++j)
    if (std::find(chosen.begin(), chosen.end(), j) == chosen.end()) variance(j) = covariance(j, j);
  return variance.cwiseMax(0).cwiseSqrt();
}

}  // namespace

std::vector<Index> largest_determinant(MatrixXd const& covariance, int count) {
  auto set = greedy(covariance, all_of(covariance), count);
  while (exchange(covariance, set)) {
  }
  return greedy(covariance, set, count);
}

Selection select_d_optimal(std::span<Batch const> batches, SelectionOptions const& options) {
  auto const from = candidates(batches, options);
  MatrixXd const readings = centred(from.all.temperature_rise);
  MatrixXd covariance = readings.transpose() * readings / static_cast<double>(readings.rows() - 1);
  covariance.diagonal().array() += std::max(options.resolution * options.resolution / 12, 1e-12 * covariance.trace());
  int const count = options.count.value_or(needed(covariance));
  auto const chosen = largest_determinant(covariance, count);
  return selection(from, chosen, deviations(covariance, chosen),
                   options.count ? "" : fmt::format("{} sensors leave less than 1 % of the readings' variance", count));
}

}  // namespace thermotwin::models
