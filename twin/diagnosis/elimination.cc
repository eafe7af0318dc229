#include "twin/diagnosis/elimination.h"

#include <utility>

namespace thermotwin::twin {
namespace {

/// AᵀA by one triangle.
Eigen::MatrixXd square(Eigen::MatrixXd const& A) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(A.cols(), A.cols());
  result.selfadjointView<Eigen::Lower>().rankUpdate(A.transpose());
  return result.selfadjointView<Eigen::Lower>();
}

}  // namespace

Elimination::Elimination(Eigen::MatrixXd columns, Eigen::VectorXd mean, Eigen::VectorXd const& deviation)
    : columns_(std::move(columns)), mean_(std::move(mean)), precision_(deviation.array().square().inverse()) {
  Eigen::MatrixXd information = square(columns_);
  information.diagonal() += precision_;
  information_.compute(information);
}

Eigen::VectorXd Elimination::best(Eigen::VectorXd const& residual) const {
  return information_.solve(columns_.transpose() * residual + precision_.cwiseProduct(mean_));
}

double Elimination::prior_cost(Eigen::VectorXd const& b) const { return (b - mean_).cwiseAbs2().dot(precision_); }

Eigen::MatrixXd Elimination::curvature(Eigen::MatrixXd const& jacobian) const {
  Eigen::MatrixXd const followed = information_.matrixL().solve(columns_.transpose() * jacobian);
  return square(jacobian) - square(followed);
}

}  // namespace thermotwin::twin
