#include "models/ridge.h"

#include <Eigen/Dense>
#include <gmock/gmock.h>
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

TEST(FoldsOfRuns, AreWholeRunsOfThreeOrMore) {
  auto const folds = folds_of_runs({10, 30, 5, 20, 20}, 3);
  ASSERT_EQ(folds.size(), 3U);
  std::vector<Eigen::Index> ends;
  for (auto const& fold : folds) ends.push_back(fold.first + fold.count);
  EXPECT_THAT(ends, testing::ElementsAre(10, 45, 85));
  EXPECT_EQ(folds_of_runs({10, 30, 5}, 5).size(), 3U);
  EXPECT_EQ(folds_of_runs({10, 30}, 5).size(), 5U);
  EXPECT_EQ(folds_of_runs({40}, 5).size(), 5U);
  EXPECT_THROW(folds_of_runs({10, 30, 5}, 1), std::invalid_argument);
}

/// The same by solving each fold's normal equations directly, of columns standardised by the rows that are fitted.
double validation_error(MatrixXd const& columns, VectorXd const& y, double penalty, std::vector<Fold> const& folds) {
  double sum = 0;
  for (auto const& fold : folds) {
    auto const rows = rows_outside(fold, y.size());
    double const n = double(rows.size());
    MatrixXd const fitted = columns(rows, Eigen::all);
    Eigen::RowVectorXd const mean = fitted.colwise().mean();
    MatrixXd const c = fitted.rowwise() - mean;
    Eigen::RowVectorXd const deviation = (c.colwise().squaredNorm() / n).cwiseSqrt();
    MatrixXd const z = c.array().rowwise() / deviation.array();
    VectorXd const yt = y(rows);
    MatrixXd const normal = z.transpose() * z / n + penalty * MatrixXd::Identity(z.cols(), z.cols());
    VectorXd const b = normal.ldlt().solve(z.transpose() * (yt.array() - yt.mean()).matrix() / n);
    for (Eigen::Index i = fold.first; i < fold.first + fold.count; ++i)
      sum += std::pow(y(i) - yt.mean() - (columns.row(i) - mean).cwiseQuotient(deviation).dot(b), 2);
  }
  return std::sqrt(sum / double(y.size()));
}

TEST(RidgeRegression, ChoosesThePenaltyOfLeastBlockedError) {
  for (std::uint64_t seed : {1, 2, 3, 4}) {
    auto const batch = random_walks(seed, 80, 6);
    auto const fit = ridge_regression(batch.temperature_rise, batch.error, contiguous_folds(80, 5));
    EXPECT_NEAR(fit.validation_rmse,
                validation_error(batch.temperature_rise, batch.error, fit.penalty, contiguous_folds(80, 5)), 1e-8);
    for (double factor : {0.01, 0.1, 0.5, 2.0, 10.0, 100.0}) {
      double const other = std::clamp(fit.penalty * factor, 1e-6, 1e2);
      EXPECT_GE(validation_error(batch.temperature_rise, batch.error, other, contiguous_folds(80, 5)),
                0.999 * fit.validation_rmse);
    }
  }
}

/// The first of twelve sensors tells the error, but for what each run has of its own; that is what the others' drifts
/// explain within a run, and in no other.
std::vector<Batch> runs_of_their_own(std::uint64_t seed, int runs) {
  std::mt19937_64 generator(seed);
  std::vector<Batch> batches;
  for (int r = 0; r < runs; ++r) {
    batches.push_back(random_walks(generator(), 100, 12));
    batches.back().error = (3 * batches.back().temperature_rise.col(0)).array() + 8 * normal(generator);
  }
  return batches;
}

/// What the cross-validation says is what other runs see, if it leaves out whole runs; a stretch, predicted from the
/// rest of its own run, promises less than half of it.
TEST(RidgeRegression, ValidatesByWhatOtherRunsSee) {
  double of_runs = 0, of_stretches = 0;  // logarithms of promised over seen
  constexpr int worlds = 20;
  for (std::uint64_t seed = 1; seed <= worlds; ++seed) {
    auto const training = runs_of_their_own(seed, 3);
    auto const known = stacked(training), others = stacked(runs_of_their_own(1000 + seed, 10));
    auto const promised = [&](std::vector<Fold> const& folds) {
      auto const fit = ridge_regression(known.temperature_rise, known.error, folds);
      VectorXd const missed = others.error - others.temperature_rise * fit.coefficients;
      double const seen = std::sqrt((missed.array() - fit.intercept).square().mean());
      return std::log(fit.validation_rmse / seen);
    };
    of_runs += promised(folds_of_runs(run_lengths(training), 5)) / worlds;
    of_stretches += promised(contiguous_folds(300, 5)) / worlds;
  }
  EXPECT_GT(std::exp(of_runs), 0.5);
  EXPECT_LT(std::exp(of_runs), 1.2);
  EXPECT_LT(std::exp(of_stretches), 0.5);
}

TEST(RidgeRegression, LeavesOutWholeRunsWhereThereAreSeveral) {
  int other_penalties = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    auto const training = runs_of_their_own(seed, 3);
    auto const known = stacked(training);
    auto const model = fit_ridge(training, {});
    auto const expected = ridge_regression(known.temperature_rise, known.error, folds_of_runs({100, 100, 100}, 5));
    EXPECT_EQ(std::get<LinearForm>(model.form).coefficients.reshaped(), expected.coefficients);
    auto const stretches = ridge_regression(known.temperature_rise, known.error, contiguous_folds(300, 5));
    other_penalties += stretches.penalty != expected.penalty;
  }
  EXPECT_GE(other_penalties, 5);
}

TEST(RidgeRegression, IsLeastSquaresWhereDataAreClean) {
  std::mt19937_64 generator(1);
  MatrixXd const x = MatrixXd::NullaryExpr(200, 3, [&] { return normal(generator); });
  VectorXd const y = (x * VectorXd::LinSpaced(3, -1, 2)).array() + 5.0;
  auto const fit = ridge_regression(x, y, contiguous_folds(y.size(), 5));
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
  auto const fit = ridge_regression(x, y, contiguous_folds(y.size(), 5));
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
  auto const fit = ridge_regression(batch.temperature_rise, batch.error, contiguous_folds(batch.error.size(), 5));
  EXPECT_EQ(fit.coefficients(2), 0.0);
  EXPECT_TRUE(fit.coefficients.allFinite());
}

}  // namespace
}  // namespace thermotwin::models
