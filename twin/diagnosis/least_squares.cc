// The only file that knows Ceres.
#include "twin/diagnosis/least_squares.h"

#include <ceres/ceres.h>
#include <cmath>
#include <glog/logging.h>
#include <vector>

namespace thermotwin::twin {
namespace {

constexpr int most_rounds = 4;  // of holding other unknowns

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class Cost final : public ceres::CostFunction {
 public:
  explicit Cost(LeastSquares const& problem) : problem_(problem) {
    mutable_parameter_block_sizes()->push_back(int(problem.start.size()));
    set_num_residuals(int(problem.residuals));
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    auto const n = problem_.start.size();
    Eigen::VectorXd const x = Eigen::Map<Eigen::VectorXd const>(parameters[0], n);
    Eigen::VectorXd r;
    Eigen::MatrixXd J;
    bool const wanted = jacobians && jacobians[0];
    if (!problem_.evaluate(x, r, wanted ? &J : nullptr)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, r.size()) = r;
    if (wanted) Eigen::Map<RowMajor>(jacobians[0], r.size(), n) = J;
    return true;
  }

 private:
  LeastSquares const& problem_;
};

/// From result.x on, those of the unknowns held that are marked.
void solve_holding(std::vector<int> const& held, LeastSquares const& least_squares, LeastSquaresResult& result) {
  ceres::Problem problem;
  problem.AddResidualBlock(new Cost(least_squares), nullptr, result.x.data());
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
  options.function_tolerance = least_squares.tolerance;
  options.initial_trust_region_radius = 1e8;  // near Gauss–Newton: the priors keep steps short
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  FLAGS_minloglevel = google::GLOG_FATAL;  // a fit that ends early says so by `converged`
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  result.cost = summary.final_cost;
  result.iterations += int(summary.iterations.size());
  result.converged = summary.termination_type == ceres::CONVERGENCE;
}

/// Those that are at a bound, within a thousandth of the way to the other, and would leave the range to make the cost
/// less. They are moved onto it.
std::vector<int> pressed_to_bounds(LeastSquares const& least_squares, Eigen::VectorXd& x) {
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  if (!least_squares.evaluate(x, r, &J)) return {};
  Eigen::VectorXd const uphill = J.transpose() * r;
  std::vector<int> pressed;
  for (int i = 0; i < int(x.size()); ++i) {
    double const lower = least_squares.lower[i], upper = least_squares.upper[i];
    double const near = std::isfinite(upper - lower) ? 1e-3 * (upper - lower) : 0.0;
    bool const below = x[i] <= lower + near && uphill[i] > 0.0;
    if (!below && (x[i] < upper - near || uphill[i] > 0.0)) continue;
    x[i] = below ? lower : upper;
    pressed.push_back(i);
  }
  return pressed;
}

}  // namespace

/// Ceres cuts a step off at a bound and takes the other unknowns along as if it had not been cut: it ends where they
/// are no optimum. So what presses against a bound is held there, as long as it does.
LeastSquaresResult solve(LeastSquares const& least_squares) {
  LeastSquaresResult result;
  result.x = least_squares.start;
  auto held = pressed_to_bounds(least_squares, result.x);
  for (int round = 0; round < most_rounds; ++round) {
    solve_holding(held, least_squares, result);
    auto const pressed = pressed_to_bounds(least_squares, result.x);
    if (pressed == held) break;
    held = pressed;
  }
  return result;
}

}  // namespace thermotwin::twin
