// The only file that knows Ceres.
#include "twin/diagnosis/least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <ceres/ceres.h>
#include <cmath>
#include <glog/logging.h>
#include <vector>

namespace thermotwin::twin {
namespace {

/// Of the whole process, once: a fit that ends early says so by `converged`.
void silence() {
  static bool const once = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  static_cast<void>(once);
}

constexpr int most_rounds = 12;  // of holding other unknowns

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Those that are at a bound, within a thousandth of the way to the other, and would leave the range to make the cost
/// less.
std::vector<int> pressed(LeastSquares const& least_squares, Eigen::VectorXd const& x, Eigen::VectorXd const& uphill) {
  std::vector<int> result;
  for (int i = 0; i < int(x.size()); ++i) {
    double const lower = least_squares.lower[i], upper = least_squares.upper[i];
    double const near = std::isfinite(upper - lower) ? 1e-3 * (upper - lower) : 0.0;
    if (uphill[i] > 0.0 ? x[i] <= lower + near : x[i] >= upper - near) result.push_back(i);
  }
  return result;
}

/// What a step of Gauss and Newton would gain, of |r|²: gᵀ (JᵀJ)⁻¹ g over all others than these.
double expected_gain(NormalEquations at, std::vector<int> const& pressed) {
  for (int const i : pressed) {
    at.gradient[i] = 0.0;
    at.curvature.row(i).setZero();
    at.curvature.col(i).setZero();
    at.curvature(i, i) = 1.0;
  }
  return at.gradient.dot(at.curvature.llt().solve(at.gradient));
}

/// Residuals and Jacobian for Ceres: n + 1 of them with the same |r|², Jᵀr and JᵀJ,
///
///   LLᵀ = JᵀJ,   J' = (Lᵀ; 0),   r' = (L⁻¹ Jᵀr; √(|r|² − |L⁻¹ Jᵀr|²)).
///
/// It asks for a Jacobian where it has gone to, and is stopped where the next step would gain too little, or where
/// something presses against a bound that is not held there: the step would be cut off, again and again.
class Cost final : public ceres::CostFunction, public ceres::IterationCallback {
 public:
  Cost(LeastSquares const& problem, std::vector<int> const& held) : problem_(problem), held_(held) {
    mutable_parameter_block_sizes()->push_back(int(problem.start.size()));
    set_num_residuals(int(problem.start.size()) + 1);
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    auto const n = problem_.start.size();
    Eigen::VectorXd const x = Eigen::Map<Eigen::VectorXd const>(parameters[0], n);
    Eigen::Map<Eigen::VectorXd> r(residuals, n + 1);
    bool const wanted = jacobians && jacobians[0];
    NormalEquations at;
    if (!problem_.evaluate(x, wanted, at)) return false;
    r.setZero();
    if (wanted) {
      Eigen::LLT<Eigen::MatrixXd> const information(at.curvature);
      if (information.info() != Eigen::Success) return false;
      r.head(n) = information.matrixL().solve(at.gradient);
      Eigen::Map<RowMajor> J(jacobians[0], n + 1, n);
      J.topRows(n) = information.matrixU();
      J.row(n).setZero();
      auto const stopped = pressed(problem_, x, at.gradient);
      goes_on_ = std::ranges::includes(held_, stopped) && !(expected_gain(at, stopped) <= problem_.tolerance * at.cost);
    }
    r[n] = std::sqrt(std::max(0.0, at.cost - r.squaredNorm()));
    return true;
  }
  ceres::CallbackReturnType operator()(ceres::IterationSummary const&) override {
    return goes_on_ ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  LeastSquares const& problem_;
  std::vector<int> const& held_;
  mutable bool goes_on_ = true;
};

/// From result.x on, those of the unknowns held that are listed.
void solve_holding(std::vector<int> const& held, LeastSquares const& least_squares, LeastSquaresResult& result) {
  ceres::Problem problem;
  auto* const cost = new Cost(least_squares, held);  // the problem's
  problem.AddResidualBlock(cost, nullptr, result.x.data());
  for (int i = 0; i < int(result.x.size()); ++i) {
    if (std::isfinite(least_squares.lower[i]))
      problem.SetParameterLowerBound(result.x.data(), i, least_squares.lower[i]);
    if (std::isfinite(least_squares.upper[i]))
      problem.SetParameterUpperBound(result.x.data(), i, least_squares.upper[i]);
  }
  if (!held.empty()) problem.SetManifold(result.x.data(), new ceres::SubsetManifold(int(result.x.size()), held));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = least_squares.iterations;
  options.line_search_interpolation_type = ceres::QUADRATIC;  // a step that is too long asks for no more Jacobians
  options.max_num_line_search_step_size_iterations = 5;
  options.max_line_search_step_contraction = 0.1;  // a cost that explodes far out says little of near by
  // Of a step taken: one cut short at a bound gains little, and the next one much.
  options.function_tolerance = 0.1 * least_squares.tolerance;
  options.initial_trust_region_radius = 1e8;  // near Gauss–Newton: the priors keep steps short
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.callbacks.push_back(cost);
  silence();
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  result.converged = summary.termination_type == ceres::CONVERGENCE || summary.termination_type == ceres::USER_SUCCESS;
}

/// Moves what presses against a bound onto it, and tells which it is.
std::vector<int> pressed_onto_bounds(LeastSquares const& least_squares, Eigen::VectorXd& x) {
  NormalEquations at;
  if (!least_squares.evaluate(x, true, at)) return {};
  auto const result = pressed(least_squares, x, at.gradient);
  for (int const i : result) x[i] = at.gradient[i] > 0.0 ? least_squares.lower[i] : least_squares.upper[i];
  return result;
}

}  // namespace

/// Ceres cuts a step off at a bound and takes the other unknowns along as if it had not been cut: it ends where they
/// are no optimum. So what presses against a bound is held there, as long as it does.
LeastSquaresResult solve(LeastSquares const& least_squares) {
  LeastSquaresResult result;
  result.x = least_squares.start;
  auto held = pressed_onto_bounds(least_squares, result.x);
  for (int round = 0; round < most_rounds; ++round) {
    solve_holding(held, least_squares, result);
    auto const now = pressed_onto_bounds(least_squares, result.x);
    if (now == held) break;
    held = now;
  }
  return result;
}

}  // namespace thermotwin::twin
