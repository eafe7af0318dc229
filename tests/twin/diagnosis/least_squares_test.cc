#include "twin/diagnosis/least_squares.h"

#include <Eigen/QR>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <vector>

namespace thermotwin::twin {
namespace {

/// Of residuals r with the Jacobian J.
NormalEquations normal_equations(Eigen::VectorXd const& r, Eigen::MatrixXd const& J) {
  return {r.squaredNorm(), J.transpose() * r, J.transpose() * J};
}

/// r = A x − b + c (x·x) e: curved a little, as a machine is.
LeastSquares problem_of(Eigen::MatrixXd const& A, Eigen::VectorXd const& b, double curvature) {
  LeastSquares problem;
  problem.evaluate = [=](Eigen::VectorXd const& x, bool, NormalEquations& at) {
    Eigen::VectorXd r = A * x - b;
    r.array() += curvature * x.squaredNorm();
    at = normal_equations(r, A + 2.0 * curvature * Eigen::VectorXd::Ones(A.rows()) * x.transpose());
    return true;
  };
  problem.start = Eigen::VectorXd::Ones(A.cols());
  problem.lower = Eigen::VectorXd::Zero(A.cols());
  problem.upper = Eigen::VectorXd::Constant(A.cols(), INFINITY);
  problem.iterations = 20;
  problem.tolerance = 1e-10;
  return problem;
}

/// Columns that nearly say the same, as an effect and the numbers that imitate it.
Eigen::MatrixXd nearly_alike(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd A(rows, columns);
  for (auto& entry : A.reshaped()) entry = 0.1 * normal(random);
  for (Eigen::Index i = 0; i < rows; ++i) A.row(i).array() += normal(random);
  return A;
}

/// Karush, Kuhn and Tucker: the gradient is zero where an unknown is free, and points out of the range where it is not.
TEST(LeastSquares, EndsWhereNothingAllowedIsBetter) {
  int bound = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    auto const A = nearly_alike(40, 6, random);
    Eigen::VectorXd x(6);
    for (auto& entry : x) entry = normal(random);
    auto const problem = problem_of(A, A * x, 1e-3);
    auto const result = solve(problem);
    NormalEquations at;
    problem.evaluate(result.x, true, at);
    Eigen::VectorXd const& gradient = at.gradient;
    double const scale = std::sqrt(at.curvature.trace() * std::max(1.0, at.cost));
    for (Eigen::Index i = 0; i < 6; ++i) {
      bool const held = result.x[i] == 0.0;
      bound += held;
      EXPECT_GE(result.x[i], 0.0);
      EXPECT_GT(gradient[i], -1e-4 * scale) << "seed " << seed << ", unknown " << i;
      if (held) continue;
      EXPECT_LT(gradient[i], 1e-4 * scale) << "seed " << seed << ", unknown " << i;
    }
  }
  EXPECT_GT(bound, 200);
}

/// Without curvature the other unknowns are those of a regression without what is held.
TEST(LeastSquares, FitsTheOthersToWhatIsHeld) {
  std::mt19937_64 random(7);
  auto const A = nearly_alike(40, 3, random);
  Eigen::VectorXd const b = A * Eigen::Vector3d(-0.5, 1.0, 2.0);
  auto const result = solve(problem_of(A, b, 0.0));
  Eigen::VectorXd const rest = A.rightCols(2).colPivHouseholderQr().solve(b);
  EXPECT_EQ(result.x[0], 0.0);
  EXPECT_NEAR(result.x[1], rest[0], 1e-6);
  EXPECT_NEAR(result.x[2], rest[1], 1e-6);
  EXPECT_TRUE(result.converged);
}

/// Where a solution asks for costs, and where for Jacobians.
struct Asked {
  std::set<std::vector<double>> costs, linearised;
};

Asked asked(LeastSquares problem) {
  Asked result;
  problem.evaluate = [&, evaluate = problem.evaluate](auto const& x, bool wanted, auto& at) {
    std::vector<double> const place(x.begin(), x.end());
    result.costs.insert(place);
    if (wanted) result.linearised.insert(place);
    return evaluate(x, wanted, at);
  };
  problem.tolerance = 1e-6;
  EXPECT_TRUE(solve(problem).converged);
  return result;
}

Eigen::VectorXd noise_beside(Eigen::MatrixXd const& A) {
  Eigen::VectorXd const noise = Eigen::VectorXd::LinSpaced(A.rows(), -1.0, 1.0);
  return noise - A * A.colPivHouseholderQr().solve(noise);
}

/// A linear problem takes one step: Jacobians are asked for where it begins and where it ends.
TEST(LeastSquares, EndsWhereTheLinearisationHasNothingToGain) {
  std::mt19937_64 random(9);
  auto const A = nearly_alike(40, 3, random);
  auto const [costs, linearised] = asked(problem_of(A, A * Eigen::Vector3d(0.5, 1.0, 2.0) + noise_beside(A), 0.0));
  EXPECT_EQ(costs.size(), 2);
  EXPECT_EQ(linearised, costs);
}

/// And one more where the first is cut off at a bound: what presses against it is held there at once.
TEST(LeastSquares, HoldsAtOnceWhatPressesAgainstABound) {
  std::mt19937_64 random(9);
  auto const A = nearly_alike(40, 3, random);
  auto const [costs, linearised] = asked(problem_of(A, A * Eigen::Vector3d(-0.5, 1.0, 2.0) + noise_beside(A), 0.0));
  EXPECT_EQ(costs.size(), 3);
  EXPECT_EQ(linearised, costs);
}

/// What begins at a bound leaves it where that is better.
TEST(LeastSquares, LeavesABoundThatDoesNotPress) {
  std::mt19937_64 random(8);
  auto const A = nearly_alike(40, 3, random);
  Eigen::Vector3d const x(0.5, 1.0, 2.0);
  auto problem = problem_of(A, A * x, 0.0);
  problem.start = Eigen::Vector3d(0.0, 0.0, 3.0);
  EXPECT_LT((solve(problem).x - x).norm(), 1e-6);
}

}  // namespace
}  // namespace thermotwin::twin
