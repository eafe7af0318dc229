#include "twin/error_prediction.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace thermotwin::twin {
namespace {

/// Of errors 0, 2, −1 and 3 um the prediction leaves 0, 1, 0 and −2; the first row is not claimed.
TEST(ErrorPrediction, TellsWhatIsLeft) {
  SavedErrorModel model;
  model.parts.emplace_back();
  ErrorPrediction prediction;
  prediction.run.batch.name = "tuesday, after the coolant.h5";
  prediction.run.batch.error = Eigen::Vector<double, 5>(9.0, 0.0, 2.0, -1.0, 3.0);
  prediction.predicted = Eigen::Vector<double, 5>(0.0, 0.0, 1.0, -1.0, 5.0);
  prediction.unclaimed = 1;
  prediction.unit = "um";
  EXPECT_EQ(prediction_text(prediction),
            "tuesday, after the coolant.h5    rows      RMSE       MAE      bias   largest\n"
            "error                               4      1.87      1.50      1.00      3.00  um\n"
            "less prediction                     4      1.12      0.75     -0.25      2.00  um\n");
  auto const json = nlohmann::json::parse(predictions_json(model, {prediction})).at("runs").at(0);
  EXPECT_EQ(json.at("rows"), 4);
  EXPECT_EQ(json.at("error").at("mae"), 1.5);
  EXPECT_EQ(json.at("less_prediction").at("bias"), -0.25);
  EXPECT_EQ(json.at("less_prediction").at("largest"), 2.0);
  EXPECT_FALSE(json.at("fitted_to_these_data").get<bool>());
  prediction.unclaimed = 5;
  EXPECT_FALSE(nlohmann::json::parse(predictions_json(model, {prediction})).at("runs").at(0).contains("error"));
}

}  // namespace
}  // namespace thermotwin::twin
