#include "models/linear_regression.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace thermotwin::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Two sensors that warm up, one that swings; the residual is no multiple of any of them.
MatrixXd warm_up(Index samples) {
  MatrixXd x(samples, 3);
  for (Index i = 0; i < samples; ++i) {
    auto const t = static_cast<double>(i);
    x.row(i) << 8 * (1 - std::exp(-t / 9)), 5 * (1 - std::exp(-t / 4)) + 0.3 * std::sin(0.7 * t),
        2 * std::cos(0.35 * t);
  }
  return x;
}

VectorXd error_of(MatrixXd const& x) {
  VectorXd y(x.rows());
  for (Index i = 0; i < x.rows(); ++i) {
    auto const t = static_cast<double>(i);
    y(i) = 3 + 1.5 * x(i, 0) - 0.8 * x(i, 1) + 0.05 * x(i, 2) + 0.4 * std::sin(1.3 * t) + 0.2 * std::cos(0.21 * t);
  }
  return y;
}

void expect_relative(double value, double reference, double tolerance = 1e-10) {
  EXPECT_NEAR(value / reference, 1.0, tolerance) << value << " instead of " << reference;
}

void expect_relative(VectorXd const& value, std::initializer_list<double> reference) {
  ASSERT_EQ(value.size(), static_cast<Index>(reference.size()));
  Index i = 0;
  for (double const number : reference) expect_relative(value(i++), number);
}

// References: numpy 1.24 (lstsq, explicit sums for Newey-West) and scipy.stats 1.10 (f.sf, t.sf) on the data above.
TEST(LinearRegression, StatisticsOfAWarmUpAgreeWithScipy) {
  MatrixXd const x = warm_up(24);
  auto const fit = linear_regression(x, error_of(x), {.hac_lags = 3});

  expect_relative(fit.intercept, 3.3041375085765683);
  expect_relative(fit.coefficients, {1.4277498365899675, -0.7943962899447043, 0.06990358061513222});
  EXPECT_EQ(fit.degrees_of_freedom, 20);
  expect_relative(fit.F, 378.19232118750097);
  expect_relative(fit.p_F, 8.929808253120821e-18);
  expect_relative(fit.r_squared, 0.9826776381036662);
  expect_relative(fit.adjusted_r_squared, 0.980079283819216);
  expect_relative(fit.residual_deviation, 0.30659994522139566);
  expect_relative(fit.largest_residual, 0.44066787530683094);
  expect_relative(fit.standard_errors, {0.11830827862873379, 0.201398211946097, 0.059425207012432285});
  expect_relative(fit.t, {12.0680467431229, -3.944405872666435, 1.1763287690442166});
  expect_relative(fit.p, {1.2301956861256955e-10, 0.0008011657003092004, 0.2532756307910693});
  expect_relative(fit.hac_standard_errors, {0.0912012630497313, 0.1592538814710512, 0.05250752804591583});
  expect_relative(fit.hac_t, {15.654934908208753, -4.988238167928785, 1.3313058758737262});
  expect_relative(fit.hac_p, {1.0914789267441227e-12, 7.061413340431434e-05, 0.19806534927262115});
}

TEST(LinearRegression, LongRecordAgreesWithScipyAndTakesTheUsualLags) {
  MatrixXd const x = warm_up(300);
  auto const fit = linear_regression(x, error_of(x));

  EXPECT_EQ(fit.hac_lags, 5);  // ⌊4 · 3^(2/9)⌋
  expect_relative(fit.F, 1386.4135029853999);
  expect_relative(fit.p_F, 6.951867130318152e-174);
  expect_relative(fit.t, {45.324940949087775, -12.781107040468708, 3.6420335021512202});
  expect_relative(fit.hac_standard_errors, {0.030309684822113762, 0.06362159355328317, 0.01246084425699306});
  expect_relative(fit.hac_t, {49.83782916748362, -13.75810815258354, 3.7878784739159745});
}

TEST(LinearRegression, NoProductOfTwoRunsEntersTheRobustErrors) {
  MatrixXd const x = warm_up(24);
  auto const fit = linear_regression(x, error_of(x), {.run_lengths = {10, 14}, .hac_lags = 2});

  expect_relative(fit.hac_standard_errors, {0.09196891646415409, 0.15407759146964106, 0.06005542968794545});
}

TEST(LinearRegression, UnitsOfRegressorsDoNotMatter) {
  MatrixXd const x = warm_up(40);
  VectorXd const y = error_of(x);
  MatrixXd scaled = x;
  scaled.col(1) = scaled.col(1) * 1e9 + VectorXd::Constant(40, 3e11);
  auto const plain = linear_regression(x, y);
  auto const other = linear_regression(scaled, y);

  for (Index i = 0; i < 3; ++i) expect_relative(other.t(i), plain.t(i), 1e-7);
  expect_relative(other.coefficients(1) * 1e9, plain.coefficients(1), 1e-7);
  EXPECT_LT((other.residuals - plain.residuals).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LinearRegression, ExactRelationIsFoundWithPVanishing) {
  MatrixXd const x = warm_up(20);
  VectorXd const y = (x * Eigen::Vector3d(2, -1, 0.5)).array() + 4;
  auto const fit = linear_regression(x, y);

  EXPECT_LT((fit.coefficients - Eigen::Vector3d(2, -1, 0.5)).norm(), 1e-12);
  EXPECT_NEAR(fit.intercept, 4, 1e-12);
  EXPECT_LT(fit.p.maxCoeff(), 1e-30);
  EXPECT_GT(fit.r_squared, 1 - 1e-14);
}

TEST(LinearRegression, PositiveAutocorrelationWidensTheRobustErrors) {
  Index const samples = 200;
  MatrixXd x(samples, 1);
  VectorXd y(samples);
  for (Index i = 0; i < samples; ++i) {
    auto const t = static_cast<double>(i);
    x(i, 0) = t;
    y(i) = 0.1 * t + std::sin(0.05 * t);  // residuals stay on one side for 60 samples
  }
  auto const fit = linear_regression(x, y, {.hac_lags = 20});

  EXPECT_GT(fit.hac_standard_errors(0), 2 * fit.standard_errors(0));
}

TEST(LinearRegression, RefusesWhatItCannotAnswer) {
  MatrixXd x = warm_up(10);
  VectorXd const y = error_of(x);
  RegressionOptions const named{.names = {"motor", "nut", "bed"}};

  EXPECT_THAT([&] { linear_regression(x.topRows(4), y.head(4)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("4 samples are too few for 3 regressors: at least 5")));
  EXPECT_THAT([&] { linear_regression(x, VectorXd::Constant(10, 2.0)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("the response is constant")));
  x.col(2).setConstant(0.1);
  EXPECT_THAT([&] { linear_regression(x, y, named); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("regressor 'bed' is constant")));
  x.col(2) = 2 * x.col(0) - x.col(1);
  EXPECT_THAT([&] { linear_regression(x, y, named); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("regressor 'bed' is a combination of the ones before")));
  x(3, 1) = std::nan("");
  EXPECT_THAT([&] { linear_regression(x, y, named); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("regressor 'nut' holds a value that is no number")));
}

}  // namespace
}  // namespace thermotwin::models
