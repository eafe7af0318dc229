#include "models/support_vector.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
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

/// Mean 0 and variance 1, and how it was brought there.
struct Standard {
  Eigen::RowVectorXd mean, deviation;

  explicit Standard(MatrixXd const& columns)
      : mean(columns.colwise().mean()),
        deviation(((columns.rowwise() - mean).colwise().squaredNorm() / double(columns.rows())).cwiseSqrt()) {}
  [[nodiscard]] MatrixXd of(MatrixXd const& columns) const {
    return (columns.rowwise() - mean).array().rowwise() / deviation.array();
  }
};

/// Squared error on each run of a machine that knows the others only, their means and deviations included.
double error_on_other_runs(std::vector<Batch> const& runs, double cost, double g) {
  double sum = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    auto others = runs;
    others.erase(others.begin() + std::ptrdiff_t(r));
    auto const known = stacked(others);
    Standard const input(known.temperature_rise), target(known.error);
    MatrixXd const x = input.of(known.temperature_rise);
    auto const fit = SupportVectorSolver(gaussian_kernel(squared_distances(x, x), g))
                         .solve(target.of(known.error), all_rows(known.error.size()), {.cost = cost});
    MatrixXd const kernel = gaussian_kernel(squared_distances(input.of(runs[r].temperature_rise), x), g);
    VectorXd const predicted = ((kernel * fit.weights).array() + fit.intercept) * target.deviation(0) + target.mean(0);
    sum += (predicted - runs[r].error).squaredNorm();
  }
  return sum;
}

/// Runs about other temperatures, of which each bends in its own part.
TEST(SupportVectorModel, TakesThePairThatPredictsOtherRunsBest) {
  for (std::uint64_t world : {1, 2, 3, 4}) {
    std::vector<Batch> runs;
    for (std::uint64_t r = 0; r < 3; ++r) {
      runs.push_back(bent(10 * world + r, 20 + 5 * Eigen::Index(r)));
      runs.back().temperature_rise.col(1).array() += 0.7 * double(r);
      runs.back().error.array() += 2.0 * double(r);
    }
    double cost = 0, g = 0, least = std::numeric_limits<double>::infinity(), best_cost = 0, best_g = 0;
    auto const remark = fit_support_vector(runs, {}).remark;
    ASSERT_EQ(std::sscanf(remark.c_str(), "C = %lf, g = %lf", &cost, &g), 2) << remark;
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j)
        if (double const error = error_on_other_runs(runs, std::exp2(i), std::exp2(j)); error < least) {
          least = error;
          best_cost = std::exp2(i);
          best_g = std::exp2(j);
        }
    EXPECT_EQ(cost, best_cost) << world;
    EXPECT_EQ(g, best_g) << world;
  }
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
