#include "models/placement_bound.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int most_steps = 400, fewest_steps = 50, bisections = 60;
constexpr double least_share = 1e-7;

/// The relaxed problem at shares w.
struct Relaxed {
  double value;    ///< V(w)
  VectorXd slope;  ///< s
};

Relaxed relaxed(PlacementProblem const& problem, VectorXd const& share) {
  std::vector<Index> there;
  for (Index i = 0; i < share.size(); ++i)
    if (share[i] > 0.0) there.push_back(i);
  VectorXd const root = share(there).cwiseSqrt();
  Relaxed sum{0.0, VectorXd::Zero(share.size())};
  for (auto const& world : problem.worlds) {
    Eigen::MatrixXd seen = root.asDiagonal() * world.readings(there, there) * root.asDiagonal();
    seen.diagonal() += problem.noise(there);
    Eigen::MatrixXd const cross = root.asDiagonal() * world.cross(there, Eigen::all);
    Eigen::MatrixXd const weights = seen.llt().solve(cross);
    Eigen::MatrixXd const left = world.cross - world.readings(Eigen::all, there) * (root.asDiagonal() * weights);
    sum.value += world.prior - cross.cwiseProduct(weights).sum();
    sum.slope += left.rowwise().squaredNorm().cwiseQuotient(problem.noise);
  }
  auto const worlds = double(problem.worlds.size());
  return {sum.value / worlds, sum.slope / worlds};
}

/// The linear programme's dual: Σ (s − price)₊ + μ count + λ budget, with price = μ + λ cost.
struct Dual {
  double value;
  VectorXd price;
};

Dual dual_at(PlacementProblem const& problem, VectorXd const& slope, Index count, double lambda) {
  Dual dual{0.0, VectorXd::Zero(slope.size())};
  if (lambda > 0.0) {
    dual.price =
        problem.cost.size() == 0 ? VectorXd(VectorXd::Constant(slope.size(), lambda)) : VectorXd(lambda * problem.cost);
    dual.value = lambda * problem.budget;
  }
  VectorXd rest = slope - dual.price;
  std::nth_element(rest.begin(), rest.begin() + (count - 1), rest.end(), std::greater<>());
  dual.value += rest.head(count).cwiseMax(0.0).sum();
  dual.price.array() += std::max(0.0, rest[count - 1]);
  return dual;
}

/// Golden section over λ; every λ is a bound, the best that was met counts.
Dual best_dual(PlacementProblem const& problem, VectorXd const& slope, Index count) {
  Dual best = dual_at(problem, slope, count, 0.0);
  if (!std::isfinite(problem.budget)) return best;
  VectorXd const cost = problem.cost.size() == 0 ? VectorXd(VectorXd::Ones(slope.size())) : problem.cost;
  double low = 0.0, high = slope.cwiseQuotient(cost).maxCoeff();
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < bisections; ++i) {
    double const a = high - golden * (high - low), b = low + golden * (high - low);
    Dual const at_a = dual_at(problem, slope, count, a), at_b = dual_at(problem, slope, count, b);
    for (auto const& dual : {at_a, at_b})
      if (dual.value < best.value) best = dual;
    (at_a.value < at_b.value ? high : low) = at_a.value < at_b.value ? b : a;
  }
  return best;
}

/// Shares in proportion to `wanted`, at most 1, that use up count or budget, whichever ends first.
VectorXd fitted(PlacementProblem const& problem, VectorXd const& wanted, Index count) {
  auto const fits = [&](VectorXd const& share) {
    double const cost = problem.cost.size() == 0 ? share.sum() : share.dot(problem.cost);
    return share.sum() <= double(count) && cost <= problem.budget;
  };
  double low = 0.0, high = double(count) / wanted.maxCoeff();
  while (fits((high * wanted).cwiseMin(1.0)) && high < 1e12 / wanted.maxCoeff()) high *= 2.0;
  for (int i = 0; i < bisections; ++i) {
    double const middle = 0.5 * (low + high);
    (fits((middle * wanted).cwiseMin(1.0)) ? low : high) = middle;
  }
  VectorXd share = (low * wanted).cwiseMin(1.0);
  return (share.array() < least_share).select(0.0, share);
}

}  // namespace

double placement_bound(PlacementProblem const& problem, Index count, double tolerance) {
  check(problem);
  count = std::min(count, problem.sites());
  VectorXd share = fitted(problem, VectorXd::Ones(problem.sites()), count);
  double bound = 0.0;
  int const steps = std::max(fewest_steps, most_steps / int(problem.worlds.size()));
  for (int step = 0; step < steps; ++step) {
    auto const [value, slope] = relaxed(problem, share);
    Dual const dual = best_dual(problem, slope, count);
    bound = std::max(bound, value + slope.dot(share) - dual.value);
    if (!(slope.maxCoeff() > 0.0) || value - bound <= tolerance * value) break;
    double const floor = 1e-300 + 1e-12 * dual.price.maxCoeff();
    share = fitted(problem, share.cwiseProduct(slope.cwiseQuotient(dual.price.cwiseMax(floor)).cwiseSqrt()), count);
  }
  return bound;
}

}  // namespace thermotwin::models
