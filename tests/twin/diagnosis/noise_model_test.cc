#include "twin/diagnosis/noise_model.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tests/twin/diagnosis/normal_matrix.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using tests::normal;

ChannelNoise noise() { return {0.08, 0.02, 0.1, 600.0, 0.3, 3.0 * 3600.0}; }

/// Rows of uneven length, as between the jumps of a programme.
VectorXd uneven_times(Index rows) {
  VectorXd time(rows);
  double at = 0.0;
  for (Index r = 0; r < rows; ++r) time[r] = at += 60.0 + 240.0 * double(r % 3);
  return time;
}

/// cov e(t) e(t'), written down.
MatrixXd covariance(ChannelNoise const& n, VectorXd const& time, VectorXd const& samples) {
  MatrixXd S(time.size(), time.size());
  for (Index i = 0; i < time.size(); ++i)
    for (Index j = 0; j < time.size(); ++j) {
      double const apart = std::abs(time[i] - time[j]);
      S(i, j) = n.fast * n.fast * std::exp(-apart / n.fast_time) + n.slow * n.slow * std::exp(-apart / n.slow_time);
      if (i == j) S(i, j) += n.white * n.white / samples[i] + n.rounding * n.rounding;
    }
  return S;
}

/// With the same σ₂ in all rows.
Whitening whitening(ChannelNoise const& noise, VectorXd const& time, VectorXd const& samples) {
  return {noise, time, samples, VectorXd::Constant(time.size(), noise.slow)};
}

double log_likelihood(Whitening const& whitening, MatrixXd signal) {
  whitening.apply(signal);
  return -0.5 * signal.squaredNorm() - whitening.log_scale();
}

TEST(Whitening, LikelihoodIsThatOfTheWholeGaussian) {
  Index const rows = 30;
  VectorXd const time = uneven_times(rows);
  VectorXd samples(rows);
  for (Index r = 0; r < rows; ++r) samples[r] = double(1 + r % 7);
  MatrixXd const S = covariance(noise(), time, samples);
  VectorXd const e = 0.4 * normal(rows, 1, 3);
  Eigen::LLT<MatrixXd> const solver(S);
  double const logarithm = 2.0 * solver.matrixLLT().diagonal().array().log().sum();
  double const whole = -0.5 * (e.dot(solver.solve(e)) + logarithm + double(rows) * std::log(2.0 * std::numbers::pi));
  EXPECT_NEAR(log_likelihood(whitening(noise(), time, samples), e), whole, 1e-9);
}

/// Rows without a sample are time only: the likelihood of the others, and nothing where they stand.
TEST(Whitening, MissingRowsAreOnlyTime) {
  Index const rows = 30;
  VectorXd const time = uneven_times(rows);
  VectorXd samples = VectorXd::Constant(rows, 5.0);
  std::vector<Index> seen;
  for (Index r = 0; r < rows; ++r)
    if (r == 0 || r == 29 || (r > 10 && r < 15))
      samples[r] = 0.0;
    else
      seen.push_back(r);
  MatrixXd const e = 0.4 * normal(rows, 2, 4);
  Whitening const all = whitening(noise(), time, samples), others = whitening(noise(), time(seen), samples(seen));
  EXPECT_NEAR(all.log_scale(), others.log_scale(), 1e-10);
  MatrixXd with = e, without = e(seen, Eigen::all);
  all.apply(with);
  others.apply(without);
  EXPECT_TRUE(with(seen, Eigen::all).isApprox(without, 1e-10));
  for (Index const r : {0, 11, 14, 29}) EXPECT_EQ(with.row(r).norm(), 0.0);
}

/// An NaN where nothing was measured does not spread.
TEST(Whitening, WhatStandsInAMissingRowDoesNotMatter) {
  VectorXd const time = uneven_times(20);
  VectorXd samples = VectorXd::Ones(20);
  samples[7] = 0.0;
  MatrixXd clean = normal(20, 1, 5), poor = clean;
  poor(7, 0) = std::nan("");
  Whitening const filter = whitening(noise(), time, samples);
  filter.apply(clean);
  filter.apply(poor);
  EXPECT_EQ(clean, poor);
}

/// Signals of that covariance become white: 400 of them, 200 rows each.
TEST(Whitening, InnovationsAreWhiteAndOfVarianceOne) {
  Index const rows = 200, signals = 400;
  VectorXd const time = uneven_times(rows), samples = VectorXd::Constant(rows, 3.0);
  Eigen::LLT<MatrixXd> const factor(covariance(noise(), time, samples));
  MatrixXd white = factor.matrixL() * normal(rows, signals, 6);
  whitening(noise(), time, samples).apply(white);
  double const count = double(white.size());
  EXPECT_NEAR(white.mean(), 0.0, 4.0 / std::sqrt(count));
  EXPECT_NEAR(white.squaredNorm() / count, 1.0, 4.0 * std::sqrt(2.0 / count));
  for (Index const lag : {1, 2, 3, 10, 50}) {
    double const product = white.topRows(rows - lag).cwiseProduct(white.bottomRows(rows - lag)).mean();
    EXPECT_NEAR(product, 0.0, 4.0 / std::sqrt(double((rows - lag) * signals))) << lag;
  }
}

/// Residuals and sensitivities pass through the same filter.
TEST(Whitening, IsLinear) {
  VectorXd const time = uneven_times(50), samples = VectorXd::Ones(50);
  Whitening const filter = whitening(noise(), time, samples);
  MatrixXd both = normal(50, 3, 7);
  both.col(2) = 2.0 * both.col(0) - 0.3 * both.col(1);
  filter.apply(both);
  EXPECT_TRUE(both.col(2).isApprox(2.0 * both.col(0) - 0.3 * both.col(1), 1e-12));
}

TEST(Whitening, OfWhiteNoiseIsDivision) {
  ChannelNoise const plain{0.1, 0.0, 0.0, 600.0, 0.0, 3600.0};
  VectorXd const time = uneven_times(10), samples = VectorXd::Constant(10, 4.0);
  MatrixXd signal = normal(10, 1, 8);
  MatrixXd const before = signal;
  whitening(plain, time, samples).apply(signal);
  EXPECT_TRUE(signal.isApprox(before / 0.05, 1e-12));
}

/// A lasting model error makes a constant all but invisible: n rows say as much of it as one, in the limit.
TEST(Whitening, ASlowErrorHidesAnOffset) {
  VectorXd const time = VectorXd::LinSpaced(100, 0.0, 99 * 60.0), samples = VectorXd::Ones(100);
  ChannelNoise const lasting{0.01, 0.0, 0.0, 600.0, 0.5, 1e9};
  MatrixXd constant = MatrixXd::Ones(100, 1);
  whitening(lasting, time, samples).apply(constant);
  EXPECT_NEAR(constant.squaredNorm(), 1.0 / (0.25 + 0.01 * 0.01 / 100.0), 1e-3);
}

/// σ₂ that changes from row to row: cov = σ₂(t) σ₂(t') exp(−|t − t'|/τ₂).
TEST(Whitening, FollowsASlowErrorThatGrows) {
  Index const rows = 30;
  VectorXd const time = uneven_times(rows), samples = VectorXd::Constant(rows, 4.0);
  VectorXd const slow = VectorXd::LinSpaced(rows, 0.0, 0.5);
  ChannelNoise rest = noise();
  rest.slow = 0.0;
  MatrixXd S = covariance(rest, time, samples);
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < rows; ++j)
      S(i, j) += slow[i] * slow[j] * std::exp(-std::abs(time[i] - time[j]) / rest.slow_time);
  VectorXd const e = 0.4 * normal(rows, 1, 9);
  Eigen::LLT<MatrixXd> const solver(S);
  double const logarithm = 2.0 * solver.matrixLLT().diagonal().array().log().sum();
  double const whole = -0.5 * (e.dot(solver.solve(e)) + logarithm + double(rows) * std::log(2.0 * std::numbers::pi));
  EXPECT_NEAR(log_likelihood({rest, time, samples, slow}, e), whole, 1e-9);
}

/// Nothing before the channel moves, most where it has gone furthest, a third of that when τ₂ has passed at rest.
TEST(ChannelNoise, GrowsWithTheWayFromTheStartAndForgetsIt) {
  ChannelNoise along{0.03, 0.0, 0.1, 600.0, 0.02, 3600.0};
  along.way_share = 0.1;
  VectorXd const time = 1800.0 * VectorXd::LinSpaced(7, 0.0, 6.0);
  VectorXd values(7);
  values << 293.0, 293.0, 303.0, 303.0, std::nan(""), 293.0, 293.0;
  VectorXd expected(7);
  expected << 0.0, 0.0, 1.0, 1.0, std::exp(-0.5), std::exp(-1.0), std::exp(-1.5);
  EXPECT_TRUE(along.slow_along(time, values).isApprox((expected.array() + 0.02).matrix(), 1e-12));
}

}  // namespace
}  // namespace thermotwin::twin
