#include "models/distributed_lag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/distributed_lag_adhoc.h"
#include "models/linear_regression.h"
#include "models/ridge_distributed_lag.h"
#include "models/training_set.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::HasSubstr;

/// White inputs, each lag nearly orthogonal to the others, with the error of known coefficients (p × lags).
Batch white(std::uint64_t seed, Eigen::Index instants, MatrixXd const& coefficients, double noise) {
  std::mt19937_64 generator(seed);
  MatrixXd const rise = MatrixXd::NullaryExpr(instants, coefficients.rows(), [&] { return normal(generator); });
  VectorXd error = VectorXd::Constant(instants, 4.0);
  for (Eigen::Index t = 0; t < instants; ++t) {
    for (Eigen::Index lag = 0; lag < coefficients.cols(); ++lag)
      error(t) += rise.row(std::max<Eigen::Index>(0, t - lag)).dot(coefficients.col(lag));
    error(t) += noise * normal(generator);
  }
  return batch_of(rise, error);
}

MatrixXd const known = (MatrixXd(2, 3) << 3.0, 1.5, -0.8, -2.0, 0.7, 0.4).finished();

TEST(DistributedLag, RecoversKnownCoefficientsWithinThreeStandardErrors) {
  int inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector const batches{white(seed, 200, known, 0.5)};
    auto const set = training_set(batches, lags_up_to(2));
    auto const fit = linear_regression(set.regressors, set.error);
    auto const model = fit_distributed_lag(batches, {});
    VectorXd const found = std::get<LinearForm>(model.form).coefficients.reshaped();
    for (Eigen::Index k = 0; k < 6; ++k, ++all)
      inside += std::abs(found(k) - known.reshaped()(k)) < 3.0 * fit.standard_errors(k);
  }
  EXPECT_GE(inside, all - 2);  // 0.3 % lie outside of three
}

TEST(DistributedLag, FitsOnTheRowsThatHaveAHistory) {
  std::vector const batches{white(1, 50, known, 0.1), white(2, 60, known, 0.1)};
  EXPECT_EQ(training_set(batches, lags_up_to(2)).error.size(), 48 + 58);
  EXPECT_EQ(training_set(batches, lags_up_to(2), History::rest).error.size(), 110);
  EXPECT_EQ(fit_distributed_lag(batches, {}).parameters, 7);
}

TEST(DistributedLag, LagsStayInTheirBatch) {
  auto const a = white(1, 30, known, 0.0), b = white(2, 30, known, 0.0);
  auto const both = training_set(std::vector{a, b}, lags_up_to(2)),
             second = training_set(std::vector{b}, lags_up_to(2));
  EXPECT_EQ(both.regressors.bottomRows(28), second.regressors);
}

/// The rows [first, N) of a run, as a batch that knows the ones before it.
Batch behind(Batch const& run, Eigen::Index first) {
  Eigen::Index const rows = run.time.size() - first;
  auto part = batch_of(run.temperature_rise.bottomRows(rows), run.error.tail(rows));
  part.before = run.temperature_rise.topRows(first);
  return part;
}

/// A machine does not rest in the middle of a run: a batch cut out of it has the lags that it has there, all of them.
TEST(DistributedLag, ABatchCutOutOfARunHasTheRunsHistory) {
  auto const run = white(1, 40, known, 0.1);
  for (Eigen::Index const first : {1, 5, 25})
    for (auto const history : {History::dropped, History::rest}) {
      std::vector<int> const lags{0, 2, 7};
      auto const whole = training_set(std::vector{run}, lags, history),
                 part = training_set(std::vector{behind(run, first)}, lags, history);
      Eigen::Index const rows = std::min(40 - first, whole.error.size());
      EXPECT_EQ(part.error, whole.error.tail(rows));
      EXPECT_EQ(part.regressors, whole.regressors.bottomRows(rows));
    }
  for (auto const fit : {fit_distributed_lag, fit_ridge_distributed_lag}) {
    auto const model = fit(std::vector{run}, {});
    EXPECT_LT((model.predict(behind(run, 25)) - model.predict(run).tail(15)).cwiseAbs().maxCoeff(), 1e-12);
  }
}

/// Both sides of a gap are one run: it is folded by stretches, not by its two sides.
TEST(DistributedLag, BothSidesOfAGapAreOneRun) {
  auto const run = white(1, 40, known, 0.1), other = white(2, 30, known, 0.1);
  std::vector const batches{batch_of(run.temperature_rise.topRows(10), run.error.head(10)), behind(run, 25), other};
  EXPECT_THAT(run_lengths(batches), ElementsAre(25, 30));
  EXPECT_THAT(training_set(batches, lags_up_to(2)).run_lengths, ElementsAre(8 + 15, 28));
  EXPECT_THAT(with_sensors(batches[1], std::vector<Eigen::Index>{1}).before, run.temperature_rise.col(1).head(25));
}

TEST(AdhocLagOrder, FindsTheOrderOfOrthogonalInputs) {
  EXPECT_EQ(adhoc_lag_order(std::vector{white(3, 300, known, 0.3)}).order, 2);
  EXPECT_EQ(adhoc_lag_order(std::vector{white(4, 300, known.leftCols(2), 0.3)}).order, 1);
  auto const none = adhoc_lag_order(std::vector{white(5, 300, known.leftCols(1), 0.3)});
  EXPECT_EQ(none.order, 0);
  EXPECT_THAT(none.reason, HasSubstr("no coefficient of lag 1 is significant"));
}

TEST(AdhocLagOrder, StopsWhereCollinearityTurnsASign) {
  std::mt19937_64 generator(1);
  VectorXd const sensor = 0.5 * (warm_up(20, 10, 90, 0.002, generator) + warm_up(20, 60, 90, 0.002, generator));
  VectorXd const deep = warm_up(20, 45, 90, 0, generator);
  auto const found = adhoc_lag_order(std::vector{batch_of(sensor, deep)});
  EXPECT_EQ(found.order, 1);
  EXPECT_THAT(found.reason, HasSubstr("T1, 1 sample ago changes its sign at order 2"));
}

TEST(AdhocLagOrder, StopsWhereALagSaysNothingNew) {
  std::mt19937_64 generator(1);
  VectorXd const sensor = warm_up(20, 30, 90, 0, generator), deep = warm_up(20, 45, 90, 0, generator);
  auto const found = adhoc_lag_order(std::vector{batch_of(sensor, deep)});  // x_{t−1} is a + b x_t exactly
  EXPECT_EQ(found.order, 0);
  EXPECT_THAT(found.reason, HasSubstr("'T1, 1 sample ago' is a combination of the ones before it"));
}

/// Every lag matters, ten times less than the one before it: only the samples end the search. Order 10 has 12 numbers
/// for 14 rows, order 11 would have 13 for 13.
TEST(AdhocLagOrder, EndsWithTheSamples) {
  MatrixXd fading(1, 16);
  for (Eigen::Index i = 0; i < 16; ++i) fading(0, i) = std::pow(0.1, double(i));
  auto const found = adhoc_lag_order(std::vector{white(6, 24, fading, 0.0)});
  EXPECT_EQ(found.order, 10);
  EXPECT_EQ(found.reason, "too few samples for order 11");
}

TEST(AdhocLagModel, UsesTheOrderAndSaysWhy) {
  auto const model = fit_distributed_lag_adhoc(std::vector{white(3, 300, known, 0.3)}, {});
  EXPECT_THAT(std::get<LinearForm>(model.form).lags, ElementsAre(0, 1, 2));
  EXPECT_THAT(model.remark, HasSubstr("order 2 by the rule"));
}

TEST(GeometricLags, AreMinutesInSamplesEachOnce) {
  EXPECT_THAT(geometric_lags(15.0), ElementsAre(0, 20, 40, 80, 160, 320));
  EXPECT_THAT(geometric_lags(180.0), ElementsAre(0, 2, 3, 7, 13, 27));
  EXPECT_THAT(geometric_lags(900.0), ElementsAre(0, 1, 3, 5));
}

/// A bar's tip follows its base with 25 min; the base alone cannot tell, its past can.
TEST(RidgeDistributedLag, PredictsALaggingResponseInAnotherRun) {
  auto const run = [](std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    MatrixXd base(240, 1);
    VectorXd tip(240);
    double heat = 0, x = 0, y = 0;
    for (Eigen::Index t = 0; t < 240; ++t) {
      base(t, 0) = x + 0.01 * normal(generator);
      tip(t) = 3.0 * y;
      if (t % 40 == 0) heat = 20.0 * uniform(generator);
      x += (heat - x) / 8.0;
      y += (x - y) / 25.0;
    }
    return batch_of(base, tip);
  };
  std::vector const training{run(1)};
  auto const other = run(2);
  auto const rmse = [&](ErrorModel const& model) {
    return std::sqrt((model.predict(other) - other.error).squaredNorm() / 240.0);
  };
  EXPECT_LT(rmse(fit_ridge_distributed_lag(training, {})), 0.2 * rmse(fit_distributed_lag(training, {})));
}

}  // namespace
}  // namespace thermotwin::models
