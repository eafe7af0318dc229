#include "models/linear_regression.h"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A column whose part that no earlier one explains is smaller than this share of it counts as a combination of them.
constexpr double collinear_below = 1e-9;

std::string name_of(Index column, RegressionOptions const& options) {
  auto const i = static_cast<std::size_t>(column);
  return i < options.names.size() ? fmt::format("'{}'", options.names[i]) : fmt::format("{}", column + 1);
}

void check(MatrixXd const& x, VectorXd const& y, RegressionOptions const& options) {
  if (x.rows() != y.size())
    throw std::invalid_argument(fmt::format("{} rows of regressors, {} of the response", x.rows(), y.size()));
  if (x.cols() < 1) throw std::invalid_argument("a regression without regressors");
  if (y.size() < x.cols() + 2)
    throw std::invalid_argument(
        fmt::format("{} samples are too few for {} regressors: at least {}", y.size(), x.cols(), x.cols() + 2));
  if (!y.allFinite()) throw std::invalid_argument("the response holds a value that is no number");
  for (Index i = 0; i < x.cols(); ++i)
    if (!x.col(i).allFinite())
      throw std::invalid_argument(fmt::format("regressor {} holds a value that is no number", name_of(i, options)));
  if (y.maxCoeff() == y.minCoeff()) throw std::invalid_argument("the response is constant: nothing to explain");
  auto const& lengths = options.run_lengths;
  if (!lengths.empty() && std::accumulate(lengths.begin(), lengths.end(), Index{0}) != y.size())
    throw std::invalid_argument("the lengths of the runs do not add up to the samples");
}

/// Modified Gram-Schmidt tells, in the order given, the first column that the ones before it explain.
void check_independence(MatrixXd scaled, RegressionOptions const& options) {
  for (Index i = 0; i < scaled.cols(); ++i) {
    double const left = scaled.col(i).norm();
    if (left < collinear_below)
      throw std::invalid_argument(
          fmt::format("regressor {} is a combination of the ones before it", name_of(i, options)));
    scaled.col(i) /= left;
    for (Index j = i + 1; j < scaled.cols(); ++j) scaled.col(j) -= scaled.col(i).dot(scaled.col(j)) * scaled.col(i);
  }
}

/// Centred columns of unit length; the lengths are returned beside.
std::pair<MatrixXd, VectorXd> standardised(MatrixXd const& x, RegressionOptions const& options) {
  MatrixXd centred = x.rowwise() - x.colwise().mean();
  VectorXd const lengths = centred.colwise().norm();
  for (Index i = 0; i < x.cols(); ++i) {
    if (x.col(i).maxCoeff() == x.col(i).minCoeff())
      throw std::invalid_argument(fmt::format("regressor {} is constant", name_of(i, options)));
    centred.col(i) /= lengths(i);
  }
  return {centred, lengths};
}

double two_sided(double t, double freedom) {
  if (std::isinf(t)) return 0.0;
  return 2.0 * cdf(complement(boost::math::students_t(freedom), std::abs(t)));
}

double ratio(double value, double error) {
  if (error > 0) return value / error;
  return value == 0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), value);
}

int longest_lag(Index samples, RegressionOptions const& options) {
  auto const& runs = options.run_lengths;
  Index const longest = runs.empty() ? samples : *std::max_element(runs.begin(), runs.end());
  int const usual = static_cast<int>(4.0 * std::pow(static_cast<double>(samples) / 100.0, 2.0 / 9.0));
  return std::clamp(options.hac_lags.value_or(usual), 0, static_cast<int>(longest) - 1);
}

/// Σ_{|l| ≤ L} (1 − |l|/(L+1)) Σ_t g_ti g_{t−l,i} for each column i of g, within runs.
VectorXd newey_west(MatrixXd const& g, int lags, std::vector<Index> runs) {
  if (runs.empty()) runs = {g.rows()};
  VectorXd variance = VectorXd::Zero(g.cols());
  Index begin = 0;
  for (Index const length : runs) {
    auto const run = g.middleRows(begin, length);
    variance += run.colwise().squaredNorm().transpose();
    for (Index lag = 1; lag <= std::min<Index>(lags, length - 1); ++lag) {
      double const weight = 2.0 * (1.0 - static_cast<double>(lag) / (lags + 1.0));
      variance +=
          weight * run.bottomRows(length - lag).cwiseProduct(run.topRows(length - lag)).colwise().sum().transpose();
    }
    begin += length;
  }
  return variance.cwiseMax(0.0);
}

void judge_coefficients(VectorXd const& coefficients, VectorXd const& errors, double freedom, VectorXd& t,
                        VectorXd& p) {
  t.resize(coefficients.size());
  p.resize(coefficients.size());
  for (Index i = 0; i < coefficients.size(); ++i) {
    t(i) = ratio(coefficients(i), errors(i));
    p(i) = two_sided(t(i), freedom);
  }
}

void judge_whole(LinearRegression& fit, double total, double regressors, double samples) {
  auto const freedom = static_cast<double>(fit.degrees_of_freedom);
  double const unexplained = fit.residuals.squaredNorm();
  fit.r_squared = 1.0 - unexplained / total;
  fit.adjusted_r_squared = 1.0 - (1.0 - fit.r_squared) * (samples - 1.0) / freedom;
  fit.residual_deviation = std::sqrt(unexplained / freedom);
  fit.largest_residual = fit.residuals.cwiseAbs().maxCoeff();
  fit.F = ratio(std::max(0.0, total - unexplained) / regressors, unexplained / freedom);
  fit.p_F = std::isinf(fit.F) ? 0.0 : cdf(complement(boost::math::fisher_f(regressors, freedom), fit.F));
}

}  // namespace

LinearRegression linear_regression(MatrixXd const& regressors, VectorXd const& response,
                                   RegressionOptions const& options) {
  check(regressors, response, options);
  auto const [x, lengths] = standardised(regressors, options);
  check_independence(x, options);
  auto const samples = static_cast<double>(x.rows());
  VectorXd const y = response.array() - response.mean();

  Eigen::HouseholderQR<MatrixXd> const qr(x);
  MatrixXd const r_inverse =
      qr.matrixQR().topRows(x.cols()).triangularView<Eigen::Upper>().solve(MatrixXd::Identity(x.cols(), x.cols()));
  VectorXd const standard = qr.solve(y);

  LinearRegression fit;
  fit.degrees_of_freedom = x.rows() - x.cols() - 1;
  fit.coefficients = standard.cwiseQuotient(lengths);
  fit.intercept = response.mean() - regressors.colwise().mean().dot(fit.coefficients);
  fit.residuals = y - x * standard;
  judge_whole(fit, y.squaredNorm(), static_cast<double>(x.cols()), samples);

  auto const freedom = static_cast<double>(fit.degrees_of_freedom);
  fit.standard_errors = fit.residual_deviation * r_inverse.rowwise().norm().cwiseQuotient(lengths);
  judge_coefficients(fit.coefficients, fit.standard_errors, freedom, fit.t, fit.p);

  fit.hac_lags = longest_lag(x.rows(), options);
  MatrixXd const g = fit.residuals.asDiagonal() * (x * (r_inverse * r_inverse.transpose()));
  fit.hac_standard_errors =
      (samples / freedom * newey_west(g, fit.hac_lags, options.run_lengths)).cwiseSqrt().cwiseQuotient(lengths);
  judge_coefficients(fit.coefficients, fit.hac_standard_errors, freedom, fit.hac_t, fit.hac_p);
  return fit;
}

}  // namespace thermotwin::models
