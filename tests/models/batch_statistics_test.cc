#include "models/batch_statistics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

#include "models/error_model.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(ResidualDeviation, DividesByTheFreedomOnTheOwnBatchAndByTheSamplesOnOthers) {
  Eigen::Vector4d const truth(1, 2, 3, 4), prediction(2, 2, 1, 4);  // Σ e² = 5
  EXPECT_DOUBLE_EQ(residual_deviation(truth, prediction, 2), std::sqrt(5.0 / 2.0));
  EXPECT_DOUBLE_EQ(residual_deviation(truth, prediction), std::sqrt(5.0 / 4.0));
  EXPECT_DOUBLE_EQ(residual_deviation(truth, prediction, 78), std::sqrt(5.0 / 4.0));
  EXPECT_THROW(residual_deviation(truth, VectorXd::Zero(3)), std::invalid_argument);
}

TEST(BatchStatistics, AreWhatAHandComputes) {
  MatrixXd const deviations = (MatrixXd(3, 5) << 1, 4, 8, 3, 5,  //
                               2, 0.5, 6, 7, 7,                  //
                               3, 9, 2, 1, 4)
                                  .finished();
  auto const statistics = batch_statistics(deviations);
  EXPECT_LT((statistics.S - Eigen::Vector3d(1, 0.5, 2)).norm(), 1e-14);
  EXPECT_LT((statistics.Mn - Eigen::Vector3d(6, 4, 6)).norm(), 1e-14);  // (4+8)/2, (2+6)/2, (3+9)/2
  // divisor L − 2 = 1: √((4−6)² + (8−6)²), √(4 + 4), √(9 + 9)
  EXPECT_LT((statistics.Sd - Eigen::Vector3d(std::sqrt(8.0), std::sqrt(8.0), std::sqrt(18.0))).norm(), 1e-14);
  EXPECT_LT((statistics.verification_Mn - Eigen::Vector3d(4, 7, 2.5)).norm(), 1e-14);
  EXPECT_LT((statistics.verification_Sd - Eigen::Vector3d(std::sqrt(2.0), 0, std::sqrt(4.5))).norm(), 1e-14);
}

/// Twelve models on the twelve batches of their own and six to verify: the error of model l on batch k is l + 2k in
/// size, of alternating sign, and it claims all but the first two instants.
TEST(BatchStatistics, OfTwelveBatchesAndSixToVerifyStandInAMatrixOfTwelveByEighteen) {
  constexpr int samples = 42, lags = 2;
  constexpr double parameters = 7;
  std::vector<VectorXd> errors;
  std::vector<std::vector<VectorXd>> predictions(12);
  for (int k = 0; k < 18; ++k) {
    errors.push_back(VectorXd::LinSpaced(samples, 0, k + 1));
    for (int l = 0; l < 12; ++l) {
      auto& prediction = predictions[std::size_t(l)].emplace_back(errors.back().tail(samples - lags));
      for (int t = 0; t < samples - lags; ++t) prediction(t) += (t % 2 == 0 ? 1 : -1) * (l + 2 * k);
    }
  }
  auto const matrix = deviation_matrix(errors, predictions, std::vector<double>(12, parameters));
  ASSERT_EQ(matrix.rows(), 12);
  ASSERT_EQ(matrix.cols(), 18);
  for (int l = 0; l < 12; ++l)
    for (int k = 0; k < 18; ++k)
      EXPECT_NEAR(matrix(l, k), (l + 2 * k) * (k == l ? std::sqrt(40.0 / (40.0 - parameters)) : 1.0), 1e-12);
  auto const statistics = batch_statistics(matrix);
  // Of model 3 on the others: 3 + 2k for k = 0 to 11 without 3, whose mean is 3 + 2 (66 − 3)/11.
  EXPECT_NEAR(statistics.Mn(3), 3.0 + 126.0 / 11.0, 1e-12);
  EXPECT_NEAR(statistics.verification_Mn(3), 3.0 + 2.0 * 14.5, 1e-12);
  EXPECT_NEAR(statistics.verification_Sd(3), 2.0 * std::sqrt(3.5), 1e-12);
}

TEST(BatchStatistics, NeedABatchForEachModel) {
  EXPECT_THROW(batch_statistics(MatrixXd::Ones(2, 2)), std::invalid_argument);
  EXPECT_THROW(batch_statistics(MatrixXd::Ones(4, 3)), std::invalid_argument);
  EXPECT_THROW(batch_statistics(MatrixXd::Ones(4, 5)), std::invalid_argument);
  EXPECT_EQ(batch_statistics(MatrixXd::Ones(4, 4)).verification_Mn.size(), 0);
}

// --- the protocol of paper 004 in a world of its own
// ------------------------------------------------------------------

/// A spindle at constant speed for 4.5 h, read every 3 min by ten sensors with steps of 0.0625 K: front and rear
/// bearing, motor and housing are heated, two neighbours each; one sensor reads the room, which drifts. The error has
/// slow parts that no sensor shows.
Batch spindle_run(int number) {
  std::mt19937_64 generator(std::uint64_t(100 + number));
  double const speed = 2000.0 * (1 + number % 3) / 6000.0, season = -10.0 + 25.0 * uniform(generator);
  double const drift = -1.0 + 6.0 * uniform(generator), loss = 1.0 - 0.012 * season;
  constexpr Eigen::Index samples = 90;
  constexpr double tau[] = {12, 25, 40, 90, 200}, gain[] = {14, 9, 11, 5, 3};
  MatrixXd rise(samples, 10);
  VectorXd error(samples);
  for (Eigen::Index t = 0; t < samples; ++t) {
    double const minute = 3.0 * double(t), room = drift * minute / 270.0;
    double state[5];
    for (int k = 0; k < 5; ++k)
      state[k] = gain[k] * loss * std::pow(speed, 0.7 + 0.2 * k) * (1 - std::exp(-minute / tau[k])) +
                 room * (1 - std::exp(-minute / tau[k]));
    for (int j = 0; j < 9; ++j) {
      double const reading = state[j % 5] * (1.0 - 0.05 * (j / 5)) + 0.02 * normal(generator);
      rise(t, j) = 0.0625 * std::round(reading / 0.0625);
    }
    rise(t, 9) = 0.0625 * std::round((room + 0.05 * normal(generator)) / 0.0625);
    error(t) = 1.2 * state[0] + 0.9 * state[1] + 0.8 * state[2] + 2.5 * state[3] + 3.0 * state[4] - 0.8 * room +
               0.3 * normal(generator);
  }
  auto batch = batch_of(rise, error);
  batch.name = fmt::format("K{}", number);
  batch.time *= 3.0;
  return batch;
}

BatchStatistics of_twelve(char const* name, std::vector<Eigen::Index> const& sensors) {
  auto const& method = model_method(name);
  std::vector<Batch> runs;
  for (int number = 1; number <= 18; ++number) runs.push_back(with_sensors(spindle_run(number), sensors));
  std::vector<VectorXd> errors;
  for (auto const& run : runs) errors.push_back(run.error);
  std::vector<std::vector<VectorXd>> predictions;
  std::vector<double> parameters;
  for (int l = 0; l < 12; ++l) {
    auto const model = method.fit(std::span(&runs[std::size_t(l)], 1), {});
    parameters.push_back(model.parameters);
    for (predictions.emplace_back(); auto const& run : runs)
      predictions.back().push_back(model.predict(run).tail(run.error.size() - model.unclaimed_instants()));
  }
  return batch_statistics(deviation_matrix(errors, predictions, parameters));
}

TEST(TwelveBatches, ComponentsFitWorseAndPredictOtherBatchesBetterThanLagsAlone) {
  std::vector<Eigen::Index> const sensors = {0, 2};
  for (char const* name : {"linear", "principal_component", "distributed_lag", "principal_component_distributed_lag",
                           "ridge", "ridge_distributed_lag"}) {
    auto const s = of_twelve(name, sensors);
    std::printf("%-36s S %.2f  Mn %.2f  Sd %.2f  verification Mn %.2f Sd %.2f um\n", name, s.S.mean(), s.Mn.mean(),
                s.Sd.mean(), s.verification_Mn.mean(), s.verification_Sd.mean());
  }
  auto const lags = of_twelve("distributed_lag", sensors);
  auto const components = of_twelve("principal_component_distributed_lag", sensors);
  EXPECT_GE(components.S.mean(), lags.S.mean());
  EXPECT_LT(components.Mn.mean(), lags.Mn.mean());
  EXPECT_LT(components.Sd.mean(), lags.Sd.mean());
}

}  // namespace
}  // namespace thermotwin::models
