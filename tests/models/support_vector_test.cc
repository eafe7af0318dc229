#include "models/support_vector.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>

#include "models/gaussian_kernel.h"
#include "models/linear.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Eigen::Index> all_rows(Eigen::Index count) {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(count));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// The error bends with the temperature; sensors of mean 0 and variance about 1.
Batch bent(std::uint64_t seed, Eigen::Index instants) {
  std::mt19937_64 generator(seed);
  MatrixXd const rise = MatrixXd::NullaryExpr(instants, 2, [&] { return normal(generator); });
  VectorXd error = 3.0 * rise.col(0).array() + 2.0 * (1.5 * rise.col(1).array()).sin();
  for (auto& e : error) e += 0.1 * normal(generator);
  return batch_of(rise, error);
}

TEST(SupportVectorSolver, MeetsTheConditionsOfOptimality) {
  auto const batch = bent(1, 80);
  MatrixXd const kernel = gaussian_kernel(squared_distances(batch.temperature_rise, batch.temperature_rise), 0.5);
  SupportVectorOptions const options{.cost = 4.0, .epsilon = 0.2, .tolerance = 1e-8};
  auto const fit = SupportVectorSolver(kernel).solve(batch.error, all_rows(80), options);
  VectorXd const residual = batch.error - ((kernel * fit.weights).array() + fit.intercept).matrix();
  EXPECT_NEAR(fit.weights.sum(), 0.0, 1e-9);
  constexpr double slack = 2e-5;  // LIBSVM keeps the kernel in single precision
  int bound = 0, free = 0, none = 0;
  for (Eigen::Index i = 0; i < 80; ++i) {
    double const weight = fit.weights(i), side = weight > 0 ? residual(i) : -residual(i);
    EXPECT_LE(std::abs(weight), options.cost);
    if (weight == 0) {
      ++none;
      EXPECT_LE(std::abs(residual(i)), options.epsilon + slack);
    } else if (std::abs(weight) < options.cost) {
      ++free;
      EXPECT_NEAR(side, options.epsilon, slack);
    } else {
      ++bound;
      EXPECT_GE(side, options.epsilon - slack);
    }
  }
  EXPECT_GT(bound, 0);
  EXPECT_GT(free, 0);
  EXPECT_GT(none, 0);
}

TEST(SupportVectorSolver, SeesOnlyTheRowsThatItIsGiven) {
  auto batch = bent(2, 60);
  MatrixXd const kernel = gaussian_kernel(squared_distances(batch.temperature_rise, batch.temperature_rise), 1.0);
  std::vector<Eigen::Index> const rows = all_rows(40);
  auto const before = SupportVectorSolver(kernel).solve(batch.error, rows, {});
  batch.error.tail(20).setConstant(1e3);
  auto const after = SupportVectorSolver(kernel).solve(batch.error, rows, {});
  EXPECT_EQ(before.weights, after.weights);
  EXPECT_EQ(before.weights.tail(20), VectorXd::Zero(20));
}

TEST(SupportVectorModel, TakesItsPairFromTheGrid) {
  auto const model = fit_support_vector(std::vector{bent(3, 60)}, {});
  double cost = 0, g = 0;
  ASSERT_EQ(std::sscanf(model.remark.c_str(), "C = %lf, g = %lf", &cost, &g), 2) << model.remark;
  for (double const value : {cost, g}) {
    EXPECT_EQ(std::log2(value), std::round(std::log2(value)));
    EXPECT_GE(value, 1.0 / 16.0);
    EXPECT_LE(value, 16.0);
  }
  EXPECT_EQ(g, std::get<KernelForm>(model.form).g);
}

TEST(SupportVectorModel, BendsWhereALineCannot) {
  std::vector const training{bent(4, 120)};
  auto const other = bent(5, 120);
  auto const rmse = [&](ErrorModel const& model) {
    return std::sqrt((model.predict(other) - other.error).squaredNorm() / 120.0);
  };
  EXPECT_LT(rmse(fit_support_vector(training, {})), 0.3 * rmse(fit_linear(training, {})));
}

TEST(SupportVectorModel, DoesNotDependOnUnits) {
  auto const batch = bent(6, 60);
  auto scaled = batch;
  scaled.error = (1000.0 * batch.error.array() + 7.0).matrix();
  auto const in_um = fit_support_vector(std::vector{batch}, {}).predict(batch);
  auto const in_nm = fit_support_vector(std::vector{scaled}, {}).predict(batch);
  EXPECT_LT(((in_nm.array() - 7.0).matrix() / 1000.0 - in_um).cwiseAbs().maxCoeff(), 1e-4);
}

}  // namespace
}  // namespace thermotwin::models
