#include "models/least_squares_support_vector.h"

#include <cmath>
#include <gtest/gtest.h>

#include "models/contiguous_folds.h"
#include "models/gaussian_kernel.h"
#include "models/metrics.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Batch golden() { return batch_of(Eigen::Vector3d(0, 0.5, 1), Eigen::Vector3d(0, 1, 0)); }

TEST(LeastSquaresSupportVector, HasTheGoldenSolution) {
  auto const model = fit_least_squares_support_vector(std::vector{golden()}, {});
  auto const& form = std::get<KernelForm>(model.form);
  EXPECT_NEAR(form.intercept, 0.0295, 5e-5);
  EXPECT_LT((form.weights - Eigen::Vector3d(-1.0056, 2.0112, -1.0056)).cwiseAbs().maxCoeff(), 5e-5);
  EXPECT_LT((model.predict(golden()) - Eigen::Vector3d(0.0179, 0.9642, 0.0179)).cwiseAbs().maxCoeff(), 5e-5);
  EXPECT_NEAR(form.weights.sum(), 0.0, 1e-14);
}

TEST(LeastSquaresSupportVector, SolvesTheWholeSystem) {
  auto const batch = random_walks(1, 60, 3);
  MatrixXd const kernel = gaussian_kernel(squared_distances(batch.temperature_rise, batch.temperature_rise), 0.3);
  double const gamma = 20.0;
  auto const fit = solve_least_squares(kernel, batch.error, gamma);
  EXPECT_NEAR(fit.weights.sum(), 0.0, 1e-9);
  VectorXd const left = kernel * fit.weights + fit.weights / gamma;
  EXPECT_LT(((left.array() + fit.intercept).matrix() - batch.error).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LeastSquaresSupportVector, KnowsWhatEachSampleMissesTheOthersBy) {
  constexpr Eigen::Index samples = 25;
  auto const batch = random_walks(3, samples, 2);
  MatrixXd const kernel = gaussian_kernel(squared_distances(batch.temperature_rise, batch.temperature_rise), 0.2);
  MatrixXd targets(samples, 2);
  targets << batch.error, batch.temperature_rise.col(0);
  auto const fit = solve_least_squares_leaving_out(kernel, targets, 10.0);
  for (Eigen::Index target = 0; target < 2; ++target) {
    auto const one = solve_least_squares(kernel, targets.col(target), 10.0);
    EXPECT_LT((fit.weights.col(target) - one.weights).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_NEAR(fit.intercepts(target), one.intercept, 1e-11);
    for (Eigen::Index i = 0; i < samples; ++i) {
      auto const others = rows_outside({i, 1}, samples);
      auto const trained = solve_least_squares(kernel(others, others), targets(others, target), 10.0);
      double const predicted = kernel(i, others).dot(trained.weights) + trained.intercept;
      EXPECT_NEAR(fit.left_out(i, target), targets(i, target) - predicted, 1e-10);
    }
  }
}

TEST(LeastSquaresSupportVector, CountsItsParametersAsTheTraceOfItsInfluence) {
  auto const batch = random_walks(2, 30, 2);
  MatrixXd const kernel = gaussian_kernel(squared_distances(batch.temperature_rise, batch.temperature_rise), 0.2);
  auto const fitted = [&](VectorXd const& y) {
    auto const fit = solve_least_squares(kernel, y, 10.0);
    return VectorXd((kernel * fit.weights).array() + fit.intercept);
  };
  double trace = 0;
  for (Eigen::Index i = 0; i < 30; ++i)
    trace += fitted(batch.error + VectorXd::Unit(30, i))(i) - fitted(batch.error)(i);
  EXPECT_NEAR(solve_least_squares(kernel, batch.error, 10.0).parameters, trace, 1e-8);
}

/// Paper 002's motive: interpolation copies the noise of a measurement, LS-SVM averages it.
TEST(LeastSquaresSupportVector, IsNearerToANoisyFieldThanItsOwnPoints) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 generator(seed);
    VectorXd const place = VectorXd::LinSpaced(41, 0.0, 0.2);
    VectorXd const truth = 8.0 * (VectorXd((20.0 * place).array().sin())) + 30.0 * place;
    VectorXd measured = truth;
    for (auto& value : measured) value += 0.5 * normal(generator);
    auto const model = fit_least_squares_support_vector(std::vector{batch_of(place, measured)}, {});
    // Between the points the line through both neighbours carries √½ of the noise.
    VectorXd const middle = 0.5 * (place.head(40) + place.tail(40));
    VectorXd const field = 8.0 * (VectorXd((20.0 * middle).array().sin())) + 30.0 * middle;
    VectorXd const line = 0.5 * (measured.head(40) + measured.tail(40));
    better += metrics(field, model.predict(batch_of(middle, field))).rmse < metrics(field, line).rmse;
  }
  EXPECT_EQ(better, 20);
}

}  // namespace
}  // namespace thermotwin::models
