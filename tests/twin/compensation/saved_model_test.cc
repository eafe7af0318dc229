#include "twin/compensation/saved_model.h"

#include <cmath>
#include <gtest/gtest.h>

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double period = 60.0;

/// Two sensors with courses of their own, a minute apart; from the first row on, ΔT.
models::Batch batch() {
  Index const n = 40;
  models::Batch batch{"run", VectorXd::LinSpaced(n, 0.0, period * double(n - 1)), {"T1", "T2"}, {"a", "b"}, {}, {}};
  batch.temperature_rise.resize(n, 2);
  for (Index i = 0; i < n; ++i)
    batch.temperature_rise.row(i) << 5.0 * (1.0 - std::exp(-0.1 * double(i))), 0.1 * double(i);
  batch.error = VectorXd::Zero(n);
  return batch;
}

models::ErrorModel linear(std::vector<int> lags) {
  MatrixXd coefficients(2, Index(lags.size()));
  for (Index l = 0; l < coefficients.cols(); ++l) coefficients.col(l) << 3.0 - double(l), -1.5 + 0.25 * double(l);
  return {"linear", {"T1", "T2"}, period, 3.0, models::LinearForm{0.5, std::move(lags), coefficients, 0}, ""};
}

TEST(SavedModel, IsTheModelOnTheSameReadingsHoweverOftenItIsAsked) {
  auto const run = batch();
  for (auto const& lags : {std::vector{0}, {0, 1}, {0, 2, 5}})
    for (int const calls : {1, 10}) {
      auto const model = linear(lags);
      VectorXd const expected = model.predict(run);
      SavedModel live(model);
      for (Index i = 0; i < run.time.size(); ++i)
        for (int k = 0; k < calls; ++k) {
          std::vector<double> const values{20.0 + run.temperature_rise(i, 0), 22.0 + run.temperature_rise(i, 1)};
          EXPECT_NEAR(live.error(run.time[i] + period * k / calls, values), expected[i], 1e-9) << i << " " << k;
        }
    }
}

TEST(SavedModel, CountsFromItsFirstReadings) {
  SavedModel live(linear({0}));
  EXPECT_DOUBLE_EQ(live.error(0.0, std::vector{31.0, 18.0}), 0.5);
  EXPECT_DOUBLE_EQ(live.error(10.0, std::vector{32.0, 18.0}), 3.5);
}

TEST(SavedModel, SaysWhichInputsLeaveTheirRange) {
  SavedModel live(linear({0}), {{0.0, 5.0}, {-1.0, 1.0}});
  EXPECT_TRUE(live.extrapolated().empty());
  static_cast<void>(live.error(0.0, std::vector{31.0, 18.0}));
  static_cast<void>(live.error(10.0, std::vector{36.0, 17.0}));
  EXPECT_TRUE(live.extrapolated().empty());
  static_cast<void>(live.error(20.0, std::vector{37.0, 17.0}));
  ASSERT_EQ(live.extrapolated().size(), 1U);
  EXPECT_EQ(live.extrapolated().at("T1"), "T1 changed by 6.00 K; the model was fitted on changes of 0.00 K to 5.00 K");
  SavedModel unknown(linear({0}));
  static_cast<void>(unknown.error(0.0, std::vector{0.0, 0.0}));
  static_cast<void>(unknown.error(10.0, std::vector{99.0, 0.0}));
  EXPECT_TRUE(unknown.extrapolated().empty());
}

TEST(SavedModel, AsksForItsSensorsInDegrees) {
  SavedModel const live(linear({0}));
  ASSERT_EQ(live.inputs().size(), 2u);
  EXPECT_EQ(live.inputs()[1].name, "T2");
  EXPECT_EQ(live.inputs()[1].unit, "degC");
  EXPECT_TRUE(live.inputs()[1].required && live.inputs()[1].sensor);
}

}  // namespace
}  // namespace thermotwin::twin
