// The only file that knows Ceres.
#include "twin/diagnosis/least_squares.h"

#include <ceres/ceres.h>
#include <cmath>
#include <glog/logging.h>

namespace thermotwin::twin {
namespace {

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

}  // namespace

LeastSquaresResult solve(LeastSquares const& least_squares) {
  LeastSquaresResult result;
  result.x = least_squares.start;
  ceres::Problem problem;
  problem.AddResidualBlock(new Cost(least_squares), nullptr, result.x.data());
  for (int i = 0; i < int(result.x.size()); ++i) {
    if (std::isfinite(least_squares.lower[i]))
      problem.SetParameterLowerBound(result.x.data(), i, least_squares.lower[i]);
    if (std::isfinite(least_squares.upper[i]))
      problem.SetParameterUpperBound(result.x.data(), i, least_squares.upper[i]);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = least_squares.iterations;
  options.function_tolerance = least_squares.tolerance;
  options.initial_trust_region_radius = 1e8;  // near Gauss–Newton: the priors keep steps short
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  FLAGS_minloglevel = google::GLOG_FATAL;  // a fit that ends early says so by `converged`
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  result.cost = summary.final_cost;
  result.iterations = int(summary.iterations.size());
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  return result;
}

}  // namespace thermotwin::twin
