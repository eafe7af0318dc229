#include "models/least_squares_support_vector.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>

#include "models/contiguous_folds.h"
#include "models/gaussian_kernel.h"
#include "models/metrics.h"
#include "models/support_vector.h"
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

/// Before there is a matrix of all their pairs.
TEST(LeastSquaresSupportVector, RefusesMoreSamplesThanAKernelHasRoomFor) {
  std::vector const batches = {random_walks(1, 10'001, 2)};
  for (auto* const fit : {&fit_least_squares_support_vector, &fit_support_vector})
    EXPECT_THAT([&] { (void)fit(batches, {}); },
                testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("10001 samples are too many")));
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

/// Paper 002's motive: interpolation copies the noise of a measurement, LS-SVM averages it. Errors of an axis of 200
/// mm, smooth over its length, 0.5 um of noise, judged on a grid ten times as fine as the measurement's.
TEST(LeastSquaresSupportVector, IsNearerToANoisyFieldThanALineFromPointToPoint) {
  constexpr Eigen::Index points = 41, fine = 401;
  int better = 0;
  constexpr int fields = 100;
  for (std::uint64_t seed = 1; seed <= fields; ++seed) {
    std::mt19937_64 generator(seed);
    double const slope = 60.0 * (uniform(generator) - 0.5), height = 2.0 + 8.0 * uniform(generator),
                 wave = 10.0 + 20.0 * uniform(generator), phase = 6.0 * uniform(generator);
    auto const field = [&](VectorXd const& place) {
      return VectorXd(slope * place.array() + height * (wave * place.array() + phase).sin());
    };
    VectorXd const place = VectorXd::LinSpaced(points, 0.0, 0.2), between = VectorXd::LinSpaced(fine, 0.0, 0.2);
    VectorXd measured = field(place), line(fine);
    for (auto& value : measured) value += 0.5 * normal(generator);
    for (Eigen::Index i = 0; i < fine; ++i) {
      Eigen::Index const left = std::min<Eigen::Index>(i / 10, points - 2);
      line(i) = measured(left) + (measured(left + 1) - measured(left)) * (double(i) / 10.0 - double(left));
    }
    auto const model = fit_least_squares_support_vector(std::vector{batch_of(place, measured)}, {});
    better += metrics(field(between), model.predict(batch_of(between, field(between)))).rmse <
              metrics(field(between), line).rmse;
  }
  EXPECT_GE(better, fields * 95 / 100);
}

}  // namespace
}  // namespace thermotwin::models
