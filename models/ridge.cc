#include "models/ridge.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <fmt/format.h>

#include "models/scaling.h"
#include "models/training_set.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double stands_still = 1e-12;  // variance among the rows fitted, of 1 among all

VectorXd penalties() {
  constexpr double lowest = -6.0, highest = 2.0;
  constexpr int per_decade = 4;
  VectorXd const exponents =
      VectorXd::LinSpaced(static_cast<Index>((highest - lowest) * per_decade) + 1, lowest, highest);
  return exponents.unaryExpr([](double e) { return std::pow(10.0, e); });
}

/// Sums over rows from which every fit follows; those of a fold are taken away from those of all.
struct Moments {
  double rows = 0, y = 0;
  VectorXd z, zy;
  MatrixXd zz;

  Moments(Eigen::Ref<MatrixXd const> const& columns, Eigen::Ref<VectorXd const> const& response)
      : rows(static_cast<double>(columns.rows())),
        y(response.sum()),
        z(columns.colwise().sum()),
        zy(columns.transpose() * response),
        zz(columns.transpose() * columns) {}

  Moments& operator-=(Moments const& part) {
    rows -= part.rows;
    y -= part.y;
    z -= part.z;
    zy -= part.zy;
    zz -= part.zz;
    return *this;
  }
};

/// All penalties at once, of columns standardised anew: c(λ) = V (d + λ)⁻¹ Vᵀ cov(z, y).
struct Path {
  VectorXd mean, deviation;
  double response_mean;
  VectorXd eigenvalues, projection;
  MatrixXd directions;

  explicit Path(Moments const& sums) : mean(sums.z / sums.rows), response_mean(sums.y / sums.rows) {
    MatrixXd const covariance = sums.zz / sums.rows - mean * mean.transpose();
    deviation = (covariance.diagonal().array() > stands_still).select(covariance.diagonal().cwiseSqrt(), 1.0);
    VectorXd const scale = deviation.cwiseInverse();
    Eigen::SelfAdjointEigenSolver<MatrixXd> const solver(scale.asDiagonal() * covariance * scale.asDiagonal());
    eigenvalues = solver.eigenvalues().cwiseMax(0.0);
    directions = solver.eigenvectors();
    projection = directions.transpose() * (sums.zy / sums.rows - mean * response_mean).cwiseQuotient(deviation);
  }
  /// Column k: coefficients in the eigenvectors' basis for the k-th penalty.
  [[nodiscard]] MatrixXd rotated(VectorXd const& lambda) const {
    MatrixXd result(projection.size(), lambda.size());
    for (Index k = 0; k < lambda.size(); ++k) result.col(k) = projection.array() / (eigenvalues.array() + lambda(k));
    return result;
  }
};

VectorXd squared_errors(Path const& path, VectorXd const& lambda, Eigen::Ref<MatrixXd const> const& z,
                        Eigen::Ref<VectorXd const> const& y) {
  MatrixXd const basis = scaled(z, path.mean, path.deviation) * path.directions;
  MatrixXd residuals = -basis * path.rotated(lambda);
  residuals.colwise() += (y.array() - path.response_mean).matrix();
  return residuals.colwise().squaredNorm();
}

}  // namespace

RidgeRegression ridge_regression(MatrixXd const& columns, VectorXd const& response, std::vector<Fold> const& folds) {
  auto const scaling = standard_scaling(columns);
  MatrixXd const z = scaled(columns, scaling);
  Moments const all(z, response);
  VectorXd const lambda = penalties();
  VectorXd errors = VectorXd::Zero(lambda.size());
  for (auto const& fold : folds) {
    auto const left_out = z.middleRows(fold.first, fold.count);
    auto const response_out = response.segment(fold.first, fold.count);
    Moments rest = all;
    rest -= Moments(left_out, response_out);
    errors += squared_errors(Path(rest), lambda, left_out, response_out);
  }
  Index best = 0;
  double const least = errors.minCoeff(&best);

  Path const path(all);
  RidgeRegression fit;
  fit.penalty = lambda(best);
  fit.validation_rmse = std::sqrt(least / all.rows);
  fit.parameters = 1 + (path.eigenvalues.array() / (path.eigenvalues.array() + fit.penalty)).sum();
  VectorXd const standard = path.directions * path.rotated(lambda.segment(best, 1));
  fit.coefficients = standard.cwiseQuotient(path.deviation).cwiseQuotient(scaling.scale);
  fit.intercept = path.response_mean - fit.coefficients.dot(scaling.offset);
  return fit;
}

ErrorModel fit_ridge(std::span<Batch const> batches, FitOptions const& options) {
  auto const set = training_set(batches);
  auto const fit = ridge_regression(set.regressors, set.error, folds_of_runs(set.run_lengths, options.folds));
  return linear_model("ridge", set, fit.intercept, fit.coefficients, fit.parameters,
                      fmt::format("penalty {:.3g}, {:.1f} effective parameters", fit.penalty, fit.parameters));
}

}  // namespace thermotwin::models
