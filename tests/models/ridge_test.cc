#include "models/ridge.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <span>

#include "models/contiguous_folds.h"
#include "models/linear_regression.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(ContiguousFolds, CoverEveryRowOnceInOrder) {
  for (int rows : {5, 17, 90, 101}) {
    Eigen::Index next = 0;
    for (auto const& fold : contiguous_folds(rows, 5)) {
      EXPECT_EQ(fold.first, next);
      EXPECT_GE(fold.count, rows / 5);
      EXPECT_LE(fold.count, rows / 5 + 1);
      EXPECT_EQ(rows_outside(fold, rows).size(), std::size_t(rows - fold.count));
      next += fold.count;
    }
    EXPECT_EQ(next, rows);
  }
  EXPECT_THROW(contiguous_folds(4, 5), std::invalid_argument);
  EXPECT_THROW(contiguous_folds(40, 1), std::invalid_argument);
}

/// The same by solving each fold's normal equations directly.
double validation_error(MatrixXd const& columns, VectorXd const& y, double penalty, int folds) {
  Eigen::RowVectorXd const mean = columns.colwise().mean();
  MatrixXd z = columns.rowwise() - mean;
  Eigen::RowVectorXd const deviation = (z.colwise().squaredNorm() / double(z.rows())).cwiseSqrt();
  z = (z.array().rowwise() / deviation.array()).matrix();
  double sum = 0;
  for (auto const& fold : contiguous_folds(z.rows(), folds)) {
    auto const rows = rows_outside(fold, z.rows());
    MatrixXd const zt = z(rows, Eigen::all);
    VectorXd const yt = y(rows);
    Eigen::RowVectorXd const zm = zt.colwise().mean();
    MatrixXd const c = zt.rowwise() - zm;
    double const n = double(rows.size());
    MatrixXd const normal = c.transpose() * c / n + penalty * MatrixXd::Identity(z.cols(), z.cols());
    VectorXd const b = normal.ldlt().solve(c.transpose() * (yt.array() - yt.mean()).matrix() / n);
    for (Eigen::Index i = fold.first; i < fold.first + fold.count; ++i)
      sum += std::pow(y(i) - yt.mean() - (z.row(i) - zm).dot(b), 2);
  }
  return std::sqrt(sum / double(z.rows()));
}

TEST(RidgeRegression, ChoosesThePenaltyOfLeastBlockedError) {
  for (std::uint64_t seed : {1, 2, 3, 4}) {
    auto const batch = random_walks(seed, 80, 6);
    auto const fit = ridge_regression(batch.temperature_rise, batch.error, 5);
    EXPECT_NEAR(fit.validation_rmse, validation_error(batch.temperature_rise, batch.error, fit.penalty, 5), 1e-8);
    for (double factor : {0.01, 0.1, 0.5, 2.0, 10.0, 100.0}) {
      double const other = std::clamp(fit.penalty * factor, 1e-6, 1e2);
      EXPECT_GE(validation_error(batch.temperature_rise, batch.error, other, 5), 0.999 * fit.validation_rmse);
    }
  }
}

TEST(RidgeRegression, IsLeastSquaresWhereDataAreClean) {
  std::mt19937_64 generator(1);
  MatrixXd const x = MatrixXd::NullaryExpr(200, 3, [&] { return normal(generator); });
  VectorXd const y = (x * VectorXd::LinSpaced(3, -1, 2)).array() + 5.0;
  auto const fit = ridge_regression(x, y, 5);
  auto const reference = linear_regression(x, y);
  EXPECT_EQ(fit.penalty, 1e-6);
  EXPECT_NEAR(fit.parameters, 4.0, 1e-4);
  EXPECT_LT((fit.coefficients - reference.coefficients).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(RidgeRegression, KnowsFarFewerParametersWhereColumnsMoveAlike) {
  std::mt19937_64 generator(2);
  VectorXd const course = warm_up(20, 40, 120, 0, generator);
  MatrixXd x(120, 8);
  for (auto& value : x.reshaped()) value = 0.3 * normal(generator);
  x.colwise() += course;
  VectorXd y = 2.0 * course;
  for (auto& value : y) value += normal(generator);
  auto const fit = ridge_regression(x, y, 5);
  EXPECT_LT(fit.parameters, 8.0);
  EXPECT_GT(fit.parameters, 1.0);
}

/// With an intercept, eight sensors are nine numbers: nine samples can tell them apart, eight cannot.
TEST(RidgeRegression, SaysWhereSamplesAreFewerThanNumbers) {
  auto const remark_of = [](Eigen::Index rows) {
    Batch const batch = random_walks(1, rows, 8);
    return fit_ridge(std::span(&batch, 1), {}).remark;
  };
  EXPECT_EQ(remark_of(9).find("samples"), std::string::npos) << remark_of(9);
  EXPECT_TRUE(remark_of(8).ends_with("; 8 regressors for 8 samples")) << remark_of(8);
}

TEST(RidgeRegression, GivesNothingToAColumnThatDoesNotMove) {
  auto batch = random_walks(3, 60, 4);
  batch.temperature_rise.col(2).setConstant(0.7);
  auto const fit = ridge_regression(batch.temperature_rise, batch.error, 5);
  EXPECT_EQ(fit.coefficients(2), 0.0);
  EXPECT_TRUE(fit.coefficients.allFinite());
}

}  // namespace
}  // namespace thermotwin::models
