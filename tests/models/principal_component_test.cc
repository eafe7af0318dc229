#include "models/principal_component.h"

#include <gtest/gtest.h>

#include "models/distributed_lag.h"
#include "models/linear_regression.h"
#include "models/principal_component_distributed_lag.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Sensors that a few hidden courses drive, each with its own noise.
Batch collinear(std::uint64_t seed, Eigen::Index sensors, double noise) {
  std::mt19937_64 generator(seed);
  MatrixXd rise(120, sensors);
  VectorXd const fast = warm_up(20, 20, 120, 0, generator), slow = warm_up(12, 70, 120, 0, generator);
  for (Eigen::Index j = 0; j < sensors; ++j) {
    double const share = uniform(generator);
    rise.col(j) = share * fast + (1 - share) * slow;
    for (auto& x : rise.col(j)) x += noise * normal(generator);
  }
  return batch_of(rise, 2.0 * fast + slow);
}

TEST(PrincipalComponents, DiagonaliseTheCorrelationMatrix) {
  auto const batch = collinear(1, 6, 0.5);
  auto const components = principal_components(batch.temperature_rise);
  MatrixXd const z = (batch.temperature_rise.rowwise() - components.mean.transpose()).array().rowwise() /
                     components.deviation.transpose().array();
  MatrixXd const r = z.transpose() * z / 119.0;
  EXPECT_LT((r * components.directions - components.directions * components.variances.asDiagonal()).norm(), 1e-12);
  EXPECT_LT((r.diagonal().array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_NEAR(components.variances.sum(), 6.0, 1e-12);
  for (int k = 1; k < 6; ++k) EXPECT_GE(components.variances(k - 1), components.variances(k));
}

TEST(PrincipalComponents, CountIsTheLeastThatExplainsMoreThanTheShare) {
  PrincipalComponents components;
  components.variances = (VectorXd(4) << 2.0, 1.4, 0.4, 0.2).finished();
  EXPECT_EQ(components.count_for(0.49), 1);
  EXPECT_EQ(components.count_for(0.5), 2);  // more than, not at least
  EXPECT_EQ(components.count_for(0.85), 3);
  EXPECT_EQ(components.count_for(0.99), 4);
}

TEST(ComponentRegression, WithAllComponentsIsLeastSquares) {
  for (std::uint64_t seed : {1, 2, 3}) {
    auto const batch = collinear(seed, 5, 0.2);
    auto const components = principal_components(batch.temperature_rise);
    auto const fit = component_regression(batch.temperature_rise, batch.error, components, 5);
    auto const reference = linear_regression(batch.temperature_rise, batch.error);
    EXPECT_NEAR(fit.intercept, reference.intercept, 1e-8);
    EXPECT_LT((fit.coefficients - reference.coefficients).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(ComponentRegression, PredictsBySensorsWhatItPredictsByComponents) {
  auto const batch = collinear(4, 5, 0.2);
  auto const components = principal_components(batch.temperature_rise);
  auto const fit = component_regression(batch.temperature_rise, batch.error, components, 2);
  MatrixXd const z = (batch.temperature_rise.rowwise() - components.mean.transpose()).array().rowwise() /
                     components.deviation.transpose().array();
  VectorXd const by_components = (z * components.directions.leftCols(2) * fit.scores).array() + batch.error.mean();
  VectorXd const by_sensors = (batch.temperature_rise * fit.coefficients).array() + fit.intercept;
  EXPECT_LT((by_components - by_sensors).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(PrincipalComponentModel, KeepsOneComponentOfSensorsThatMoveAlike) {
  std::vector const batches{collinear(5, 6, 0.05)};
  auto const model = fit_principal_component(batches, {});
  EXPECT_EQ(model.parameters, 2);
  EXPECT_TRUE(model.remark.starts_with("1 of 6 components")) << model.remark;
}

TEST(PrincipalComponentDistributedLag, IsComponentRegressionOnTheLagMatrix) {
  std::vector const batches{collinear(6, 3, 0.3), collinear(7, 3, 0.3)};
  auto const model = fit_principal_component_distributed_lag(batches, {});
  auto const& form = std::get<LinearForm>(model.form);
  EXPECT_EQ(form.lags, (std::vector{0, 1, 2}));

  MatrixXd matrix(2 * 118, 9);
  VectorXd error(2 * 118);
  for (int b = 0; b < 2; ++b)
    for (int t = 2; t < 120; ++t) {
      error(118 * b + t - 2) = batches[std::size_t(b)].error(t);
      for (int lag = 0; lag < 3; ++lag)
        matrix.row(118 * b + t - 2).segment(3 * lag, 3) = batches[std::size_t(b)].temperature_rise.row(t - lag);
    }
  auto const components = principal_components(matrix);
  auto const reference = component_regression(matrix, error, components, components.count_for(0.85));
  EXPECT_NEAR(form.intercept, reference.intercept, 1e-10);
  EXPECT_LT((form.coefficients.reshaped() - reference.coefficients).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace thermotwin::models
