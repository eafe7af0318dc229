#include "models/principal_component.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <stdexcept>

#include "models/scaling.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double explained_share = 0.85;

VectorXd with_positive_peak(VectorXd const& direction) {
  Index peak = 0;
  direction.cwiseAbs().maxCoeff(&peak);
  return direction(peak) < 0 ? -direction : direction;
}

MatrixXd standardised(MatrixXd const& columns, PrincipalComponents const& components) {
  return scaled(columns, components.mean, components.deviation);
}

}  // namespace

Index PrincipalComponents::count_for(double share) const {
  double const total = variances.sum();
  double explained = 0;
  for (Index k = 0; k < variances.size(); ++k) {
    explained += variances(k);
    if (explained > share * total) return k + 1;
  }
  return variances.size();
}

PrincipalComponents principal_components(MatrixXd const& columns) {
  auto const rows = static_cast<double>(columns.rows());
  if (columns.rows() < 2) throw std::invalid_argument("principal components need at least two samples");
  PrincipalComponents result;
  auto const scaling = standard_scaling(columns);
  result.mean = scaling.offset;
  result.deviation = scaling.scale * std::sqrt(rows / (rows - 1));
  MatrixXd const z = standardised(columns, result);
  Eigen::SelfAdjointEigenSolver<MatrixXd> const solver(z.transpose() * z / (rows - 1));
  result.variances = solver.eigenvalues().reverse().cwiseMax(0.0);
  result.directions = solver.eigenvectors().rowwise().reverse();
  for (Index k = 0; k < columns.cols(); ++k) result.directions.col(k) = with_positive_peak(result.directions.col(k));
  return result;
}

ComponentRegression component_regression(MatrixXd const& columns, VectorXd const& response,
                                         PrincipalComponents const& components, Index count) {
  double const mean = response.mean();
  auto const directions = components.directions.leftCols(count);
  MatrixXd const f = standardised(columns, components) * directions;
  ComponentRegression fit;
  fit.scores = (f.transpose() * (response.array() - mean).matrix()).array() /
               (static_cast<double>(columns.rows() - 1) * components.variances.head(count).array());
  fit.coefficients = (directions * fit.scores).cwiseQuotient(components.deviation);
  fit.intercept = mean - fit.coefficients.dot(components.mean);
  return fit;
}

ErrorModel component_model(std::string method, TrainingSet const& set) {
  auto const components = principal_components(set.regressors);
  auto const count = components.count_for(explained_share);
  require_samples(set, count + 2);
  auto const fit = component_regression(set.regressors, set.error, components, count);
  double const share = components.variances.head(count).sum() / components.variances.sum();
  return linear_model(
      std::move(method), set, fit.intercept, fit.coefficients, static_cast<double>(count + 1),
      fmt::format("{} of {} components, {:.1f} % of the variance", count, components.variances.size(), 100 * share));
}

ErrorModel fit_principal_component(std::span<Batch const> batches, FitOptions const&) {
  return component_model("principal_component", training_set(batches));
}

}  // namespace thermotwin::models
