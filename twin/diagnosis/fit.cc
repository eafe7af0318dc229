#include "twin/diagnosis/fit.h"

#include <utility>

#include "thermal/threaded_product.h"

namespace thermotwin::twin {

Jacobian::Jacobian(Eigen::MatrixXd own, Eigen::VectorXd priors) : own_(std::move(own)), priors_(std::move(priors)) {}

Jacobian::Jacobian(Eigen::MatrixXd own, Eigen::VectorXd priors, std::shared_ptr<Elimination const> linear,
                   Eigen::Index first_linear)
    : own_(std::move(own)), priors_(std::move(priors)), linear_(std::move(linear)), first_linear_(first_linear) {}

bool Jacobian::is_linear(Eigen::Index unknown) const {
  return unknown >= first_linear_ && unknown < first_linear_ + linear();
}

Eigen::Index Jacobian::place(Eigen::Index unknown) const {
  eigen_assert(!is_linear(unknown));
  return unknown < first_linear_ ? unknown : unknown - linear();
}

Eigen::VectorXd Jacobian::column(Eigen::Index unknown) const {
  if (is_linear(unknown)) return -linear_->columns().col(unknown - first_linear_);
  return own_.col(place(unknown));
}

Eigen::MatrixXd Jacobian::of_data() const {
  Eigen::MatrixXd all(own_.rows(), priors_.size());
  for (Eigen::Index u = 0; u < all.cols(); ++u) all.col(u) = column(u);
  return all;
}

Eigen::MatrixXd Jacobian::transposed_times(Eigen::MatrixXd const& signals, Eigen::Index first_row) const {
  Eigen::MatrixXd const searched =
      thermal::threaded_product(own_.middleRows(first_row, signals.rows()).transpose(), signals);
  Eigen::MatrixXd all(priors_.size(), signals.cols());
  Eigen::Index const after = searched.rows() - first_linear_;
  all.topRows(first_linear_) = searched.topRows(first_linear_);
  all.bottomRows(after) = searched.bottomRows(after);
  if (linear_) all.middleRows(first_linear_, linear()) = -linear_->shared(signals, first_row);
  return all;
}

Eigen::VectorXd Jacobian::gradient(Eigen::VectorXd const& residual) const {
  return transposed_times(residual.head(own_.rows())) + priors_.cwiseProduct(residual.tail(priors_.size()));
}

void Jacobian::forget(Eigen::Index unknown) {
  own_.col(place(unknown)).setZero();
  priors_[unknown] = 1.0;
}

Fit without(Fit fit, Eigen::Index unknown) {
  auto const unknowns = fit.x.size(), rows = fit.residual.size() - unknowns;
  fit.residual.head(rows) -= fit.jacobian.column(unknown) * fit.x[unknown];
  fit.residual[rows + unknown] = 0.0;
  fit.jacobian.forget(unknown);
  fit.information.row(unknown).setZero();
  fit.information.col(unknown).setZero();
  fit.information(unknown, unknown) = 1.0;
  return fit;
}

}  // namespace thermotwin::twin
